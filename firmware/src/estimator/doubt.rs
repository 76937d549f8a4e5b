//! How much larger errors are than the filters know.
//!
//! Rates of drift are chosen by innovations. Of what moves steadily rather than at random, with gain k and noise R, that choice leaves
//! k R/4 of lag and k R/2 of noise, and a filter states k R: so some three quarters. Of what does not move at all, all of it is true as
//! long as the filter still learns more than it forgets, and half of it in the end; the filter of the contact angles follows that share,
//! which holds on still ground. Where the ground changes faster than the rates, innovations come in runs ([`super::runs`]), and errors
//! are larger; where it turns, everything lags ([`super::trend`]). All numbers are as fitted to squared errors on drives of development
//! (of each kind of ground as many), the same for every kind of ground.

use super::contact_angle::{RUN_OF_FORCES, UNKNOWN_ANGLE};
use super::runs::Runs;
use super::trend::Trends;
use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// Of the variance that a filter states of contact angles on restless ground, what is true of the bogie's, and of the front wheel's.
const BOGIE_ANGLE: f64 = 0.65;
const FRONT_ANGLE: f64 = 0.42;
/// Of the share that is true on still ground, what is true of the front wheel's.
const FRONT_ANGLE_STILL: f64 = 0.8;
/// What is added to that of the front wheel for each unit by which the runs of how the side moves are above chance: it meets what the
/// others follow it to.
const FRONT_ANGLE_BY_MOTION: f64 = 0.53;
/// Of the square by which it differs from the angle of the wheel behind, up to twice what their errors make of that, what may be an error of
/// a front wheel that meets other ground while the links are calm.
const FRONT_ANGLE_UNLIKE: f64 = 0.82;
/// One standard deviation of what it may have met that cells and drives feel and links do not yet, rad, where the runs of the forces count
/// for one; as a variance it goes with these.
const FRONT_ANGLE_FELT: f64 = 0.01;
/// The same of the slip: what a wheel feels anew makes it slip anew.
const SLIP: f64 = 0.88;
const SLIP_BY_MOTION: f64 = 0.18;
const SLIP_BY_FORCES: f64 = 0.17;
/// The same of the front wheel, on still ground and on restless ground; of that of which the side has not known for a metre that it is
/// restless; and what the runs add, of the forces on still ground alone.
const FRONT_SLIP: [f64; 2] = [0.88, 0.58];
const FRONT_SLIP_FRESH: f64 = 1.05;
const FRONT_SLIP_BY_MOTION: f64 = 0.32;
const FRONT_SLIP_BY_FORCES: f64 = 0.37;
/// The same of forces and torque, as they are of the front wheel and of the bogie's.
const FRONT: OwnDoubt = OwnDoubt { force: [0.75, 0.27], torque: [0.75, 0.48, 0.42] };
const BOGIE: OwnDoubt = OwnDoubt { force: [0.85, 0.4], torque: [0.89, 0.56, 0.47] };
/// One standard deviation of what a torque may have done on rough ground that its rate, learned over a short way, does not tell yet, N·m.
const TORQUE_UNTOLD: f64 = 0.012;
/// How far an angle lags behind one that turns, rad for each rad/m; so a load, N, and a torque, N·m.
const ANGLE_LAG: f64 = 0.0205;
const LOAD_LAG: f64 = 0.19;
const TORQUE_LAG: f64 = 0.009;
/// One standard deviation of what a wheel's path departs from the terrain by on rough ground, rad: slips and loads that change make it
/// sink in ways that nothing tells.
const ANGLE_UNTOLD: f64 = 0.003;

/// What of the variances that the filters state of a wheel's forces and torque is true.
struct OwnDoubt {
    /// Of the forces on its hub, with what runs of the forces add.
    force: [f64; 2],
    /// Of a torque that is still, with what runs of the forces add; and of one that is as restless as can be, which moves rather by its
    /// trend than at random, and of which the filter knows.
    torque: [f64; 3],
}

/// Of one wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct WheelDoubt<S> {
    /// How many times what the filter states the variance of a contact angle is.
    pub angle: S,
    /// The same of the forces on its hub.
    pub force: S,
    /// The same of its resistive torque.
    pub torque: S,
    /// The same of its slip.
    pub slip: S,
    /// Variance that lag and sinking add to that of the contact angle, rad².
    pub angle_variance: S,
    /// Variance that lag adds to the load, N².
    pub load_variance: S,
    /// Variance that lag, and what is not told yet, add to the resistive torque, (N·m)².
    pub torque_variance: S,
}

/// How what is known of a side came to be known.
#[derive(Debug, Clone, Copy)]
pub(super) struct HowKnown<'a, S> {
    /// Of the variances that the filter states of the front wheel's and of the bogie's, what would be true of angles that have not
    /// drifted at all.
    pub still: &'a [S; 2],
    /// By how much the front wheel's angle differs from that of the wheel behind, squared, up to twice what their errors make of it, rad².
    pub front_unlike: S,
    /// How much of what is known of the contact angles comes from the links' pitches, 0 … 1.
    pub told_by_links: S,
    /// By how much more restless the ground is than it has been over the last metre, 0 … 1.
    pub fresh: S,
    /// How restless the torque of each wheel is, 0 … 1.
    pub restless_torques: PerAxle<S>,
}

/// Of one side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Doubt<S> {
    /// Its wheels.
    pub wheels: PerAxle<WheelDoubt<S>>,
}

