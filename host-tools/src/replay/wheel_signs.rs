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

/// What the wheels of a drive say of signs.
#[derive(Debug, Clone)]
pub struct WheelSigns {
    rover: Rover<f64>,
    /// Encoder and velocimeter.
    turning: PerWheel<Agreement>,
    /// Encoder and torque of wheels that drive.
    driving: PerWheel<Agreement>,
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
}

impl WheelSigns {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self { rover: rover.map(f64::from), turning: PerWheel::default(), driving: PerWheel::default() }
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
        let counts = self.turning.iter_wheels_mut().zip(self.driving.iter_wheels_mut());
        for (sensors, (turning, driving)) in frame.wheels.iter_wheels().zip(counts) {
            let rim_m_s = wide(sensors.rate_rad_s).map(|rate| wheel.radius_m * rate);
            let Some(rim_m_s) = rim_m_s.filter(|rim| rim.abs() > least_m_s) else { continue };
            let goes_along = rim_m_s * speed_m_s > 0.0;
            turning.count(goes_along);
            let drives = goes_along && speed_m_s.abs() < (1.0 - DRIVING_SLIP) * rim_m_s.abs() - chance_m_s;
            let torque =
                wide(sensors.motor_torque_nm).filter(|torque| torque.abs() > BEYOND_NOISE * noise.motor_torque_nm);
            torque.filter(|_| drives).into_iter().for_each(|torque| driving.count(torque * rim_m_s > 0.0));
        }
    }

    /// What came of it, sentence by sentence without capital and stop.
    pub fn told(&self) -> Vec<String> {
        let against = |signs: &PerWheel<Agreement>| -> Vec<&str> {
            let wheels = WHEEL_NAMES.into_iter().zip(signs.iter_wheels());
            wheels.filter(|(_, agreement)| agreement.is_against()).map(|(name, _)| name).collect()
        };
        let turning = against(&self.turning);
        let telling = self.turning.iter_wheels().filter(|agreement| agreement.tells()).count();
        let of_turning = match turning.len() {
            0 => None,
            // That of the velocimeter is likelier than that of all of several.
            against if against == telling && against > 1 => {
                let all = if against == 6 { "all encoders" } else { "all encoders that tell" };
                Some(format!("velocity_x and {all} have other signs: one of them is not positive forward"))
            }
            _ => Some(format!(
                "the encoders of {} turn against the velocimeter: their sign is wrong",
                turning.join(", ")
            )),
        };
        let driving = against(&self.driving);
        let of_driving = (!driving.is_empty()).then(|| {
            let wheels = driving.join(", ");
            format!(
                "the motor torques of {wheels} go against their wheels while these slip forward: their sign is wrong"
            )
        });
        of_turning.into_iter().chain(of_driving).collect()
    }
}
