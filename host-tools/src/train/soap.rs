//! Adam in the slowly turning eigenbasis of Shampoo's preconditioner (Vyas et al. 2024, "SOAP: Improving and Stabilizing
//! Shampoo using Adam", algorithm 3).
//!
//! The slope G of a layer's weights is a matrix whose rows and columns are correlated, which Adam's step sizes, one a
//! weight, cannot follow. Means of G Gᵀ and Gᵀ G over time have eigenvectors along which it is nearly uncorrelated; there
//! Adam takes its steps. A step of power iteration now and then keeps the eigenvectors up. Of the paper we keep the bias of
//! a layer as a further row of its weights, and the momentum in the turned basis.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::back_propagation::mean_gradient;
use super::cosine_fall::cosine_fall;
use super::example::Example;
use super::loss::{Loss, gaussian};
use super::plan::Passes;
use super::product::{Operand, product};
use super::trainable::{Trainable, change_each, flatten};

/// Decay of the first moment.
const FIRST: f32 = 0.95;
/// Decay of the second moment.
const SECOND: f32 = 0.99;
/// Decay of the means of G Gᵀ and Gᵀ G.
const COVARIANCE: f32 = 0.99;
/// Greatest step size of [`Soap::pass`].
const RATE: f32 = 1e-2;
/// Steps between two updates of the eigenvectors.
const TURN: i32 = 20;

/// State of the method.
pub struct Soap {
    layers: Vec<Layer>,
    step: i32,
    loss: Loss,
}

/// What is remembered of one matrix of weights.
struct Layer {
    rows: Axis,
    columns: Axis,
    /// Moments of the slope in the turned basis.
    first: Vec<f32>,
    second: Vec<f32>,
}

/// One side of a matrix of weights.
struct Axis {
    size: usize,
    /// Mean of the slope's products with itself over the other side.
    covariance: Vec<f32>,
    /// Its eigenvectors, nearly, a column each; the one of the greatest eigenvalue first.
    basis: Vec<f32>,
}

impl Soap {
    /// For a network of that shape, on the Gaussian likelihood.
    pub fn new<N: Trainable>() -> Self {
        let layers = N::matrices().into_iter().map(|[rows, columns]| Layer::new(rows, columns)).collect();
        Self { layers, step: 0, loss: gaussian }
    }

    /// One step on a mini-batch, by the slope at the network that flies for the weights; returns its mean loss before the step.
    pub fn step<N: Trainable>(&mut self, network: &mut N, batch: &[Example<N::Input>], rate: f32) -> f32 {
        let (loss, gradient) = mean_gradient(&network.as_flown(), batch, self.loss);
        change_each(network, self.change(&flatten(&gradient)), |weight, change| *weight -= rate * change);
        network.bound_sums();
        loss
    }

    /// One of the passes over the examples in mini-batches, in the order of their places; `example` makes the one of a place
    /// when its turn comes. The step size rises in the first fiftieth of all passes and falls along a cosine to the last.
    pub fn pass<N: Trainable>(
        &mut self,
        network: &mut N,
        order: &[u32],
        epoch: usize,
        passes: Passes,
        example: impl Fn(usize) -> Example<N::Input> + Sync,
    ) {
        let size = passes.batch.max(1);
        let batches = order.len().div_ceil(size) as f32;
        for (index, places) in order.chunks(size).enumerate() {
            let share = (epoch as f32 + index as f32 / batches) / passes.epochs as f32;
            let batch: Vec<_> = places.par_iter().map(|&place| example(place as usize)).collect();
            self.step(network, &batch, RATE * cosine_fall(share) * (50.0 * share).min(1.0));
        }
    }

    /// The step for a slope, matrix after matrix, at a rate of one.
    fn change(&mut self, slope: &[f32]) -> Vec<f32> {
        self.step += 1;
        let mut rest = slope;
        let mut jobs = Vec::new();
        for layer in &mut self.layers {
            let (own, others) = rest.split_at(layer.first.len());
            jobs.push((layer, own));
            rest = others;
        }
        let step = self.step;
        let changes: Vec<Vec<f32>> = jobs.into_par_iter().map(|(layer, slope)| layer.change(slope, step)).collect();
        changes.concat()
    }
}

