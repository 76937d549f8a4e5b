//! How rough the ground is, and so how fast the contact angles of a side may wander.

use super::contact_angle::SideReadings;
use super::walk_rate::{Noise, WalkRate};
use crate::rover::{PerAxle, Planar, SensorNoise};
use crate::scalar::Scalar;

/// Nominal drift over a metre of travel: a twentieth of the ratio, and 5° of contact angle, over a wheel radius.
pub(super) const RATIO_DRIFT: f64 = 0.2;
/// See there.
pub(super) const ANGLE_DRIFT: f64 = 0.32;
/// Nominal drift of a link's pitch over a metre: a tenth of that, since links are long.
const LINK_DRIFT: f64 = 0.032;
/// What the wandering of the direction of travel, and that of the links' pitches, say of the contact angles'.
const ANGLE_FROM_WANDERING: f64 = 0.1;
/// Of the bogie's bend squared, what a metre of travel adds to the variance of a contact angle is one over this, m: with the links
/// of set K0, ground of curvature c bends the bogie against the rocker by 0.233 m times c, and turns by 0.12 m times c within
/// the way over which the filter averages on such ground; 0.233²/0.12.
const BEND_LENGTH: f64 = 0.44;
/// Bends up to this may be wheels that sink unalike on plane ground, rad: 7 mm over a bogie.
const BEND_BY_SINKING: f64 = 0.02;
/// What is added to that for each unit by which runs of innovations are above chance.
const ANGLE_FROM_RUNS: f64 = 0.1;

/// Of the squared difference of two neighbouring contact angles, what a metre of travel adds to the variance of one is one over this,
/// m: with the wheels of set K0, ground of curvature c makes them differ by 0.35 m times c, and turns by 0.12 m times c within the
/// way over which the filter averages on such ground; 0.35²/0.12.
const UNLIKE_LENGTH: f64 = 1.02;
/// Angles that differ by less than two standard deviations may be one angle: so much of their variances is taken off.
const UNLIKE_BY_ERRORS: f64 = 4.0;
/// That angles differ says that the ground is not plane, and little of how fast they go on: it counts for no more than this, over the
/// nominal drift, as a variance.
const MOST_BY_UNLIKE: f64 = 0.03;

/// That length where the front wheel alone is on another slope, m: the ground has turned within less than the way to the wheel behind.
const ALONE_LENGTH: f64 = 0.34;
/// Over the square by which the wheels behind differ from each other: where that is half of the angle, the front wheel is not alone.
const UNLIKE_BEHIND: f64 = 4.0;
/// What a front wheel alone tells counts for no more than this, over the nominal drift, as a variance.
const MOST_BY_FRONT_ALONE: f64 = 0.2;

/// How fast contact angles drift that differ from wheel to wheel, over the nominal drift, as a variance. Angles and their variances, rad²,
/// front to rear.
///
/// Wheels that sink unalike bend the bogie on plane ground, but all roll along the same slope. Where a wheel's angle is another than that
/// of the wheel behind, or ahead, the ground curves: it tells when the front wheel first meets a slope, while links and velocity still
/// seem calm.
pub(super) fn of_unlike<S: Scalar>(angles: &PerAxle<S>, variances: &PerAxle<S>) -> S {
    let of_pair = |ahead: S, behind: S, variance: S| {
        let difference = ahead - behind;
        (difference * difference - S::constant(UNLIKE_BY_ERRORS) * variance).max(S::zero())
    };
    let unlike = of_pair(angles.front, angles.middle, variances.front + variances.middle)
        + of_pair(angles.middle, angles.rear, variances.middle + variances.rear);
    (S::constant(1.0 / (UNLIKE_LENGTH * ANGLE_DRIFT * ANGLE_DRIFT)) * unlike).min(S::constant(MOST_BY_UNLIKE))
}

