//! Back-propagation over mini-batches: with momentum as in the seed's references, and with Adam's step sizes.

use rayon::prelude::*;

use super::example::Example;
use super::loss::{Loss, gaussian};
use super::moments::Moments;
use super::trainable::{Trainable, change_each, flatten, parameter_count, sum_of_losses};

/// Parts of a mini-batch that are summed by themselves, so that the result does not depend on the number of cores.
const PARTS: usize = 8;

/// Gradient descent with momentum.
pub struct Momentum {
    velocity: Vec<f32>,
}

impl Momentum {
    const DECAY: f32 = 0.9;
    /// A gradient longer than this is cut to it.
    const LONGEST: f32 = 1.0;

    /// For a network of that many numbers.
    pub fn new<N: Trainable>(network: &N) -> Self {
        Self { velocity: vec![0.0; parameter_count(network)] }
    }

    /// One step on a mini-batch; returns its mean loss before the step.
    pub fn step<N: Trainable>(&mut self, network: &mut N, batch: &[Example<N::Input>], rate: f32) -> f32 {
        let (loss, gradient) = mean_gradient(network, batch, gaussian);
        let slopes = flatten(&gradient);
        let length = slopes.iter().map(|g| g * g).sum::<f32>().sqrt();
        let cut = (Self::LONGEST / length).min(1.0);
        change_each(network, slopes.iter().zip(&mut self.velocity), |weight, (g, v)| {
            *v = Self::DECAY * *v - rate * cut * g;
            *weight += *v;
        });
        loss
    }
}

/// Back-propagation with the step sizes of [`Moments`].
pub struct Adam {
    moments: Moments,
    loss: Loss,
}

impl Adam {
    /// For a network of that shape, on the Gaussian likelihood.
    pub fn new<N: Trainable>(network: &N) -> Self {
        Self::with_loss(network, gaussian)
    }

    /// For a network of that shape, on another loss.
    pub fn with_loss<N: Trainable>(network: &N, loss: Loss) -> Self {
        Self { moments: Moments::new(network), loss }
    }

    /// One step on a mini-batch; returns its mean loss before the step.
    pub fn step<N: Trainable>(&mut self, network: &mut N, batch: &[Example<N::Input>], rate: f32) -> f32 {
        let (loss, gradient) = mean_gradient(network, batch, self.loss);
        self.moments.step(network, &flatten(&gradient), rate);
        loss
    }
}

/// Mean loss and mean gradient over a batch.
pub fn mean_gradient<N: Trainable>(network: &N, batch: &[Example<N::Input>], loss: Loss) -> (f32, N) {
    let size = batch.len().div_ceil(PARTS).max(1);
    let parts: Vec<(f32, N)> = batch
        .par_chunks(size)
        .map(|part| {
            let mut gradient = N::zero();
            let total = sum_of_losses(network, part, loss, Some(&mut gradient));
            (total, gradient)
        })
        .collect();
    let share = 1.0 / batch.len() as f32;
    let mut sum = N::zero();
    let mut mean = 0.0;
    for (part_loss, part) in &parts {
        change_each(&mut sum, flatten(part), |total, g| *total += share * g);
        mean += share * part_loss;
    }
    (mean, sum)
}

/// Mean negative log-likelihood over a set.
pub fn mean_loss<N: Trainable>(network: &N, set: &[Example<N::Input>]) -> f64 {
    mean_of(network, set, gaussian)
}

/// Mean of any loss over a set.
pub fn mean_of<N: Trainable>(network: &N, set: &[Example<N::Input>], loss: Loss) -> f64 {
    // Parts short enough that their sums keep their digits.
    let parts: Vec<f64> = set.par_chunks(256).map(|part| f64::from(sum_of_losses(network, part, loss, None))).collect();
    parts.iter().sum::<f64>() / set.len() as f64
}
