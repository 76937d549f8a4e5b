//! The rover network: any one to six wheels of one instant to the soil under all of them.
//!
//! Each wheel passes through the same layer; mean and variance over the wheels go on, so that neither their order nor
//! their number matters to the shape (Zaheer et al. 2017, "Deep Sets", is the pattern).

use heapless::Vec;

use super::rover_head::{HeadInputs, RoverHead};
use super::shape::{OUTPUTS, ROVER_CONTEXT, ROVER_HIDDEN, ROVER_WHEELS, WHEEL_FEATURES};
use super::{Layer, Weights, activate, words};

/// A shared layer for each wheel, a pool, and a head.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverNetwork {
    /// The shared inputs' part in the wheels' layer; the same for each wheel, so it is summed once.
    pub context: Layer<ROVER_CONTEXT, ROVER_HIDDEN>,
    /// A wheel's own part in that layer.
    pub wheel: Weights<WHEEL_FEATURES, ROVER_HIDDEN>,
    /// What follows the pool.
    pub head: RoverHead,
}
words!(RoverNetwork: context, wheel, head);

impl RoverNetwork {
    /// All weights zero.
    pub const ZERO: Self = Self { context: Layer::ZERO, wheel: Weights::ZERO, head: RoverHead::ZERO };

    /// Runs the network on normalised inputs; wheels beyond the sixth are left out, `gradient` is A of equation 13 in the
    /// wheels' layer.
    pub fn run(
        &self,
        context: &[f32; ROVER_CONTEXT],
        inputs: impl IntoIterator<Item = [f32; WHEEL_FEATURES]>,
        gradient: f32,
    ) -> [f32; OUTPUTS] {
        let shared = self.context.apply(context);
        let mut wheels = Vec::<_, ROVER_WHEELS>::new();
        for features in inputs.into_iter().take(ROVER_WHEELS) {
            let mut hidden = shared;
            self.wheel.add_to(&mut hidden, &features);
            activate(&mut hidden, gradient);
            // Not `collect`: heapless panics where it overflows, which the bound above rules out.
            let _ = wheels.push(hidden);
        }
        self.head.run(&pool(&wheels, context))
    }
}

/// The number of wheels as the head sees it: 1 for six, 0 for none.
fn count_feature(count: f32) -> f32 {
    count * (1.0 / ROVER_WHEELS as f32)
}

/// Mean and variance of each neuron over the wheels, then the shared inputs and the number of wheels.
fn pool(wheels: &[[f32; ROVER_HIDDEN]], context: &[f32; ROVER_CONTEXT]) -> HeadInputs {
    let count = wheels.len() as f32;
    let share = if count > 0.0 { 1.0 / count } else { 0.0 };
    let mut pooled = [0.0; 2 * ROVER_HIDDEN];
    let (mean, variance) = pooled.split_at_mut(ROVER_HIDDEN);
    let places = mean.as_chunks_mut().0.iter_mut().zip(variance.as_chunks_mut().0);
    for (place, (mean, variance)) in places.enumerate() {
        let of_wheels = wheels.iter().filter_map(|wheel| wheel.as_chunks().0.get(place));
        (*mean, *variance) = moments(of_wheels, share);
    }
    HeadInputs::new(&pooled, context, count_feature(count))
}

/// Neurons whose means and variances stay in registers together.
const POOL_TILE: usize = 8;

/// Mean and variance of a few neurons over the wheels, of which each has the same `share`.
fn moments<'a>(
    wheels: impl Iterator<Item = &'a [f32; POOL_TILE]> + Clone,
    share: f32,
) -> ([f32; POOL_TILE], [f32; POOL_TILE]) {
    let mut mean = [0.0_f32; POOL_TILE];
    wheels.clone().for_each(|wheel| mean.iter_mut().zip(wheel).for_each(|(m, x)| *m += x));
    mean.iter_mut().for_each(|m| *m *= share);
    let mut variance = [0.0_f32; POOL_TILE];
    for wheel in wheels {
        for ((v, x), m) in variance.iter_mut().zip(wheel).zip(&mean) {
            *v += share * (x - m) * (x - m);
        }
    }
    (mean, variance)
}
