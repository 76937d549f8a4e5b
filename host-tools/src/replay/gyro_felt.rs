//! Whether the gyro turns as the rover does: against gravity, which tells pitch, and while all wheels stand.

use kapvik_firmware::estimator::pitch_rate;
use kapvik_firmware::rover::{Axes, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;
use nalgebra::Vector3;

use super::raw_sensors::{Steps, wide};
use crate::statistics::running::RunningTogether;

/// A zero of the gyro from which slips and pulls are off by more than their standard deviations, rad/s.
const TOLERATED_RAD_S: f64 = 5e-4;
/// Standard errors beyond which that is no chance.
const BEYOND_CHANCE: f64 = 6.0;
/// Longer than this nothing is known of what the gyro would have said, s.
const LONGEST_STEP_S: f64 = 0.5;
/// Readings beyond these no rover on wheels makes: rad/s, and a share of gravity.
const FASTEST_RAD_S: f64 = 2.0;
const SHAKEN: f64 = 0.3;
/// Least standard deviation of the pitch, rad, that tells which way it turns, and of one that tells by how much; and the share by which that
/// may be otherwise.
const TELLS_SIGN_RAD: f64 = 0.004;
const TELLS_SCALE_RAD: f64 = 0.015;
const OTHER_SCALE: f64 = 0.2;
/// Times its variance that a pitch has to turn by beyond what noise of the gyro adds up to: a random walk over a time T, less its trend, has a
/// fifteenth of the variance of its end.
const BEYOND_WALK: f64 = 10.0;
const OF_WALK: f64 = 1.0 / 15.0;
/// Shortest record that tells a drift, and shortest standing, s.
const LEAST_S: f64 = 5.0;
const LEAST_STANDING_S: f64 = 3.0;
/// Fewest frames of both.
const LEAST_FRAMES: u32 = 30;
/// Standard deviations of an encoder, and m/s of the velocimeter, within which a wheel and a rover stand.
const STANDING: f64 = 5.0;

/// What the gyro of a drive says beside other sensors.
#[derive(Debug, Clone)]
pub struct GyroFelt {
    rover: Rover<f64>,
    steps: Steps,
    rate_before: Option<f64>,
    /// So long the gyro's rate has been added up, s.
    time_s: f64,
    /// And so far it says that the rover has pitched, rad.
    turned_rad: f64,
    /// Time, pitch by the gyro and pitch by gravity.
    stretch: RunningTogether<3>,
    all: RunningTogether<3>,
    standing: Standing,
}

/// The gyro's readings while the rover stands.
#[derive(Debug, Clone, Copy, Default)]
struct Standing {
    frames: u32,
    time_s: f64,
    sums: Vector3<f64>,
}

impl GyroFelt {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        let (stretch, all, standing) = Default::default();
        let steps = Steps::up_to(LONGEST_STEP_S);
        let rover = rover.map(f64::from);
        Self { rover, steps, rate_before: None, time_s: 0.0, turned_rad: 0.0, stretch, all, standing }
    }

    /// Takes a frame.
    pub fn take(&mut self, frame: &SensorFrame) {
        let turns = frame.gyro_rad_s.map(|axis| wide(axis).filter(|rate| rate.abs() <= FASTEST_RAD_S));
        let Some(y) = turns.y else { return };
        // What is not measured counts as none of it.
        let turns = Axes { y, ..turns.map(|rate| rate.unwrap_or(0.0)) };
        let felt = frame.accel_m_s2.map(|axis| wide(axis).unwrap_or(0.0));
        let rate = pitch_rate(turns, felt);
        let step_s = self.steps.since_before_s(frame);
        let before = self.rate_before.replace(rate);
        let Some((step_s, rate_before)) = step_s.zip(before) else {
            self.end_stretch();
            return;
        };
        self.time_s += step_s;
        self.turned_rad += 0.5 * step_s * (rate_before + rate);
        if let Some(pitch) = self.pitch_rad(frame) {
            self.stretch.take(Vector3::new(self.time_s, self.turned_rad, pitch));
        }
        self.stand(frame, step_s);
    }

    /// The pitch that gravity tells, rad.
    fn pitch_rad(&self, frame: &SensorFrame) -> Option<f64> {
        let felt = frame.accel_m_s2.map(wide);
        let (ahead, up) = felt.x.zip(felt.z)?;
        let size = ahead.hypot(felt.y.unwrap_or(0.0)).hypot(up);
        let gravity = self.rover.gravity_m_s2;
        ((size - gravity).abs() <= SHAKEN * gravity).then(|| ahead.atan2(up))
    }

    /// What is before and after a stretch without the gyro has no angle in common.
    fn end_stretch(&mut self) {
        let stretch = std::mem::take(&mut self.stretch);
        self.all.count += stretch.count;
        self.all.products += stretch.products;
    }

    fn stand(&mut self, frame: &SensorFrame, step_s: f64) {
        let noise = &self.rover.noise;
        let is_still =
            |reading: Option<f32>, std: f64| wide(reading).is_some_and(|value| value.abs() <= STANDING * std);
        let wheels_stand = frame.wheels.iter_wheels().all(|wheel| is_still(wheel.rate_rad_s, noise.wheel_rate_rad_s));
        let stands = wheels_stand && is_still(frame.velocity_m_s.x, noise.velocity_m_s);
        let Some(rates) = frame.gyro_rad_s.map(wide).all().filter(|_| stands) else { return };
        self.standing.frames += 1;
        self.standing.time_s += step_s;
        self.standing.sums += Vector3::new(rates.x, rates.y, rates.z);
    }

    /// What came of it, sentence by sentence without capital and stop.
    pub fn told(mut self) -> Vec<String> {
        self.end_stretch();
        let standing = self.while_standing();
        let pitching = if standing.iter().any(|(axis, _)| *axis == "y") { None } else { self.against_gravity() };
        let told = standing.into_iter().map(|(axis, zero)| {
            format!("gyro_{axis} says {zero:.4} rad/s while the rover stands: its zero is off, and with it slips, pulls and soil")
        });
        told.chain(pitching).collect()
    }

    /// The axes that have a zero of their own, and which, rad/s.
    fn while_standing(&self) -> Vec<(&'static str, f64)> {
        let Standing { frames, time_s, sums } = self.standing;
        if frames < LEAST_FRAMES || time_s < LEAST_STANDING_S {
            return Vec::new();
        }
        let error = self.rover.noise.gyro_rad_s / f64::from(frames).sqrt();
        let axes = ["x", "y", "z"].into_iter().zip(sums.iter().map(|sum| sum / f64::from(frames)));
        axes.filter(|(_, mean)| mean.abs() > TOLERATED_RAD_S.max(BEYOND_CHANCE * error)).collect()
    }

    fn against_gravity(&self) -> Option<String> {
        let RunningTogether { count, products, .. } = self.all;
        let of_time = products[(0, 0)];
        if count < f64::from(LEAST_FRAMES) || self.time_s < LEAST_S || of_time <= 0.0 {
            return None;
        }
        // What of both pitches does not go with time.
        let slopes = products.row(0).transpose() / of_time;
        let left = |row: usize, column: usize| products[(row, column)] - slopes[row] * products[(0, column)];
        let pitching = left(1, 1);
        let scale = left(1, 2) / pitching;
        let step_s = self.time_s / count;
        let walk = OF_WALK * self.rover.noise.gyro_rad_s.powi(2) * step_s * self.time_s;
        let turns_by = |least_rad: f64| pitching / count > (BEYOND_WALK * walk).max(least_rad.powi(2));
        let is_reversed = scale < 0.0 && turns_by(TELLS_SIGN_RAD);
        if is_reversed || (scale - 1.0).abs() > OTHER_SCALE && turns_by(TELLS_SCALE_RAD) {
            return Some(match is_reversed {
                true => "gyro_y turns the other way than gravity tells: its sign, or that of accel_x, is wrong (nose-up is a negative rate \
                         about y, and a positive accel_x), and soil and its changes with it"
                    .to_owned(),
                false => format!("pitch by gravity changes by {scale:.2} times what gyro_y says: one of them speaks in other units"),
            });
        }
        let zero = slopes[2] - slopes[1];
        // A rate with white noise adds up to a random walk, the slope of which scatters by 1.1 times its end over the time.
        let chance = 1.1 * self.rover.noise.gyro_rad_s * (step_s / self.time_s).sqrt();
        (zero.abs() > TOLERATED_RAD_S.max(BEYOND_CHANCE * chance)).then(|| {
            format!("gyro_y says {zero:.4} rad/s more than gravity tells: its zero is off, and with it slips, pulls and soil")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of a rover that turns left by a quarter on a slope, at first straight uphill, of which the gyro says so much more about y.
    fn turning_on_a_slope(zero_rad_s: f32) -> Vec<String> {
        const SLOPE_RAD: f32 = 0.17;
        let rover = Rover::<f64>::assumed().map(|value| value as f32);
        let mut felt = GyroFelt::of(&rover);
        let turn_rad_s = 0.01_f32;
        for number in 0..1570_u64 {
            let heading_rad = turn_rad_s * 0.1 * number as f32;
            let (ahead, left) = (SLOPE_RAD.sin() * heading_rad.cos(), -SLOPE_RAD.sin() * heading_rad.sin());
            felt.take(&SensorFrame {
                time_us: 100_000 * number,
                gyro_rad_s: Axes { x: Some(0.0), y: Some(zero_rad_s), z: Some(turn_rad_s) },
                accel_m_s2: Axes { x: ahead, y: left, z: SLOPE_RAD.cos() }.map(|share| Some(9.81 * share)),
                ..SensorFrame::default()
            });
        }
        felt.told()
    }

    #[test]
    fn a_gyro_that_turns_on_a_slope_has_no_zero_of_its_own() {
        assert_eq!(turning_on_a_slope(0.0), Vec::<String>::new());
        let said = turning_on_a_slope(0.002);
        assert!(said.len() == 1 && said[0].starts_with("gyro_y says 0.0020 rad/s more than gravity tells"), "{said:?}");
    }
}
