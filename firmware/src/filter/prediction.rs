//! The estimate a step later.

use crate::scalar::Scalar;

use super::reflection::{Reflection, triangularise};
use super::transform::{Output, transform};
use super::vector::{scale, transposed};
use super::{Gaussian, InvalidNumber, SigmaPointFilter};

/// How a prediction went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[must_use]
pub enum Prediction {
    /// The estimate is that of a step later.
    Done,
    /// The model's output was not finite at some sigma point: the mean stayed, the noise was added.
    ModelNotFinite,
    /// A factorisation failed: the mean stayed, the root fell back to its stated diagonal.
    Reset,
}

impl<T: Scalar, const N: usize> SigmaPointFilter<T, N> {
    /// Carries the estimate through a process model, and adds independent noise with these standard deviations per step.
    ///
    /// Cost: 2 N + 1 evaluations of the model, and about 2 N³ multiplications with addition.
    pub fn predict(&mut self, model: impl Fn(&[T; N]) -> [T; N], noise_std: &[T; N]) -> Prediction {
        let mut outputs = [Output::blank(); N];
        transform(&self.estimate, &self.factors, &model, &mut outputs);
        if !outputs.iter().all(Output::is_finite) {
            return match self.random_walk(noise_std) {
                Prediction::Done => Prediction::ModelNotFinite,
                other => other,
            };
        }
        triangularise(noise_std, &mut outputs, Output::rows, &mut self.estimate.root);
        let mut mean = self.estimate.mean;
        mean.iter_mut().zip(&outputs).for_each(|(place, output)| *place = output.mean);
        self.finish(mean)
    }

    /// The prediction of states that only drift: adds independent noise with these standard deviations per step.
    ///
    /// Cost: no evaluation of a model, and about N³ multiplications with addition.
    pub fn random_walk(&mut self, noise_std: &[T; N]) -> Prediction {
        let mut columns = transposed(&self.estimate.root);
        triangularise(noise_std, &mut columns, <[T; N]>::as_mut_slice, &mut self.estimate.root);
        self.finish(self.estimate.mean)
    }

    /// As [`Self::random_walk`], with noise that is independent in other coordinates: `to` brings a deviation of the state to these, and
    /// `back` brings one from them to the state as it is a step later, whose mean is `mean`. Both are linear.
    ///
    /// Cost: as [`Self::random_walk`], and N evaluations of each.
    pub fn random_walk_in(
        &mut self,
        to: impl Fn(&[T; N]) -> [T; N],
        back: impl Fn(&[T; N]) -> [T; N],
        mean: [T; N],
        noise_std: &[T; N],
    ) -> Prediction {
        self.estimate.root.iter_mut().for_each(|column| *column = to(column));
        let told = self.random_walk(noise_std);
        if told != Prediction::Done {
            return told;
        }
        self.estimate.root.iter_mut().for_each(|column| *column = back(column));
        self.finish(mean)
    }

    /// Adds noise that several states share: its covariance is G Gᵀ, with G given by its columns.
    ///
    /// Cost: about (N + K) N² multiplications with addition.
    pub fn add_correlated_noise<const K: usize>(&mut self, noise_columns: &[[T; N]; K]) -> Prediction {
        let triangular = self.random_walk(&[T::zero(); N]);
        if triangular == Prediction::Reset {
            return triangular;
        }
        let mut columns = transposed(noise_columns);
        let mut rest = columns.as_mut_slice();
        for (index, row) in self.estimate.root.iter_mut().enumerate() {
            let Some((column, trailing)) = rest.split_first_mut() else { break };
            let mut entries = row.iter_mut().skip(index);
            let Some(diagonal) = entries.next() else { break };
            let (reflection, norm) = Reflection::new(*diagonal, column);
            *diagonal = norm;
            for (entry, other) in entries.zip(trailing.iter_mut()) {
                *entry = reflection.apply_below(*entry, other);
            }
            rest = trailing;
        }
        self.finish(self.estimate.mean)
    }

    /// One state has changed by so much, which is known: its mean moves, and nothing is less sure. Nothing happens where there is no state of
    /// that index, or where the mean would not be finite.
    pub fn shift(&mut self, index: usize, by: T) {
        if let Some(place) = self.estimate.mean.get_mut(index).filter(|place| (**place + by).is_finite()) {
            *place += by;
        }
    }

