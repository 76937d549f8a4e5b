//! The rover network: any one to six wheels of one instant to the soil under all of them.
//!
//! Each wheel passes through the same layers; mean and variance over the wheels go on, so that neither their order nor
//! their number matters to the shape (Zaheer et al. 2017, "Deep Sets", is the pattern).

use heapless::Vec;

use super::shape::{
    CONTEXT_FEATURES, OUTPUTS, ROVER_HEAD, ROVER_HEAD_INPUTS, ROVER_HIDDEN, ROVER_POOLED, ROVER_WHEELS, WHEEL_FEATURES,
};
use super::{Layer, Weights, activate, numbers};

/// Shared per-wheel layers, a pool, and a head.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverNetwork {
    /// The shared inputs' part in the first layer; the same for each wheel, so it is summed once.
    pub context: Layer<CONTEXT_FEATURES, ROVER_HIDDEN>,
    /// A wheel's own part in the first layer.
    pub wheel: Weights<WHEEL_FEATURES, ROVER_HIDDEN>,
    /// Second layer of each wheel, the one that is pooled.
    pub embedding: Layer<ROVER_HIDDEN, ROVER_POOLED>,
    /// Layer behind the pool.
    pub head: Layer<ROVER_HEAD_INPUTS, ROVER_HEAD>,
    /// Linear output: means, then log-variances.
    pub output: Layer<ROVER_HEAD, OUTPUTS>,
}
numbers!(RoverNetwork: context, wheel, embedding, head, output);

/// What the neurons put out for one rover; a trainer needs it to propagate errors back.
#[derive(Debug, Clone)]
pub struct RoverActivations {
    /// First layer and pooled layer of each wheel.
    pub wheels: Vec<([f32; ROVER_HIDDEN], [f32; ROVER_POOLED]), ROVER_WHEELS>,
    /// Inputs of the head: means, variances, shared inputs, number of wheels.
    pub pool: [f32; ROVER_HEAD_INPUTS],
    /// Of the head.
    pub head: [f32; ROVER_HEAD],
    /// Of the output layer.
    pub output: [f32; OUTPUTS],
}

impl RoverNetwork {
    /// All weights zero.
    pub const ZERO: Self = Self {
        context: Layer::ZERO,
        wheel: Weights::ZERO,
        embedding: Layer::ZERO,
        head: Layer::ZERO,
        output: Layer::ZERO,
    };

    /// Runs the network on normalised inputs; wheels beyond the sixth are left out, `gradient` is A of equation 13.
    pub fn run(
        &self,
        context: &[f32; CONTEXT_FEATURES],
        wheels: impl IntoIterator<Item = [f32; WHEEL_FEATURES]>,
        gradient: f32,
    ) -> RoverActivations {
        let shared = self.context.apply(context);
        let mut activations = Vec::<_, ROVER_WHEELS>::new();
        for features in wheels.into_iter().take(ROVER_WHEELS) {
            let hidden = activate(self.wheel.add_to(shared, &features), gradient);
            // Not `collect`: heapless panics where it overflows, which the bound above rules out.
            let _ = activations.push((hidden, activate(self.embedding.apply(&hidden), gradient)));
        }
        let pool = pool(activations.iter().map(|(_, embedded)| embedded), context);
        let head = activate(self.head.apply(&pool), gradient);
        RoverActivations { wheels: activations, pool, head, output: self.output.apply(&head) }
    }
}

/// The number of wheels as the head sees it: 1 for six, 0 for none.
pub(super) fn count_feature(count: f32) -> f32 {
    count * (1.0 / ROVER_WHEELS as f32)
}

/// Mean and variance of each pooled neuron over the wheels, then the shared inputs and the number of wheels.
fn pool<'a>(
    embedded: impl Iterator<Item = &'a [f32; ROVER_POOLED]> + Clone,
    context: &[f32; CONTEXT_FEATURES],
) -> [f32; ROVER_HEAD_INPUTS] {
    let mut count = 0.0_f32;
    let mut mean = [0.0_f32; ROVER_POOLED];
    for wheel in embedded.clone() {
        count += 1.0;
        mean.iter_mut().zip(wheel).for_each(|(m, x)| *m += x);
    }
    let share = if count > 0.0 { 1.0 / count } else { 0.0 };
    mean.iter_mut().for_each(|m| *m *= share);
    let mut variance = [0.0_f32; ROVER_POOLED];
    for wheel in embedded {
        for ((v, x), m) in variance.iter_mut().zip(wheel).zip(&mean) {
            *v += share * (x - m) * (x - m);
        }
    }
    let mut pool = [0.0; ROVER_HEAD_INPUTS];
    let values = mean.iter().chain(&variance).chain(context).copied().chain([count_feature(count)]);
    pool.iter_mut().zip(values).for_each(|(place, value)| *place = value);
    pool
}