impl Layer {
    fn new(rows: usize, columns: usize) -> Self {
        let zero = vec![0.0; rows * columns];
        Self { rows: Axis::new(rows), columns: Axis::new(columns), first: zero.clone(), second: zero }
    }

    fn change(&mut self, slope: &[f32], step: i32) -> Vec<f32> {
        let change = self.normalised(slope, step);
        let matrix = Operand::new(slope, self.columns.size);
        self.rows.remember(&product(matrix, matrix.transposed()));
        self.columns.remember(&product(matrix.transposed(), matrix));
        if step == 1 || step % TURN == 0 {
            let first = self.turned_back(&self.first);
            let (rows, columns) = (self.rows.turn(), &self.columns.turn());
            let places = rows.iter().flat_map(|row| columns.iter().map(move |column| row * columns.len() + column));
            self.second = places.map(|place| self.second[place]).collect();
            self.first = self.turned(&first);
        }
        change
    }

    /// Adam's step in the turned basis, turned back.
    fn normalised(&mut self, slope: &[f32], step: i32) -> Vec<f32> {
        let bias = [FIRST, SECOND].map(|decay| 1.0 - decay.powi(step));
        let mut change = self.turned(slope);
        for ((x, m), v) in change.iter_mut().zip(&mut self.first).zip(&mut self.second) {
            *m = FIRST * *m + (1.0 - FIRST) * *x;
            *v = SECOND * *v + (1.0 - SECOND) * *x * *x;
            *x = (*m / bias[0]) / ((*v / bias[1]).sqrt() + 1e-8);
        }
        self.turned_back(&change)
    }

    fn turned(&self, matrix: &[f32]) -> Vec<f32> {
        let (rows, columns) = (self.rows.basis(), self.columns.basis());
        let left = product(rows.transposed(), Operand::new(matrix, self.columns.size));
        product(Operand::new(&left, self.columns.size), columns)
    }

    fn turned_back(&self, matrix: &[f32]) -> Vec<f32> {
        let (rows, columns) = (self.rows.basis(), self.columns.basis());
        let left = product(rows, Operand::new(matrix, self.columns.size));
        product(Operand::new(&left, self.columns.size), columns.transposed())
    }
}

impl Axis {
    fn new(size: usize) -> Self {
        let unit = DMatrix::<f32>::identity(size, size).as_slice().to_vec();
        Self { size, covariance: vec![0.0; size * size], basis: unit }
    }

