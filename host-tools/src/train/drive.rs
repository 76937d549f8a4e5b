//! What effects follow beside slip and load, as it is on a rover that drives.

use kapvik_firmware::terramechanics::effects::{Conditions, Grousers};
use kapvik_firmware::wheel_state::WHEELS;

use crate::prior;

/// The circumstances of one scene.
///
/// The hubs of a rover share their speed over the ground, and each wheel's rate follows from its slip. Front wheels meet
/// fresh soil, middle wheels that of one pass and rear wheels that of two; which places of a scene are which is drawn,
/// since a fast rim may be anywhere. Temperature, time since the sensors were zeroed, way travelled and slip angle are the
/// rover's, the angle of each wheel is its own. Pitch is the slope that the wheels pull the rover up.
///
/// An instant's phase of the grousers stands for a mean of instants, too, where it would in truth average away.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    speed_m_s: f64,
    temperature_c: f64,
    hours_since_zero: f64,
    travel_m: f64,
    slip_angle_rad: f64,
    passes: [f64; WHEELS],
    wheel_angles_rad: [f64; WHEELS],
    grouser_height: f64,
}

impl Drive {
    /// A drive; `share` gives numbers 0 … 1.
    pub fn draw(mut share: impl FnMut() -> f64) -> Self {
        let mut passes = [1.0, 1.0, 2.0, 2.0, 3.0, 3.0];
        for last in (1..WHEELS).rev() {
            passes.swap(last, (share() * (last + 1) as f64) as usize % (last + 1));
        }
        Self {
            speed_m_s: prior::SPEED_M_S.at(share()),
            temperature_c: prior::TEMPERATURE_C.at(share()),
            hours_since_zero: prior::HOURS_SINCE_ZERO.at(share()),
            travel_m: prior::TRAVEL_M.at(share()),
            slip_angle_rad: prior::SLIP_ANGLE_RAD.at(share()),
            grouser_height: share(),
            passes,
            wheel_angles_rad: [(); WHEELS].map(|()| std::f64::consts::TAU * share()),
        }
    }

    /// What the effects of the wheel at a place of the scene follow.
    pub fn at(&self, place: usize, pitch_rad: f64) -> Conditions<f64> {
        let place = place % WHEELS;
        Conditions {
            pass: Some(self.passes[place]),
            temperature_c: Some(self.temperature_c),
            hours_since_zero: Some(self.hours_since_zero),
            speed_m_s: Some(self.speed_m_s),
            wheel_rate_rad_s: None,
            wheel_angle_rad: Some(self.wheel_angles_rad[place]),
            travel_m: Some(self.travel_m),
            pitch_rad: Some(pitch_rad),
            slip_angle_rad: Some(self.slip_angle_rad),
            felt_slip: None,
        }
    }

    /// The grousers of a wheel that is not Kapvik's.
    pub fn other_grousers(&self, radius_m: f64) -> Grousers<f64> {
        let height_m = prior::GROUSER_RATIO.at(self.grouser_height) * radius_m;
        Grousers { height_m, count: prior::KAPVIK_GROUSERS.count }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_wheels_are_on_each_pass_whatever_is_drawn() {
        for seed in 0_u32..200 {
            let mut dimension = 0;
            let drive = Drive::draw(|| {
                dimension += 1;
                f64::from(sobol_burley::sample(seed, dimension, 7))
            });
            let mut passes = [0; 3];
            for place in 0..WHEELS {
                let pass = drive.at(place, 0.0).pass.expect("a pass");
                passes[pass as usize - 1] += 1;
            }
            assert_eq!(passes, [2; 3]);
        }
    }
}
