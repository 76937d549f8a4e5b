//! Wheels that have stood dig in as they start.
//!
//! Loads shift from wheel to wheel and slips grow, and the hubs sink while they travel: their paths depart from the terrain, and come back
//! to it over some centimetres. Until then the [terrain as it is remembered](RememberedTerrain) tells the contact angles beside them. In soil
//! that sinks with slip wheels dig deep, over a contact length and more: then all hubs together go down more steeply than their links lie,
//! which terrain makes them do now and then, but not from where the rover stood.

use super::contact_angle::ContactAngleFilter;
use super::remembered_terrain::RememberedTerrain;
use super::scale::Scale;
use crate::scalar::Scalar;

/// How fast the wheels of a side sink as they start, over the speed of their rims, as one standard deviation, and the travel after
/// which that is down to a third, m; under the wheels of set K0, and longer under larger ones.
const DIGS_IN: f64 = 0.1;
const DIGGING_IN_M: f64 = 0.013;
/// Where they sink by less than this they have dug in.
const DUG_IN: f64 = 0.003;
/// Between these ways of the rims the hubs tell whether they dig deep, m: before, loads shift; after, they have dug in.
const TELLS_DEEP_M: core::ops::Range<f64> = 0.03..0.26;
/// The angle by which hubs go down more steeply than their links lie, in the mean over a side, from which they dig deep; and that
/// below which it tells nothing any more, rad.
const DIGS_DEEP: f64 = 0.05;
const HARDLY_DIGS: f64 = 0.02;
/// The way of the rims after which deep digging is down to a third, m: a contact length.
const DIGGING_DEEP_M: f64 = 0.065;
/// Wheels whose rims are faster than the rover by this factor spin on the spot: they dig in, and meet no other terrain.
const SPINS: f64 = 8.0;
/// The least speed that paths are told by while wheels dig in, m/s.
const LEAST_SPEED: f64 = 3.0e-5;

/// How far the wheels of a side are from having dug in.
#[derive(Debug, Clone, Copy)]
pub(super) struct DiggingIn<S> {
    /// Variance of how fast the wheels sink, over the speed of their rims.
    variance: S,
    terrain: RememberedTerrain<S>,
    /// The way of the rims since they stood, m.
    way_m: S,
    /// Whether they dig deep.
    deep: bool,
    /// Radius of the wheels over that of set K0.
    length: S,
}

/// How a side rolled in a frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rolled<S> {
    /// Whether one of its wheels stands.
    pub stands: bool,
    /// How fast it travels, m/s, forward or back.
    pub speed_m_s: S,
    /// Speed of its rims, m/s.
    pub rim_speed_m_s: S,
    /// Time since the frame before, s.
    pub step_s: S,
}

impl<S: Scalar> DiggingIn<S> {
    /// Nothing was seen of them: they may just have started.
    pub fn new(scale: &Scale<S>) -> Self {
        let zero = S::zero();
        Self {
            variance: S::constant(DIGS_IN * DIGS_IN),
            terrain: RememberedTerrain::unknown(),
            way_m: zero,
            deep: false,
            length: scale.length,
        }
    }

    /// Variance of how fast they sink, over the speed of their rims, as they would in a soil that does not sink with slip.
    pub fn variance(&self) -> S {
        self.variance.min(S::constant(DIGS_IN * DIGS_IN))
    }

    /// Whether they have.
    pub fn is_over(&self) -> bool {
        self.variance == S::zero()
    }

    /// The terrain on which they stood.
    pub fn terrain(&self) -> &RememberedTerrain<S> {
        &self.terrain
    }