    /// Forgets one state alone: it becomes `mean` with standard deviation `std`, independent of the others, of which
    /// everything stays known. Nothing happens where there is no state of that index.
    ///
    /// # Errors
    /// Where `mean` is not finite, or `std` negative or its square not finite.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn forget(&mut self, index: usize, mean: T, std: T) -> Result<Prediction, InvalidNumber> {
        Gaussian::independent([mean], [std])?;
        let mut noise_std = [T::zero(); N];
        if let (Some(place), Some(noise)) = (self.estimate.mean.get_mut(index), noise_std.get_mut(index)) {
            (*place, *noise) = (mean, std);
        }
        self.estimate.root.iter_mut().filter_map(|column| column.get_mut(index)).for_each(|entry| *entry = T::zero());
        Ok(self.random_walk(&noise_std))
    }

    /// Multiplies every standard deviation by `factor`, and leaves mean and correlations as they are: for a filter that has
    /// turned out to be surer than it should be.
    pub fn widen(&mut self, factor: T) -> Prediction {
        scale(self.estimate.root.as_flattened_mut(), factor);
        self.random_walk(&[T::zero(); N])
    }

    fn finish(&mut self, mean: [T; N]) -> Prediction {
        if self.settle(mean, T::zero()) { Prediction::Done } else { Prediction::Reset }
    }
}

#[cfg(test)]
mod tests {
    use super::{Gaussian, Prediction, SigmaPointFilter};

    /// The sigma points of a linear model are its root's columns: x₀ goes on by 0.3 x₁, and 1.
    #[test]
    fn a_linear_model_is_predicted_by_the_columns_of_the_root() {
        let start = Gaussian::independent([1.0_f64, 2.0], [0.5, 0.7]).expect("numbers");
        let filter = SigmaPointFilter::new(start, [1.0, 1.0]).expect("numbers");
        let (mut found, mut expected) = (filter, filter);
        let told = found.random_walk_in(|[a, b]| [a + 0.3 * b, *b], |column| *column, [2.6, 2.0], &[0.3, 0.4]);
        assert_eq!(told, expected.predict(|[a, b]| [a + 0.3 * b + 1.0, *b], &[0.3, 0.4]));
        assert_eq!(told, Prediction::Done);
        check_alike(&found, &expected);
    }

    /// Mean and covariance are the same but for rounding.
    fn check_alike(found: &SigmaPointFilter<f64, 2>, expected: &SigmaPointFilter<f64, 2>) {
        for (one, other) in [(0, 0), (0, 1), (1, 1)] {
            let covariance = |filter: &SigmaPointFilter<f64, 2>| filter.estimate().covariance(one, other);
            let difference = covariance(found).zip(covariance(expected)).map(|(a, b)| (a - b).abs());
            assert!(difference.is_some_and(|difference| difference < 1.0e-12), "{one} {other}");
        }
        let means = found.estimate().mean().iter().zip(expected.estimate().mean());
        assert!(means.into_iter().all(|(found, expected)| (found - expected).abs() < 1.0e-12));
    }

    /// y = (x₀, 2 x₀ + x₁) with independent noise in y is noise in x with the columns (σ₀, −2 σ₀) and (0, σ₁).
    #[test]
    fn independent_noise_in_other_coordinates_is_correlated_noise_in_the_state() {
        let start = Gaussian::independent([1.0_f64, 2.0], [0.5, 0.7]).expect("numbers");
        let filter = SigmaPointFilter::new(start, [1.0, 1.0]).expect("numbers");
        let (mut found, mut expected) = (filter, filter);
        let (to, back) = (|[a, b]: &[f64; 2]| [*a, 2.0 * a + b], |[a, b]: &[f64; 2]| [*a, b - 2.0 * a]);
        let told = found.random_walk_in(to, back, [3.0, 4.0], &[0.3, 0.4]);
        assert_eq!((told, found.estimate().mean()), (Prediction::Done, &[3.0, 4.0]));
        assert_eq!(expected.add_correlated_noise(&[[0.3, -0.6], [0.0, 0.4]]), Prediction::Done);
        let start = Gaussian { mean: [3.0, 4.0], ..*expected.estimate() };
        expected.restart(start);
        check_alike(&found, &expected);
    }
}
