//! The part of a slip's error that comes from the camera: the velocimeter is one, and what it errs by all wheels share.

use super::slip_torque::{STATES, WheelReadings};
use super::slip_torque_model::travel_over_rim;
use crate::filter::Gaussian;
use crate::scalar::Scalar;

/// How much of a slip's error it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct CameraError<S> {
    variance: S,
}

impl<S: Scalar> CameraError<S> {
    /// Nothing of it.
    pub fn none() -> Self {
        Self { variance: S::zero() }
    }

    /// Its variance.
    pub fn variance(&self) -> S {
        self.variance
    }

    /// Follows the error through an update of filter 1 with a speed of the hub, if there is one, as though it was taken: the gain g of the
    /// slip on that speed takes the new error in, and 1 − g h of the old one stays, h being the slope of the speed in the slip.
    pub fn follow(&mut self, estimate: &Gaussian<S, STATES>, radius_m: S, readings: &WheelReadings<S>) {
        if readings.speeds.hub_speed_m_s.is_none() {
            return;
        }
        let ([rate, _, slip], [_, _, slip_variance]) = (*estimate.mean(), estimate.variances());
        let ratio = travel_over_rim(slip);
        let rim = radius_m * rate;
        let slope = if slip >= S::zero() { rim } else { rim * ratio * ratio };
        let noise = readings.speeds.hub_speed_std_m_s;
        let gain = slope * slip_variance / (noise * noise);
        let kept = S::one() - gain * slope;
        let taken = gain * readings.shared_speed_std_m_s;
        self.variance = (kept * kept * self.variance + taken * taken).min(slip_variance);
    }
}