/// What is added to [`of_unlike`] for a front wheel that meets a slope on which the wheels behind are not yet: links and velocity move little then,
/// and say that the ground is calm.
pub(super) fn of_front_alone<S: Scalar>(angles: &PerAxle<S>, variances: &PerAxle<S>) -> S {
    let (ahead, behind) = (angles.front - angles.middle, angles.middle - angles.rear);
    let by_errors = S::constant(UNLIKE_BY_ERRORS) * (variances.front + variances.middle);
    let alone = (ahead * ahead - by_errors - S::constant(UNLIKE_BEHIND) * behind * behind).max(S::zero());
    (S::constant(1.0 / (ALONE_LENGTH * ANGLE_DRIFT * ANGLE_DRIFT)) * alone).min(S::constant(MOST_BY_FRONT_ALONE))
}

/// How fast what is measured of a side's motion wanders.
#[derive(Debug, Clone)]
pub(super) struct Roughness<S> {
    ratio: WalkRate<S>,
    direction: WalkRate<S>,
    rocker: WalkRate<S>,
    bogie: WalkRate<S>,
}

/// How a side moves in a frame, as its rates are learned from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion<S> {
    /// Speed of the rims, m/s; not zero.
    pub speed_m_s: S,
    /// Time since the frame before, s.
    pub step_s: S,
    /// Pitch of the body in the plane of the side, rad, then its sine and cosine.
    pub body_pitch_rad: S,
    /// See there.
    pub body_pitch: (S, S),
}

impl<S: Scalar> Roughness<S> {
    /// Nothing is known. `phase` spreads costly work over frames.
    pub fn new(phase: usize) -> Self {
        Self {
            ratio: WalkRate::new(phase),
            direction: WalkRate::new(phase + 1),
            rocker: WalkRate::new(phase + 2),
            bogie: WalkRate::new(phase + 3),
        }
    }

    /// Forgets what was learned: it was not the ground's doing.
    pub fn restart(&mut self) {
        let rates = [&mut self.ratio, &mut self.direction, &mut self.rocker, &mut self.bogie];
        rates.into_iter().for_each(WalkRate::restart);
    }

    /// How fast the travel ratio wanders, over its nominal drift, as a variance.
    pub fn of_ratio(&self) -> S {
        self.ratio.factor()
    }

    /// The same of the links' pitches together.
    pub fn of_links(&self) -> S {
        self.rocker.factor() + self.bogie.factor()
    }

    /// The same of the contact angles, of a bogie that is bent against its rocker and runs of innovations that are so much above
    /// chance. The links feel the ground a wheelbase long, and thirty times more precisely than the velocity does; a wheel feels
    /// more of it than its link.
    ///
    /// A bogie that is bent stands on ground that curves. It tells at once, and still where a wheel is on top of a rock: there its
    /// angle changes most, and the links hardly move.
    pub fn of_angles(&self, bend_rad: S, runs: S) -> S {
        let zero = S::zero();
        let wandering = S::constant(ANGLE_FROM_WANDERING) * (self.direction.factor() + self.of_links());
        // Where links and velocity wander fast, so do the angles, and more than in proportion: how slowly they wander on plane
        // ground, no sensor can tell.
        let steeper = wandering * wandering.sqrt();
        let bend = (bend_rad.abs() - S::constant(BEND_BY_SINKING)).max(zero);
        bend * bend * S::constant(1.0 / (BEND_LENGTH * ANGLE_DRIFT * ANGLE_DRIFT))
            + steeper
            + S::constant(ANGLE_FROM_RUNS) * runs
    }

