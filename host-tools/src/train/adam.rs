//! Back-propagation with Adam's step sizes (Kingma & Ba 2015) over mini-batches.

use rayon::prelude::*;

use super::example::Example;
use super::loss::gaussian;
use super::trainable::{Trainable, parameter_count};

/// Parts of a mini-batch that are summed by themselves, so that the result does not depend on the number of cores.
const PARTS: usize = 8;

/// State of the method.
pub struct Adam {
    first: Vec<f32>,
    second: Vec<f32>,
    step: i32,
}

impl Adam {
    /// For a network of that many numbers.
    pub fn new<N: Trainable>(network: &N) -> Self {
        let count = parameter_count(network);
        Self { first: vec![0.0; count], second: vec![0.0; count], step: 0 }
    }

    /// One step on a mini-batch; returns its mean loss before the step.
    pub fn step<N: Trainable>(&mut self, network: &mut N, batch: &[Example<N::Input>], rate: f32) -> f32 {
        let (loss, gradient) = mean_gradient(network, batch);
        self.step += 1;
        let (decay_1, decay_2) = (0.9_f32, 0.999_f32);
        let bias_1 = 1.0 - decay_1.powi(self.step);
        let bias_2 = 1.0 - decay_2.powi(self.step);
        let mut slopes = Vec::with_capacity(self.first.len());
        gradient.for_each(&mut |g| slopes.push(g));
        let mut place = slopes.iter().zip(&mut self.first).zip(&mut self.second);
        network.for_each_mut(&mut |weight| {
            if let Some(((g, m), v)) = place.next() {
                *m = decay_1 * *m + (1.0 - decay_1) * g;
                *v = decay_2 * *v + (1.0 - decay_2) * g * g;
                *weight -= rate * (*m / bias_1) / ((*v / bias_2).sqrt() + 1e-8);
            }
        });
        loss
    }
}

/// Mean loss and mean gradient over a batch.
pub fn mean_gradient<N: Trainable>(network: &N, batch: &[Example<N::Input>]) -> (f32, N) {
    let size = batch.len().div_ceil(PARTS).max(1);
    let parts: Vec<(f32, N)> = batch
        .par_chunks(size)
        .map(|part| {
            let mut gradient = N::zero();
            let mut total = 0.0;
            for example in part {
                let run = network.run(&example.input);
                let (loss, slope) = gaussian(N::outputs(&run), &example.target);
                network.backward(&example.input, &run, &slope, &mut gradient);
                total += loss;
            }
            (total, gradient)
        })
        .collect();
    let share = 1.0 / batch.len() as f32;
    let mut sum = N::zero();
    let mut loss = 0.0;
    for (part_loss, part) in &parts {
        let mut slopes = Vec::new();
        part.for_each(&mut |g| slopes.push(g));
        let mut next = slopes.iter();
        sum.for_each_mut(&mut |g| *g += share * next.next().copied().unwrap_or(0.0));
        loss += share * part_loss;
    }
    (loss, sum)
}
