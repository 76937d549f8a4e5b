//! Whether encoders, drives and velocimeter agree which way the wheels turn and what they push: one that is wired the other way round does not.

use kapvik_firmware::rover::{PerWheel, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::{DRIVING_M_S, LEAST_READINGS, NEARLY_ALL, wide};
use crate::data::sensor_channels::WHEEL_NAMES;

/// Standard deviations below which neither hub nor rim tells a direction, nor a torque.
const BEYOND_NOISE: f64 = 5.0;
/// Share of the rover's speed by which its turning may move a wheel's hub.
const STRAIGHT: f64 = 0.3;
/// A wheel that slips by more than this drives, whatever carries the rover: the soil resists it.
const DRIVING_SLIP: f64 = 0.1;

/// How often what two sensors say went together, and how often against each other.
#[derive(Debug, Clone, Copy, Default)]
struct Agreement {
    with: u32,
    against: u32,
}

/// What the sensors of one wheel say of each other's signs.
#[derive(Debug, Clone, Copy, Default)]
struct Signs {
    /// Encoder and velocimeter.
    turning: Agreement,
    /// Encoder and torque while it turns against the velocimeter.
    turning_back: Agreement,
    /// Encoder and torque while it drives.
    driving: Agreement,
}

/// What the wheels of a drive say of signs.
#[derive(Debug, Clone)]
pub struct WheelSigns {
    rover: Rover<f64>,
    wheels: PerWheel<Signs>,
}

impl Agreement {
    fn count(&mut self, agrees: bool) {
        if agrees { self.with += 1 } else { self.against += 1 }
    }

    fn frames(&self) -> u32 {
        self.with + self.against
    }

    fn tells(&self) -> bool {
        self.frames() >= LEAST_READINGS
    }

    fn is_against(&self) -> bool {
        self.tells() && f64::from(self.against) > NEARLY_ALL * f64::from(self.frames())
    }

    fn is_mostly_with(&self) -> bool {
        self.tells() && self.with > self.against
    }
}

impl Signs {
    /// Whether the encoder turns against the velocimeter and the torque does not go with it.
    fn encoder_is_against(&self) -> bool {
        self.turning.is_against() && !self.turning_back.is_mostly_with()
    }

    /// Whether both do: a wheel that turns back beside others that go ahead says the same.
    fn both_are_against(&self) -> bool {
        self.turning.is_against() && self.turning_back.is_mostly_with()
    }
}

impl WheelSigns {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self { rover: rover.map(f64::from), wheels: PerWheel::default() }
    }

    /// Takes a frame in which the rover drives more or less straight.
    pub fn take(&mut self, frame: &SensorFrame) {
        let Rover { noise, wheel, suspension, .. } = &self.rover;
        let Some(speed_m_s) = wide(frame.velocity_m_s.x) else { return };
        let turning_m_s = suspension.half_track_m * wide(frame.gyro_rad_s.z).unwrap_or(0.0);
        let moves = speed_m_s.abs() > DRIVING_M_S.max(BEYOND_NOISE * noise.velocity_m_s);
        if !moves || turning_m_s.abs() > STRAIGHT * speed_m_s.abs() {
            return;
        }
        let rim_std_m_s = noise.wheel_rate_rad_s * wheel.radius_m;
        let least_m_s = DRIVING_M_S.max(BEYOND_NOISE * rim_std_m_s);
        let chance_m_s = BEYOND_NOISE * rim_std_m_s.hypot(noise.velocity_m_s);
        for (sensors, signs) in frame.wheels.iter_wheels().zip(self.wheels.iter_wheels_mut()) {
            let rim_m_s = wide(sensors.rate_rad_s).map(|rate| wheel.radius_m * rate);
            let Some(rim_m_s) = rim_m_s.filter(|rim| rim.abs() > least_m_s) else { continue };
            let goes_along = rim_m_s * speed_m_s > 0.0;
            signs.turning.count(goes_along);
            let drives = speed_m_s.abs() < (1.0 - DRIVING_SLIP) * rim_m_s.abs() - chance_m_s;
            let torque =
                wide(sensors.motor_torque_nm).filter(|torque| torque.abs() > BEYOND_NOISE * noise.motor_torque_nm);
            match torque.map(|torque| torque * rim_m_s > 0.0) {
                Some(pushes) if !goes_along => signs.turning_back.count(pushes),
                Some(pushes) if drives => signs.driving.count(pushes),
                _ => {}
            }
        }
    }

    /// What came of it, sentence by sentence without capital and stop.
    pub fn told(&self) -> Vec<String> {
        let of_driving = self.named(|signs| signs.driving.is_against()).map(|wheels| {
            format!(
                "the motor torques of {wheels} go against their wheels while these slip forward: their sign is wrong"
            )
        });
        self.of_turning().into_iter().chain(of_driving).collect()
    }

    fn of_turning(&self) -> Vec<String> {
        let count =
            |is_so: fn(&Agreement) -> bool| self.wheels.iter_wheels().filter(|signs| is_so(&signs.turning)).count();
        let (telling, against) = (count(Agreement::tells), count(Agreement::is_against));
        // That of the velocimeter is likelier than that of all of several.
        if against == telling && against > 1 {
            let all = if against == 6 { "all encoders" } else { "all encoders that tell" };
            return vec![format!("velocity_x and {all} have other signs: one of them is not positive forward")];
        }
        let alone = self.named(Signs::encoder_is_against);
        let alone =
            alone.map(|wheels| format!("the encoders of {wheels} turn against the velocimeter: their sign is wrong"));
        let both = self.named(Signs::both_are_against).map(|wheels| {
            format!(
                "the encoders of {wheels} turn against the velocimeter, and their motor torques with them: these wheels turn back, or both have \
                 the wrong sign"
            )
        });
        alone.into_iter().chain(both).collect()
    }

    /// The names of the wheels of which that holds; nothing where it holds of none.
    fn named(&self, is_so: fn(&Signs) -> bool) -> Option<String> {
        let wheels = WHEEL_NAMES.into_iter().zip(self.wheels.iter_wheels());
        let names: Vec<&str> = wheels.filter(|(_, signs)| is_so(signs)).map(|(name, _)| name).collect();
        (!names.is_empty()).then(|| names.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::rover::{PerAxle, PerSide};
    use kapvik_firmware::sensor_frame::WheelSensors;

    use super::*;

    /// What is said of a drive ahead, on which one wheel says this.
    fn told(one: WheelSensors) -> Vec<String> {
        let mut signs = WheelSigns::of(&Rover::<f64>::assumed().map(|value| value as f32));
        let ahead = WheelSensors { rate_rad_s: Some(0.4), motor_torque_nm: Some(1.5), load_cell_n: None };
        let mut frame = SensorFrame { wheels: PerSide::both(PerAxle::all(ahead)), ..SensorFrame::default() };
        frame.velocity_m_s.x = Some(0.02);
        frame.wheels.left.middle = one;
        (0..60).for_each(|_| signs.take(&frame));
        signs.told()
    }

    #[test]
    fn a_wheel_that_turns_back_has_no_wrong_sign_for_sure() {
        let says = |rate: f32, torque: Option<f32>| {
            told(WheelSensors { rate_rad_s: Some(rate), motor_torque_nm: torque, load_cell_n: None })
        };
        assert_eq!(says(0.4, Some(1.5)), Vec::<String>::new());
        for (rate, torque, words) in [
            (-0.4, Some(1.5), "the encoders of ml turn against the velocimeter: their sign is wrong"),
            (-0.4, None, "the encoders of ml turn against the velocimeter: their sign is wrong"),
            (-0.4, Some(-1.5), "the encoders of ml turn against the velocimeter, and their motor torques with them"),
            (0.4, Some(-1.5), "the motor torques of ml go against their wheels"),
        ] {
            let said = says(rate, torque);
            assert!(said.len() == 1 && said[0].starts_with(words), "{rate} {torque:?}: {said:?}");
        }
    }
}
