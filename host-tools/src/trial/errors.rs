//! Errors of the wheels' estimates against the truth, quantity by quantity, beside those of the raw sensors.

use std::iter::Sum;

use kapvik_firmware::estimator::Estimate;
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::PerWheel;

use super::Quantity;
use super::tally::Tally;
use crate::data::truth_file::Truth;
use crate::replay::naive::NaiveWheel;
use crate::wheel_quantity::WheelQuantity;

/// Errors of a drive.
#[derive(Debug, Clone, Copy, Default)]
pub struct Errors {
    tallies: [Tally; Quantity::ALL.len()],
}

impl Sum for Errors {
    /// The errors of all drives together.
    fn sum<I: Iterator<Item = Self>>(drives: I) -> Self {
        drives.fold(Self::default(), |mut sum, drive| {
            sum.tallies.iter_mut().zip(&drive.tallies).for_each(|(sum, part)| sum.add(part));
            sum
        })
    }
}

impl Errors {
    /// The errors in a quantity.
    pub fn of(&self, quantity: Quantity) -> &Tally {
        &self.tallies[quantity as usize]
    }

    /// Takes the estimates of a frame, what that frame and the last second of the raw sensors say, and the truth.
    pub fn take(
        &mut self,
        estimate: &FrameEstimate,
        now: &PerWheel<NaiveWheel>,
        second: &PerWheel<NaiveWheel>,
        truth: &Truth,
    ) {
        let wheels = estimate.wheels.zip_wheels(now.zip_wheels(*second)).zip_wheels(truth.wheels);
        for (place, ((wheel, (now, second)), truth)) in wheels.iter_wheels().enumerate() {
            for quantity in WheelQuantity::ALL {
                let (Some(estimate), Some(truth)) = (quantity.estimate(wheel), quantity.truth(truth)) else { continue };
                let raw = [now, second].map(|raw| raw.of(quantity));
                self.take_one(Quantity::of_wheel(quantity, is_front(place)), estimate, raw, truth);
            }
            if !is_front(place) {
                let by_load = Estimate { value: wheel.drawbar_pull_by_load_n, std: 0.0 };
                let raw = [now, second].map(|raw| raw.drawbar_pull_n);
                self.take_one(Quantity::LoadSplitPull, by_load, raw, truth.drawbar_pull_n);
            }
        }
        let raw_pull = |wheels: &PerWheel<NaiveWheel>| {
            wheels.map(|side| Some(side.middle.drawbar_pull_n? + side.rear.drawbar_pull_n?))
        };
        let pulls = estimate.bogie_drawbar_pull_n.zip(raw_pull(now).zip(raw_pull(second)));
        let truth = truth.wheels.map(|side| side.middle.drawbar_pull_n + side.rear.drawbar_pull_n);
        for ((estimate, (now, second)), truth) in pulls.zip(truth).as_array() {
            self.take_one(Quantity::BogiePull, *estimate, [*now, *second], *truth);
        }
    }

    /// A truth that a file does not tell is NaN, and counts nothing.
    pub(super) fn take_one(
        &mut self,
        quantity: Quantity,
        estimate: Estimate,
        [now, second]: [Option<f64>; 2],
        truth: f64,
    ) {
        if truth.is_finite() {
            self.tallies[quantity as usize].take(estimate, now, second, truth);
        }
    }
}

/// Whether the wheel in this place, in the order of the files, is a front one: each side has three, of which it comes first.
pub(super) fn is_front(place: usize) -> bool {
    place.is_multiple_of(3)
}