    /// Lets wheels dig in that have stood: the path of a hub comes back to the terrain as it travels, and so drifts against it.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn follow(&mut self, rolled: &Rolled<S>, angles: &mut ContactAngleFilter<S>) {
        let square = |value: f64| S::constant(value * value);
        let speed = rolled.speed_m_s.max(S::constant(LEAST_SPEED));
        let over_rim = rolled.rim_speed_m_s / speed;
        let squared = over_rim * over_rim;
        let spins = squared > square(SPINS);
        let steeper = if rolled.stands || spins {
            let starts = square(DIGS_IN);
            (self.variance, self.way_m, self.deep) = (starts, S::zero(), false);
            self.terrain.ask();
            if spins { starts * squared } else { starts }
        } else if self.variance > S::zero() {
            self.follow_deep(rolled, angles, squared);
            let per_step = rolled.step_s / self.length;
            let gone = if self.deep {
                S::constant(2.0 / DIGGING_DEEP_M) * rolled.rim_speed_m_s.abs() * per_step
            } else {
                S::constant(2.0 / DIGGING_IN_M) * speed * per_step
            };
            let came_back = self.variance * gone.min(S::one());
            self.variance -= came_back;
            angles.dig_in(came_back * squared);
            let steeper = self.variance * squared;
            if self.variance < square(DUG_IN) {
                self.variance = S::zero();
                angles.settle();
            }
            steeper
        } else {
            S::zero()
        };
        self.terrain.follow(angles, steeper);
    }

    /// Whether the hubs dig deep, and how fast: by how they go down, with the square of the rims' speed over that of the side.
    fn follow_deep(&mut self, rolled: &Rolled<S>, angles: &ContactAngleFilter<S>, squared: S) {
        self.way_m += rolled.rim_speed_m_s.abs() * rolled.step_s / self.length;
        if self.way_m < S::constant(TELLS_DEEP_M.start) || self.way_m > S::constant(TELLS_DEEP_M.end) {
            return;
        }
        let (up, steepness) = angles.departure();
        let down = if rolled.rim_speed_m_s < S::zero() { up } else { -up };
        self.deep |= down > S::constant(DIGS_DEEP);
        if self.deep && down > S::constant(HARDLY_DIGS) {
            self.variance = self.variance.max((steepness / squared).min(S::one()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{ContactAngleFilter, DiggingIn, Rolled, Scale};
    use crate::estimator::attitude::Attitude;
    use crate::estimator::contact_angle::SideReadings;
    use crate::rover::{PerAxle, Planar, Rover};

    const ROLLED: Rolled<f64> = Rolled { stands: false, speed_m_s: 0.01, rim_speed_m_s: 0.01, step_s: 0.001 };

    /// A filter that was told 0.3 m of level ground.
    fn on_the_level(rover: &Rover<f64>) -> ContactAngleFilter<f64> {
        let mut angles = ContactAngleFilter::new(rover, 0);
        let attitude = Attitude::new(rover.gravity_m_s2);
        let readings = SideReadings {
            axis_velocity_m_s: Planar { x: Some(ROLLED.speed_m_s), z: Some(0.0) },
            velocity_std_m_s: Planar { x: rover.noise.velocity_m_s, z: rover.noise.velocity_m_s },
            rocker_angle_rad: Some(0.0),
            bogie_angle_rad: Some(0.0),
            runs_of_forces: 0.0,
            starts: false,
            turns_per_m: [None; 2],
        };
        for _ in 0..300 {
            let _ = angles.tick(0.1, ROLLED.rim_speed_m_s, &PerAxle::all(0.0), &attitude, &readings, &rover.noise);
        }
        angles
    }

    /// Over 13 mm of travel what wheels that stood sink by falls to 1/e, its variance to 1/e²; within 60 mm they have dug in.
    #[test]
    fn wheels_dig_in_by_travel() {
        let rover = Rover::<f64>::assumed();
        let mut angles = ContactAngleFilter::new(&rover, 0);
        let mut digging = DiggingIn::new(&Scale::of(&rover));
        digging.follow(&ROLLED, &mut angles);
        assert!(!digging.is_over(), "they may have stood before");
        (0..6000).for_each(|_| digging.follow(&ROLLED, &mut angles));
        assert!(digging.is_over());
        digging.follow(&Rolled { stands: true, ..ROLLED }, &mut angles);
        (0..1300).for_each(|_| digging.follow(&ROLLED, &mut angles));
        assert!((digging.variance / (0.01 * (-2.0_f64).exp()) - 1.0).abs() < 0.01, "{}", digging.variance);
        (0..4700).for_each(|_| digging.follow(&ROLLED, &mut angles));
        assert!(digging.is_over());
    }

    /// Wheels that spin on the spot dig in for as long as they do, and the terrain is what it was.
    #[test]
    fn wheels_that_spin_on_the_spot_dig_in() {
        let rover = Rover::<f64>::assumed();
        let mut angles = on_the_level(&rover);
        let mut digging = DiggingIn::new(&Scale::of(&rover));
        (0..6000).for_each(|_| digging.follow(&ROLLED, &mut angles));
        assert!(digging.is_over() && digging.terrain().tells(&angles).is_none());
        let spins = Rolled { speed_m_s: 0.001, ..ROLLED };
        (0..6000).for_each(|_| digging.follow(&spins, &mut angles));
        let (told, _) = digging.terrain().tells(&angles).expect("the terrain is asked");
        assert!(!digging.is_over() && told > 0.9, "{told}");
    }
}
