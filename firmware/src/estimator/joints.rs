//! What is taken for the angles of the joints, where their sensors say nothing too.

use super::trend::LEAST_TRAVEL;
use crate::scalar::Scalar;

/// A joint's sensor that has been silent for so long is not awaited any more, s: between two frames of ten a second, so that rounding decides
/// nothing.
const AWAITED_S: f64 = 4.95;
/// A joint lies near its angle on plane ground, within so much as one standard deviation, rad: hills of a wheelbase or more bend it by half
/// of that, rocks of a wheel's radius by a little more than that.
const USUAL_RAD: f64 = 0.1;
/// On the way it takes another angle after so much travel, m: most of a wheelbase.
const ALIKE_M: f64 = 0.2;

/// How long each joint of a side has been silent, s: rocker against body, bogie against rocker.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joints<S> {
    silent_s: [S; 2],
}

impl<S: Scalar> Joints<S> {
    /// Both may be heard yet.
    pub fn new() -> Self {
        Self { silent_s: [S::zero(); 2] }
    }

    /// The angle of each joint, rad, with its standard deviation: as measured; of one that is silent for good, what joints usually are, told
    /// in each frame so weakly that it is told once in the travel after which it is another. Otherwise links would drift away without end,
    /// since nothing else tells how they lie.
    pub fn tick(&mut self, readings: [Option<S>; 2], noise_rad: S, travel_m: S, step_s: S) -> [(Option<S>, S); 2] {
        let frames = S::constant(2.0 * ALIKE_M) / travel_m.max(S::constant(LEAST_TRAVEL));
        let usual = (S::constant(USUAL_RAD * USUAL_RAD) * frames).sqrt();
        let [rocker, bogie] = &mut self.silent_s;
        let [of_rocker, of_bogie] = readings;
        let heard = |silent_s: &mut S, reading: Option<S>| {
            *silent_s = if reading.is_some() { S::zero() } else { *silent_s + step_s };
            match reading {
                Some(_) => (reading, noise_rad),
                None => (Some(S::zero()).filter(|_| *silent_s > S::constant(AWAITED_S)), usual),
            }
        };
        [heard(rocker, of_rocker), heard(bogie, of_bogie)]
    }
}

#[cfg(test)]
mod tests {
    use super::Joints;

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
