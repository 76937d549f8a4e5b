//! What the filters are told of a frame: without the readings that their gates refuse, of which those that are out of range are counted.

use kapvik_firmware::estimator::{PerSensor, SensorGates, SensorHealth};
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::{SensorFrame, WheelSensors};

/// The gates of the flight library, beside those of the filters: an estimator does not say what it refused of which frame.
#[derive(Debug, Clone)]
pub struct Admitted {
    gates: SensorGates,
    /// Which sensors are out of use; what else they count is that of the last frame alone.
    health: PerSensor<SensorHealth>,
    spoken: PerSensor<Spoken>,
    before_us: Option<u64>,
}

/// How often a sensor spoke, and how often farther out than a rover can be. The filters' own counts of that stop at 65535.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Spoken {
    /// Readings.
    pub readings: u64,
    /// Those out of range.
    pub beyond: u64,
}

impl Admitted {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self {
            gates: SensorGates::new(rover),
            health: PerSensor::default(),
            spoken: PerSensor::default(),
            before_us: None,
        }
    }

    /// How often each sensor spoke so far.
    pub fn spoken(&self) -> &PerSensor<Spoken> {
        &self.spoken
    }

    /// A frame with the readings that can be used; none where it repeats the time of the one before, which the filters leave out.
    pub fn of_frame(&mut self, frame: &SensorFrame) -> Option<SensorFrame> {
        let is_new = self.before_us.replace(frame.time_us) != Some(frame.time_us);
        is_new.then(|| {
            self.health =
                self.health.map(|SensorHealth { dropped, .. }| SensorHealth { dropped, ..SensorHealth::default() });
            let admitted = self.gates.admit(frame.readings(), &mut self.health);
            self.spoken = self.spoken.zip_map(self.health, Spoken::with);
            with_readings(frame.time_us, admitted)
        })
    }
}

impl Spoken {
    /// With a frame of which that was counted.
    fn with(self, SensorHealth { missing, out_of_range, .. }: SensorHealth) -> Self {
        Self { readings: self.readings + u64::from(1 - missing), beyond: self.beyond + u64::from(out_of_range) }
    }
}

/// The frame of which these are the [readings](SensorFrame::readings).
fn with_readings(time_us: u64, readings: PerSensor<Option<f32>>) -> SensorFrame {
    let PerSensor { wheel_rate, motor_torque, load_cell, bogie_angle, rocker_angle, accel, gyro, velocity } = readings;
    let wheels = wheel_rate.zip_wheels(motor_torque).zip_wheels(load_cell);
    let in_place =
        |((rate_rad_s, motor_torque_nm), load_cell_n)| WheelSensors { rate_rad_s, motor_torque_nm, load_cell_n };
    SensorFrame {
        time_us,
        wheels: wheels.map_wheels(in_place),
        bogie_angle_rad: bogie_angle,
        rocker_angle_rad: rocker_angle,
        accel_m_s2: accel,
        gyro_rad_s: gyro,
        velocity_m_s: velocity,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::sensor_channels::{values, values_mut};

    fn admitted() -> Admitted {
        Admitted::of(&Rover::<f64>::assumed().map(|value| value as f32))
    }

    #[test]
    fn what_can_be_used_stays_in_its_place() {
        let mut frame = SensorFrame { time_us: 7, ..SensorFrame::default() };
        values_mut(&mut frame).zip(1_u8..).for_each(|(value, number)| *value = Some(0.01 * f32::from(number)));
        assert_eq!(admitted().of_frame(&frame), Some(frame));
        frame.velocity_m_s.x = None;
        frame.wheels.right.middle.load_cell_n = Some(1.0e6);
        let told = admitted().of_frame(&frame).map(|told| values(&told));
        frame.wheels.right.middle.load_cell_n = None;
        assert_eq!(told, Some(values(&frame)));
    }

    #[test]
    fn counts_go_on_where_those_of_the_filters_stop() {
        let mut admitted = admitted();
        for number in 0..100_000_u32 {
            let rocker = if number % 4 == 0 { None } else { Some(if number % 2 == 0 { 0.1 } else { 9.0 }) };
            let time_us = 10_000 * u64::from(number);
            admitted.of_frame(&SensorFrame { time_us, rocker_angle_rad: rocker, ..SensorFrame::default() });
        }
        assert_eq!(admitted.spoken().rocker_angle, Spoken { readings: 75_000, beyond: 50_000 });
        assert_eq!(admitted.spoken().accel.x, Spoken::default());
    }

    #[test]
    fn a_time_that_repeats_is_left_out() {
        let mut admitted = admitted();
        let times = [0, 0, 100_000, 100_000, 0];
        let told = times.map(|time_us| admitted.of_frame(&SensorFrame { time_us, ..SensorFrame::default() }).is_some());
        assert_eq!(told, [true, false, true, false, true]);
    }
}
