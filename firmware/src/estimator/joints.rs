//! What is taken for the angles of the joints and for the rise of the axis, where their sensors say nothing too.

use super::silence::{AWAITED_S, Silence};
use super::trend::LEAST_TRAVEL;
use crate::scalar::Scalar;

/// A joint lies near its angle on plane ground, within so much as one standard deviation, rad: hills of a wheelbase or more bend it by half
/// of that, rocks of a wheel's radius by a little more than that.
const USUAL_RAD: f64 = 0.1;
/// The axis rises as steeply as its links lie, within so much as one standard deviation, rad: on hills and rocks, where each wheel is off by
/// twice that.
const USUAL_RISE_RAD: f64 = 0.04;
/// On the way it takes another angle after so much travel, m: most of a wheelbase.
const ALIKE_M: f64 = 0.2;

/// Readings of a sensor that works follow each other sooner, s.
const BETWEEN_READINGS_S: f64 = 1.05;

/// How long each joint of a side has been silent: rocker against body, bogie against rocker; and the velocimeter of how fast it rises.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joints<S> {
    silences: [Silence<S>; 2],
    of_rise: Silence<S>,
}

impl<S: Scalar> Joints<S> {
    /// All may be heard yet.
    pub fn new() -> Self {
        Self { silences: [Silence::none(); 2], of_rise: Silence::none() }
    }

    /// The angle of each joint, rad, with its standard deviation: as measured; of one that is silent for good, what joints usually are, told
    /// in each frame so weakly that it is told once in the travel after which it is another. Otherwise links would drift away without end,
    /// since nothing else tells how they lie.
    pub fn tick(&mut self, readings: [Option<S>; 2], noise_rad: S, travel_m: S, step_s: S) -> [(Option<S>, S); 2] {
        let usual = (S::zero(), S::constant(USUAL_RAD) * root_of_frames(travel_m));
        let [rocker, bogie] = &mut self.silences;
        let [of_rocker, of_bogie] = readings;
        [heard(rocker, step_s, (of_rocker, noise_rad), usual), heard(bogie, step_s, (of_bogie, noise_rad), usual)]
    }

    /// How fast the axis rises, m/s, with its standard deviation: as measured; or so weakly, at this speed, m/s, what its links tell that lie
    /// so steep against the body, rad. Otherwise contact angles would drift away without end where they steepen alike.
    pub fn rise(&mut self, measured: (Option<S>, S), step_s: S, speed_m_s: S, links_rad: S) -> (Option<S>, S) {
        let std = S::constant(USUAL_RISE_RAD) * speed_m_s.abs() * root_of_frames(speed_m_s.abs() * step_s);
        heard(&mut self.of_rise, step_s, measured, (speed_m_s * links_rad, std))
    }

    /// Whether the angle of a joint is surmised: how much of what its links bear is along the body is then not known.
    pub fn are_surmised(&self) -> bool {
        self.silences.iter().any(is_lost)
    }

    /// Whether the rocker's angle, or how fast the axis rises, is surmised: what tells all contacts of a side at once.
    pub fn lack_what_tells_all(&self) -> bool {
        let [rocker, _] = &self.silences;
        is_lost(rocker) || is_lost(&self.of_rise)
    }

    /// By what variance the axis may rise otherwise than contact angles say that are known by nothing but this, rad².
    pub fn unrisen_variance(&self) -> S {
        if self.of_rise.lasts(AWAITED_S) { S::constant(USUAL_RISE_RAD * USUAL_RISE_RAD) } else { S::zero() }
    }
}

/// Whether a sensor has been silent for longer than between any two readings.
#[inline(never)] // flash is scarcer than the time of a call
fn is_lost<S: Scalar>(silence: &Silence<S>) -> bool {
    silence.lasts(BETWEEN_READINGS_S)
}

/// The square root of how many frames of such travel make twice the way after which links lie otherwise.
fn root_of_frames<S: Scalar>(travel_m: S) -> S {
    (S::constant(2.0 * ALIKE_M) / travel_m.max(S::constant(LEAST_TRAVEL))).sqrt()
}

/// A reading with its standard deviation, where there is one; else what is usual, from when it is not awaited any more.
#[inline(never)] // flash is scarcer than the time of a call
fn heard<S: Scalar>(
    silence: &mut Silence<S>,
    step_s: S,
    reading: (Option<S>, S),
    (usual, usual_std): (S, S),
) -> (Option<S>, S) {
    silence.follow(reading.0.is_some(), step_s);
    if reading.0.is_some() {
        return reading;
    }
    (Some(usual).filter(|_| silence.lasts(AWAITED_S)), usual_std)
}

#[cfg(test)]
mod tests {
    use super::Joints;

    /// The axis rises as it is measured; while that is missed for a moment nothing is told; and when it is silent for good, its links.
    #[test]
    fn an_axis_of_which_nothing_is_heard_rises_with_its_links() {
        let mut joints = Joints::<f64>::new();
        let measured = (Some(0.004), 5.0e-4);
        assert_eq!(joints.rise(measured, 0.1, 0.02, 0.1), measured);
        assert_eq!(joints.unrisen_variance(), 0.0);
        let told: Vec<_> = (0..60).map(|_| joints.rise((None, 5.0e-4), 0.1, 0.02, 0.1)).collect();
        assert!(told.iter().take(49).all(|(rise, _)| rise.is_none()));
        let Some((Some(rise), std)) = told.last() else { panic!("nothing is told: {told:?}") };
        assert!((rise - 0.002).abs() < 1e-12 && *std > 0.04 * 0.02, "{rise} ± {std}");
        assert!((joints.unrisen_variance() - 0.0016).abs() < 1e-12);
    }

    /// A joint that is heard is believed; one that has just fallen silent is awaited; and what is told of one that is silent for good is, over
    /// the way after which it is another, one angle of 0 ± 0.1 rad.
    #[test]
    fn a_joint_that_is_silent_for_good_is_somewhere_near_rest() {
        let mut joints = Joints::<f64>::new();
        let heard = joints.tick([Some(0.2), Some(-0.1)], 0.002, 0.004, 0.1);
        assert_eq!(heard, [(Some(0.2), 0.002), (Some(-0.1), 0.002)]);
        let told: Vec<_> = (0..60).map(|_| joints.tick([Some(0.2), None], 0.002, 0.004, 0.1)).collect();
        assert!(told.iter().all(|[rocker, _]| *rocker == (Some(0.2), 0.002)));
        assert!(told.iter().take(49).all(|[_, bogie]| bogie.0.is_none()));
        let Some([_, (Some(angle), std)]) = told.last() else { panic!("nothing is told: {told:?}") };
        let (frames, length_m) = (100.0_f64, 0.4);
        assert_eq!((*angle, length_m), (0.0, frames * 0.004), "twice the way after which it is another");
        assert!((std / frames.sqrt() - 0.1).abs() < 1e-12, "{std}");
    }
}