impl<S: Scalar> Doubt<S> {
    /// What the runs of how a side moves and of its forces tell, and the trends of its contact angles.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn of<const N: usize, const M: usize>(
        motion: &Runs<S, N>,
        forces: &Runs<S, M>,
        trends: &Trends<S, 3>,
        known: &HowKnown<'_, S>,
    ) -> Self {
        let (of_motion, motion) = (motion.above(1.0), motion.above_chance());
        let (felt, forces) = (forces.above(RUN_OF_FORCES), forces.above_chance());
        let constant = S::constant;
        // The same of all three: the ground's.
        let [rough, ..] = trends.restless();
        let dug = constant(UNKNOWN_ANGLE * UNKNOWN_ANGLE) * known.told_by_links;
        let one = S::one();
        let wheel = |trend: S, restless_torque: S, [angle, met]: [S; 2], slip: S, own: &OwnDoubt| {
            let [force, by_forces] = own.force;
            let [torque, torque_by_forces, torque_restless] = own.torque.map(constant);
            let lag = |length: f64| constant(length * length) * trend * trend;
            let unseen = |std: f64| constant(std * std) * rough;
            WheelDoubt {
                angle,
                force: constant(force) + constant(by_forces) * forces,
                torque: (one - restless_torque) * (torque + torque_by_forces * forces)
                    + restless_torque * torque_restless,
                slip,
                angle_variance: lag(ANGLE_LAG) + unseen(ANGLE_UNTOLD) + dug + met,
                load_variance: lag(LOAD_LAG),
                torque_variance: lag(TORQUE_LAG) + unseen(TORQUE_UNTOLD),
            }
        };
        let torques = &known.restless_torques;
        let [front, middle, rear] = trends.per_m();
        let true_of = |still: S, restless: f64| still + rough * (constant(restless) - still);
        let [of_front, of_bogie] = *known.still;
        let of_front =
            true_of(constant(FRONT_ANGLE_STILL) * of_front, FRONT_ANGLE) + constant(FRONT_ANGLE_BY_MOTION) * of_motion;
        let met = constant(FRONT_ANGLE_UNLIKE) * (one - rough) * known.front_unlike
            + constant(FRONT_ANGLE_FELT * FRONT_ANGLE_FELT) * felt;
        let slip = constant(SLIP) + constant(SLIP_BY_MOTION) * motion + constant(SLIP_BY_FORCES) * forces;
        let [still, restless] = FRONT_SLIP;
        let front_slip = true_of(constant(still), restless)
            + constant(FRONT_SLIP_FRESH) * known.fresh
            + constant(FRONT_SLIP_BY_MOTION) * motion
            + (one - rough) * constant(FRONT_SLIP_BY_FORCES) * forces;
        let of_bogie = [true_of(of_bogie, BOGIE_ANGLE), S::zero()];
        Self {
            wheels: PerAxle {
                front: wheel(front, torques.front, [of_front, met], front_slip, &FRONT),
                middle: wheel(middle, torques.middle, of_bogie, slip, &BOGIE),
                rear: wheel(rear, torques.rear, of_bogie, slip, &BOGIE),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Doubt, HowKnown, PerAxle, Runs, Trends};

    fn doubt(trends: &Trends<f64, 3>) -> Doubt<f64> {
        doubt_of_unlike(0.0, trends)
    }

    fn doubt_of_unlike(front_unlike: f64, trends: &Trends<f64, 3>) -> Doubt<f64> {
        let known = HowKnown {
            still: &[0.7; 2],
            front_unlike,
            told_by_links: 0.0,
            fresh: 0.0,
            restless_torques: PerAxle::all(0.0),
        };
        Doubt::of(&Runs::<f64, 3>::new(), &Runs::<f64, 5>::new(), trends, &known)
    }

    /// Of an angle that turns by 0.5 rad over a metre, 20 mm of lag; of one that does not, on the same ground, only what is untold.
    #[test]
    fn what_turns_lags_and_plane_ground_adds_nothing() {
        let mut trends = Trends::<f64, 3>::new();
        let plane = doubt(&trends).wheels;
        assert!(plane.as_array().into_iter().all(|wheel| wheel.angle_variance == 0.0 && wheel.load_variance == 0.0));
        assert!((plane.front.angle - 0.8 * 0.7).abs() < 1.0e-12);
        assert!([plane.middle, plane.rear].into_iter().all(|wheel| (wheel.angle - 0.7).abs() < 1.0e-12));
        assert!(plane.as_array().into_iter().all(|wheel| wheel.torque_variance == 0.0));
        trends.expect([1.0; 3]);
        trends.follow(0.002, &[(1.0e-3, 1.0), (0.0, 1.0), (0.0, 1.0)]);
        let [turned, ..] = trends.per_m();
        let PerAxle { front, middle, .. } = doubt(&trends).wheels;
        let lag = 0.0205 * turned;
        assert!((front.angle_variance - lag * lag - 0.003 * 0.003).abs() < 1.0e-6 * front.angle_variance);
        assert!((middle.angle_variance - 0.003 * 0.003).abs() < 1.0e-12);
        assert!((middle.torque_variance - 0.012 * 0.012).abs() < 1.0e-12);
        let lag = 0.009 * turned;
        assert!((front.torque_variance - lag * lag - 0.012 * 0.012).abs() < 1.0e-12);
    }

    /// While the ground seems calm, a front wheel whose angle is another than that of the wheel behind may err by most of that, and nobody
    /// else; once the ground is known to be rough, the filter knows as well.
    #[test]
    fn a_front_wheel_that_differs_is_doubted_on_calm_ground() {
        let mut trends = Trends::<f64, 3>::new();
        let calm = doubt_of_unlike(1.0e-4, &trends).wheels;
        assert!((calm.front.angle_variance - 0.82e-4).abs() < 1.0e-12);
        assert_eq!(calm.middle.angle_variance, 0.0);
        trends.expect([1.0; 3]);
        assert!((doubt_of_unlike(1.0e-4, &trends).wheels.front.angle_variance - 0.003 * 0.003).abs() < 1.0e-12);
    }
}