    fn basis(&self) -> Operand<'_> {
        Operand::new(&self.basis, self.size)
    }

    fn remember(&mut self, products: &[f32]) {
        let update = |mean: &mut f32, new: &f32| *mean = COVARIANCE * *mean + (1.0 - COVARIANCE) * new;
        self.covariance.iter_mut().zip(products).for_each(|(mean, new)| update(mean, new));
    }

    /// Turns the basis towards the eigenvectors by one step of power iteration; returns which of the former axes stands in
    /// each place.
    fn turn(&mut self) -> Vec<usize> {
        let size = self.size;
        let longer = product(Operand::new(&self.covariance, size), self.basis());
        let column = |matrix: &[f32], c: usize| matrix.iter().skip(c).step_by(size).copied().collect::<Vec<f32>>();
        let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f32>();
        let eigenvalues: Vec<f32> = (0..size).map(|c| dot(&column(&self.basis, c), &column(&longer, c))).collect();
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by(|&a, &b| eigenvalues[b].total_cmp(&eigenvalues[a]));
        // A factor common to all leaves the directions as they are, and far from underflow.
        let scale = 1.0 / eigenvalues[order[0]].max(f32::MIN_POSITIVE);
        let sorted = DMatrix::from_fn(size, size, |row, place| scale * longer[row * size + order[place]]);
        let orthogonal = sorted.qr().q();
        let former = std::mem::take(&mut self.basis);
        self.basis = vec![0.0; size * size];
        for (place, &axis) in order.iter().enumerate() {
            let new: Vec<f32> = orthogonal.column(place).iter().copied().collect();
            // Moments are kept: an axis should not turn round.
            let sign = if dot(&column(&former, axis), &new) < 0.0 { -1.0 } else { 1.0 };
            self.basis.iter_mut().skip(place).step_by(size).zip(new).for_each(|(b, x)| *b = sign * x);
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, SymmetricEigen};

    use super::*;

    const SIZE: usize = 8;

    /// Rotated, its eigenvalues between one and `condition`.
    fn ill_conditioned(condition: f32, seed: u32) -> DMatrix<f32> {
        let wave = DMatrix::from_fn(SIZE, SIZE, |row, column| ((row * SIZE + column) as f32 * 1.7 + seed as f32).sin());
        let axes = wave.qr().q();
        let eigenvalues = (0..SIZE).map(|k| condition.powf(k as f32 / (SIZE - 1) as f32));
        &axes * DMatrix::from_diagonal(&nalgebra::DVector::from_iterator(SIZE, eigenvalues)) * axes.transpose()
    }

    /// Row by row.
    fn listed(matrix: &DMatrix<f32>) -> Vec<f32> {
        matrix.transpose().as_slice().to_vec()
    }

    /// What is left of ½ tr(Wᵀ A W B), whose curvature is the Kronecker product of A and B, after steps of `change`.
    fn descend(mut change: impl FnMut(&[f32]) -> Vec<f32>) -> f32 {
        const STEPS: usize = 1500;
        let (a, b) = (ill_conditioned(100.0, 1), ill_conditioned(100.0, 2));
        let mut weights = DMatrix::from_element(SIZE, SIZE, 1.0_f32);
        let value = |weights: &DMatrix<f32>| 0.5 * (weights.transpose() * &a * weights * &b).trace();
        let before = value(&weights);
        for step in 0..STEPS {
            let rate = 0.02 * (1.0 - step as f32 / STEPS as f32);
            let step = change(&listed(&(&a * &weights * &b)));
            weights -= rate * DMatrix::from_row_slice(SIZE, SIZE, &step);
        }
        value(&weights) / before
    }

    fn soap() -> Soap {
        Soap { layers: vec![Layer::new(SIZE, SIZE)], step: 0, loss: gaussian }
    }

    #[test]
    fn a_rotated_narrow_valley_is_no_obstacle() {
        let mut turning = soap();
        let mut adam = Layer::new(SIZE, SIZE);
        let mut step = 0;
        let in_eigenbasis = descend(|slope| turning.change(slope));
        // The same without ever turning the basis is Adam.
        let along_weights = descend(|slope| {
            step += 1;
            adam.normalised(slope, step)
        });
        assert!(in_eigenbasis < 0.1 * along_weights, "{in_eigenbasis:e} of the start, Adam {along_weights:e}");
    }

    #[test]
    fn the_basis_becomes_that_of_the_eigenvectors() {
        let matrix = ill_conditioned(1000.0, 3);
        let mut axis = Axis::new(SIZE);
        for _ in 0..200 {
            axis.remember(&listed(&matrix));
            axis.turn();
        }
        let basis = DMatrix::from_row_slice(SIZE, SIZE, &axis.basis);
        let error = (basis.transpose() * &basis - DMatrix::identity(SIZE, SIZE)).amax();
        assert!(error < 1e-5, "not orthogonal: {error}");
        let turned = basis.transpose() * &matrix * &basis;
        let mut eigenvalues = SymmetricEigen::new(matrix).eigenvalues.as_slice().to_vec();
        eigenvalues.sort_by(|x, y| y.total_cmp(x));
        for (k, eigenvalue) in eigenvalues.iter().enumerate() {
            assert!((turned[(k, k)] / eigenvalue - 1.0).abs() < 1e-2, "{k}: {}, {eigenvalue}", turned[(k, k)]);
        }
    }

    #[test]
    fn the_same_slopes_give_the_same_bits() {
        let run = || {
            let mut method = soap();
            let change = |step: usize| {
                let slope: Vec<f32> = (0..SIZE * SIZE).map(|k| ((step * 31 + k * 7) as f32).sin()).collect();
                method.change(&slope)
            };
            (0..50).map(change).collect::<Vec<_>>().concat()
        };
        let first: Vec<u32> = run().into_iter().map(f32::to_bits).collect();
        assert!(first.into_iter().eq(run().into_iter().map(f32::to_bits)));
    }
}
