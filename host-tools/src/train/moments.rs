//! Step sizes by the first two moments of the gradient (Kingma & Ba 2015, "Adam").

use kapvik_firmware::network::Words;

use super::trainable::{change_each, parameter_count};

/// Moments of the gradient of each number of a network.
pub struct Moments {
    first: Vec<f32>,
    second: Vec<f32>,
    step: i32,
}

impl Moments {
    /// For a network of that shape.
    pub fn new<N: Words>(network: &N) -> Self {
        let count = parameter_count(network);
        Self { first: vec![0.0; count], second: vec![0.0; count], step: 0 }
    }

    /// One step against the slopes of the loss, which are in the order of the numbers.
    pub fn step<N: Words>(&mut self, network: &mut N, slopes: &[f32], rate: f32) {
        self.step += 1;
        let (decay_1, decay_2) = (0.9_f32, 0.999_f32);
        let bias_1 = 1.0 - decay_1.powi(self.step);
        let bias_2 = 1.0 - decay_2.powi(self.step);
        change_each(network, slopes.iter().zip(&mut self.first).zip(&mut self.second), |weight, ((g, m), v)| {
            *m = decay_1 * *m + (1.0 - decay_1) * g;
            *v = decay_2 * *v + (1.0 - decay_2) * g * g;
            *weight -= rate * (*m / bias_1) / ((*v / bias_2).sqrt() + 1e-8);
        });
    }
}
