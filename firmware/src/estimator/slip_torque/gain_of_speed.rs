//! A wheel that gains more speed than its rover slips more, and meets more torque: by the velocimeter alone the filter would see that late.

use super::{SlipTorqueFilter, WheelReadings};
use crate::estimator::scale::Scale;
use crate::scalar::Scalar;

/// Torque over load and radius, by slip, where nothing slips: of wheels of K0 on sands.
const TORQUE_WITH_SLIP: f64 = 0.85;
/// Where a change of slip that the encoder can just tell is so many standard deviations of the drive's torque, both tell it as well.
const TELLS_AS_WELL: f64 = 1.5;
/// The torque of a wheel that is held back rises faster still, up to such a slip about.
const HELD_BACK: f64 = -0.25;
/// So much of what goes with a gain of speed is no wandering: soils answer to slip each in its own way.
const FORETOLD: f64 = 0.7;

/// Torque that goes with a slip where nothing slips, N·m, of a wheel that holds so much, load times radius. A larger wheel shears its soil
/// over a longer contact.
pub(super) fn torque_per_slip_nm<S: Scalar>(held_nm: S, scale: &Scale<S>) -> S {
    S::constant(TORQUE_WITH_SLIP) * scale.length * held_nm
}

/// How much torque still rises with slip, over how much it does where nothing slips, about, on sand. Of the pull it is the square of this.
fn still_rises<S: Scalar>(slip: S) -> S {
    let grips = (S::one() - slip.max(S::constant(HELD_BACK))).max(S::zero());
    grips * grips
}

impl<S: Scalar> SlipTorqueFilter<S> {
    /// How much the wheel holds the rover to its own speed, in any unit, and so much of the share of its rate that it gained in the last
    /// frame. The pull of one that slips hardly changes with its slip.
    pub fn gained(&self) -> [S; 2] {
        let [.., slip] = *self.filter.estimate().mean();
        let rises = still_rises(slip);
        let holds = rises * rises;
        [holds, holds * self.rim_growth.share()]
    }

    /// Moves slip and torque by what the wheel gained in the frame before beside its rover. On a heavy rover the drive tells a change of slip
    /// better than the encoder, and is left to it.
    pub(super) fn follow_gain(&mut self, readings: &WheelReadings<S>) {
        let [rate, _, slip] = *self.filter.estimate().mean();
        let per_slip_nm = self.torque_per_slip_nm * still_rises(slip * self.scale.length);
        let square = |value: S| value * value;
        let of_encoder = square(per_slip_nm * readings.rate_std_rad_s);
        let of_drive = square(S::constant(TELLS_AS_WELL) * readings.motor_torque_std_nm * rate);
        let of_drive = of_drive.max(S::constant(1.0e-12));
        let counts = of_drive / (of_drive + of_encoder);
        let slipped = counts * (S::one() - slip.abs()) * (self.rim_growth.share() - readings.rover_gained);
        let torque_nm = if rate < S::zero() { -per_slip_nm * slipped } else { per_slip_nm * slipped };
        self.filter.shift(1, torque_nm);
        self.filter.shift(2, slipped);
        self.torque_rate.carry(S::constant(FORETOLD) * torque_nm);
        self.slip_rate.carry(S::constant(FORETOLD) * slipped);
    }
}
