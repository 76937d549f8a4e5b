//! How far the estimates of a frame are from the truth, in their own standard deviations.

use kapvik_firmware::estimator::WheelEstimate;
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::PerWheel;

use crate::data::sensor_channels::WHEEL_NAMES;
use crate::data::truth_file::{Truth, WheelTruth};
use crate::wheel_quantity::WheelQuantity;

/// An estimate that is farther off than allowed, in its standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excess {
    /// The wheel.
    pub wheel: &'static str,
    /// What is estimated.
    pub quantity: &'static str,
    /// How far it is off.
    pub deviation: f64,
    /// How far the drive without the fault is off in the same frame.
    pub undisturbed: f64,
}

/// |Estimate − truth| over the stated standard deviation, of slip, torque, contact angle, load and drawbar pull of each
/// wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviations(pub PerWheel<[f64; 5]>);

impl Deviations {
    /// Those of a frame. A quantity that the truth does not define deviates by nothing, one that only the estimate lacks by
    /// infinity.
    pub fn new(estimate: &FrameEstimate, truth: &Truth) -> Self {
        Self(estimate.wheels.zip_wheels(truth.wheels).map_wheels(|(wheel, truth)| of_wheel(&wheel, &truth)))
    }

    /// The deviation that is farthest above `limit` and above what it is in `others`; none where no one is.
    pub fn worst(&self, limit: f64, others: &Self) -> Option<Excess> {
        let pairs = self.0.iter_wheels().zip(others.0.iter_wheels()).zip(WHEEL_NAMES);
        let excesses =
            pairs.flat_map(|((deviations, others), wheel)| {
                deviations.iter().zip(others).zip(WheelQuantity::ALL).map(move |((deviation, other), quantity)| {
                    Excess { wheel, quantity: quantity.name(), deviation: *deviation, undisturbed: *other }
                })
            });
        let above = |excess: &Excess| excess.deviation - limit.max(excess.undisturbed);
        excesses.filter(|excess| above(excess) > 0.0).max_by(|a, b| above(a).total_cmp(&above(b)))
    }

    /// Whether each is at most `limit`, or at most what it is in `others`.
    pub fn within(&self, limit: f64, others: &Self) -> bool {
        let pairs = self.0.iter_wheels().flatten().zip(others.0.iter_wheels().flatten());
        pairs.into_iter().all(|(deviation, other)| *deviation <= limit.max(*other))
    }
}

fn of_wheel(wheel: &WheelEstimate, truth: &WheelTruth) -> [f64; 5] {
    WheelQuantity::ALL.map(|quantity| match (quantity.estimate(wheel), quantity.truth(truth)) {
        (_, None) => 0.0,
        (None, Some(_)) => f64::INFINITY,
        (Some(estimate), Some(truth)) => (f64::from(estimate.value) - truth).abs() / f64::from(estimate.std),
    })
}