    /// Learns how fast the ratio and the direction of travel wander, from the velocity, and how fast the links' pitches do.
    pub fn learn(&mut self, motion: &Motion<S>, readings: &SideReadings<S>, noise: &SensorNoise<S>) {
        let Motion { speed_m_s: speed, step_s, body_pitch_rad, body_pitch } = *motion;
        let travel = speed.abs() * step_s;
        let nominal = |drift: f64| S::constant(drift * drift) * travel;
        let pitch = readings.rocker_angle_rad.map(|rocker| body_pitch_rad + rocker);
        let variance = noise.angle_rad * noise.angle_rad;
        // The body's pitch wanders by its gyro's noise, and by as much again where the accelerometer draws it back.
        let turned = noise.gyro_rad_s * step_s;
        let moved = S::constant(2.0) * turned * turned;
        self.rocker.take(pitch, Noise { variance, moved }, nominal(LINK_DRIFT), step_s);
        let bogie = pitch.zip(readings.bogie_angle_rad).map(|(pitch, bogie)| pitch + bogie);
        self.bogie.take(bogie, Noise { variance: variance + variance, moved }, nominal(LINK_DRIFT), step_s);
        let Planar { x, z } = readings.axis_velocity_m_s;
        let velocity = x.zip(z).map(|(x, z)| Planar { x, z }.turned(body_pitch));
        let Planar { x: std_x, z: std_z } = readings.velocity_std_m_s;
        let ratio = velocity.map(|velocity| velocity.x / speed);
        let direction = velocity.map(|velocity| velocity.z / speed);
        self.ratio.take(ratio, Noise::white(std_x / speed), nominal(RATIO_DRIFT), step_s);
        self.direction.take(direction, Noise::white(std_z / speed), nominal(ANGLE_DRIFT), step_s);
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_BY_FRONT_ALONE, MOST_BY_UNLIKE, PerAxle, Roughness, of_front_alone, of_unlike};

    /// On ground that curves by 0.02 rad over 0.35 m the front wheel's angle turns by 0.12/0.35 of that within 0.12 m; angles that their
    /// errors may make differ say nothing, and a wall says no more than that the ground is not plane.
    #[test]
    fn wheels_on_unlike_slopes_let_the_angles_wander() {
        let known = PerAxle::all(1.0e-12);
        let of_front =
            |front: f64, variances: &PerAxle<f64>| of_unlike(&PerAxle { front, middle: 0.1, rear: 0.1 }, variances);
        let turned = 0.02 * 0.12 / 0.35;
        let drift = of_front(0.12, &known) * super::ANGLE_DRIFT * super::ANGLE_DRIFT * 0.12;
        assert!((drift / (turned * turned) - 1.0).abs() < 0.01, "{drift} {turned}");
        assert_eq!(of_front(0.12, &PerAxle::all(1.0e-4)), 0.0);
        assert_eq!(of_front(1.0, &known), MOST_BY_UNLIKE);
    }

    /// A front wheel that meets a slope drifts three times as much as wheels that are all on it; one that follows the wheels behind, or
    /// that errors may make differ, no more than these.
    #[test]
    fn a_front_wheel_alone_on_a_slope_drifts_by_itself() {
        let known = PerAxle::all(1.0e-12);
        let alone = PerAxle { front: 0.12, middle: 0.1, rear: 0.1 };
        let ratio: f64 = of_front_alone(&alone, &known) / of_unlike(&alone, &known);
        assert!((ratio - 3.0).abs() < 0.01, "{ratio}");
        assert_eq!(of_front_alone(&PerAxle { front: 0.12, middle: 0.1, rear: 0.09 }, &known), 0.0);
        assert_eq!(of_front_alone(&alone, &PerAxle::all(1.0e-4)), 0.0);
        assert_eq!(of_front_alone(&PerAxle { front: 1.0, ..alone }, &known), MOST_BY_FRONT_ALONE);
    }

    /// A bend that wheels may have sunk to says nothing; one of 0.12 rad, on ground that curves by 0.1 rad over 0.233 m, lets an
    /// angle drift by what such ground turns by over 0.12 m of travel, within these 0.12 m.
    #[test]
    fn a_bent_bogie_lets_the_angles_wander() {
        let roughness = Roughness::<f64>::new(0);
        let of_bend = |bend: f64| roughness.of_angles(bend, 0.0) - roughness.of_angles(0.0, 0.0);
        assert_eq!(of_bend(0.015), 0.0);
        let turned = 0.12 * 0.1 / 0.233;
        let drift = of_bend(-0.12) * super::ANGLE_DRIFT * super::ANGLE_DRIFT * 0.12;
        assert!((drift / (turned * turned) - 1.0).abs() < 0.03, "{drift} {turned}");
    }
}
