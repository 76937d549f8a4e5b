//! Back-propagation over mini-batches: with momentum as in the seed's references, and with Adam's step sizes.

use rayon::prelude::*;

use super::example::Example;
use super::loss::{Loss, gaussian};
use super::trainable::{Trainable, change_each, flatten, parameter_count};

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

/// Step sizes by the first two moments of the gradient (Kingma & Ba 2015).
pub struct Adam {
    first: Vec<f32>,
    second: Vec<f32>,
    step: i32,
    loss: Loss,
}

impl Adam {
    /// For a network of that shape, on the Gaussian likelihood.
    pub fn new<N: Trainable>(network: &N) -> Self {
        Self::with_loss(network, gaussian)
    }

    /// For a network of that shape, on another loss.
    pub fn with_loss<N: Trainable>(network: &N, loss: Loss) -> Self {
        let count = parameter_count(network);
        Self { first: vec![0.0; count], second: vec![0.0; count], step: 0, loss }
    }

    /// One step on a mini-batch; returns its mean loss before the step.
    pub fn step<N: Trainable>(&mut self, network: &mut N, batch: &[Example<N::Input>], rate: f32) -> f32 {
        let (loss, gradient) = mean_gradient(network, batch, self.loss);
        self.step += 1;
        let (decay_1, decay_2) = (0.9_f32, 0.999_f32);
        let bias_1 = 1.0 - decay_1.powi(self.step);
        let bias_2 = 1.0 - decay_2.powi(self.step);
        let slopes = flatten(&gradient);
        change_each(network, slopes.iter().zip(&mut self.first).zip(&mut self.second), |weight, ((g, m), v)| {
            *m = decay_1 * *m + (1.0 - decay_1) * g;
            *v = decay_2 * *v + (1.0 - decay_2) * g * g;
            *weight -= rate * (*m / bias_1) / ((*v / bias_2).sqrt() + 1e-8);
        });
        loss
    }
}

impl Adam {
    /// Examples in a mini-batch of [`Self::pass`].
    const BATCH: usize = 512;
    /// Greatest step size of [`Self::pass`].
    const RATE: f32 = 4e-3;

    /// One of `epochs` passes over the examples in mini-batches; the step size falls along a cosine from the first to the
    /// last.
    pub fn pass<N: Trainable>(&mut self, network: &mut N, examples: &[Example<N::Input>], epoch: usize, epochs: usize) {
        let batches = examples.len().div_ceil(Self::BATCH) as f32;
        for (index, batch) in examples.chunks(Self::BATCH).enumerate() {
            let share = (epoch as f32 + index as f32 / batches) / epochs as f32;
            let rate = Self::RATE * 0.5 * (1.0 + libm::cosf(std::f32::consts::PI * share)) + 1e-5;
            self.step(network, batch, rate);
        }
    }
}

/// Mean loss and mean gradient over a batch.
pub fn mean_gradient<N: Trainable>(network: &N, batch: &[Example<N::Input>], loss: Loss) -> (f32, N) {
    let size = batch.len().div_ceil(PARTS).max(1);
    let parts: Vec<(f32, N)> = batch
        .par_chunks(size)
        .map(|part| {
            let mut gradient = N::zero();
            let mut total = 0.0;
            for example in part {
                let run = network.run(&example.input);
                let (error, slope) = loss(N::outputs(&run), &example.target);
                network.backward(&example.input, &run, &slope, &mut gradient);
                total += error;
            }
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
    let loss = |example: &Example<N::Input>| {
        let run = network.run(&example.input);
        f64::from(loss(N::outputs(&run), &example.target).0)
    };
    let parts: Vec<f64> =
        set.par_chunks(set.len().div_ceil(PARTS).max(1)).map(|part| part.iter().map(loss).sum()).collect();
    parts.iter().sum::<f64>() / set.len() as f64
}
