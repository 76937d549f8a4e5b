//! What measurements told, and what became of them.

use crate::scalar::Scalar;

/// Which measurements are too far from what was expected to be believed.
///
/// A gate believes the filter's own standard deviations. A filter that is surer than it should be, after a start that is wide
/// against the bends of its models or a jump of the state, rejects good measurements, and goes on doing so: nothing they say
/// comes in. The caller sees it in the fates, and lets them in again by more process noise, or by
/// [`SigmaPointFilter::widen`](super::SigmaPointFilter::widen).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Gate<T> {
    /// Rejects a measurement whose squared innovation is more than so many of its variances. The innovation of a good
    /// measurement, squared and so divided, is distributed as χ² with one degree of freedom.
    Above(T),
    /// Rejects nothing.
    Open,
}

impl<T: Scalar> Gate<T> {
    /// Rejects beyond 10.8 variances: one good measurement in a thousand.
    pub fn one_in_a_thousand() -> Self {
        Self::Above(T::constant(10.8))
    }

    /// Whether it lets an innovation of so many variances pass.
    pub(super) fn admits(&self, squared_over_variance: T) -> bool {
        match self {
            Self::Above(threshold) => squared_over_variance <= *threshold,
            Self::Open => true,
        }
    }
}

/// What became of a measurement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It is in the estimate.
    Used,
    /// There was none.
    Missing,
    /// The gate rejected it.
    Rejected,
    /// It was not finite, or what the model expected was not, or its noise was not a finite number of 1e-18 or more.
    NotFinite,
}

/// One measurement against what was expected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual<T> {
    /// What became of the measurement.
    pub fate: Fate,
    /// Measured less expected, in the measurement's unit; zero where missing or not finite.
    pub innovation: T,
    /// Standard deviation of that before the update, in the measurement's unit; zero where not finite.
    pub std: T,
}

impl<T: Scalar> Residual<T> {
    /// The innovation in its standard deviations, where there is one.
    pub fn normalised(&self) -> Option<T> {
        matches!(self.fate, Fate::Used | Fate::Rejected).then(|| self.innovation / self.std)
    }

    /// Whether it is rejected for being off by more than so many standard deviations.
    pub fn is_beyond(&self, stds: T) -> bool {
        self.fate == Fate::Rejected && self.innovation.abs() > stds * self.std
    }

    /// The innovation where it is used, else zero.
    pub(super) fn used(&self) -> T {
        if self.fate == Fate::Used { self.innovation } else { T::zero() }
    }
}

/// How fusing the measurements went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fusion {
    /// The measurements that are [`Fate::Used`] are in the estimate.
    Done,
    /// No measurement could be used: the estimate stayed as it was.
    NothingToFuse,
    /// A factorisation failed: the mean stayed, the root fell back to its stated diagonal, no measurement is in the estimate.
    Reset,
}

/// What `M` measurements told.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub struct Innovation<T, const M: usize> {
    /// How fusing them went.
    pub fusion: Fusion,
    /// Each measurement against what was expected.
    pub residuals: [Residual<T>; M],
    /// The squared innovation of all used measurements jointly, νᵀ S⁻¹ ν: distributed as χ² with as many degrees of freedom as
    /// measurements were used. Zero where none was.
    pub normalised_square: T,
    /// How many measurements were used.
    pub degrees_of_freedom: usize,
}

impl<T: Scalar, const M: usize> Innovation<T, M> {
    /// What a filter was told that has seen no measurement yet.
    pub fn nothing() -> Self {
        let residual = Residual { fate: Fate::Missing, innovation: T::zero(), std: T::zero() };
        Self {
            fusion: Fusion::NothingToFuse,
            residuals: [residual; M],
            normalised_square: T::zero(),
            degrees_of_freedom: 0,
        }
    }

    /// What this update told, and one after it of measurements that were missing here.
    pub fn followed_by(self, later: Self) -> Self {
        let fusion = match (self.fusion, later.fusion) {
            (Fusion::Reset, _) | (_, Fusion::Reset) => Fusion::Reset,
            (Fusion::Done, _) | (_, Fusion::Done) => Fusion::Done,
            (Fusion::NothingToFuse, Fusion::NothingToFuse) => Fusion::NothingToFuse,
        };
        let mut residuals = later.residuals;
        for (residual, before) in residuals.iter_mut().zip(self.residuals) {
            if before.fate != Fate::Missing {
                *residual = before;
            }
        }
        Self {
            fusion,
            residuals,
            normalised_square: self.normalised_square + later.normalised_square,
            degrees_of_freedom: self.degrees_of_freedom.saturating_add(later.degrees_of_freedom),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Fate, Fusion, Innovation, Residual};

    /// Two updates with a measurement each are one with both.
    #[test]
    fn updates_that_follow_each_other_are_told_as_one() {
        let nothing = Innovation::<f64, 2>::nothing();
        let told = |place: usize, fate: Fate, fusion: Fusion| {
            let mut told = Innovation { fusion, normalised_square: 1.5, degrees_of_freedom: 1, ..nothing };
            told.residuals[place] = Residual { fate, innovation: 0.3, std: 0.2 };
            told
        };
        let both = told(0, Fate::Used, Fusion::Done).followed_by(told(1, Fate::Rejected, Fusion::NothingToFuse));
        assert_eq!(both.residuals.map(|residual| residual.fate), [Fate::Used, Fate::Rejected]);
        assert_eq!((both.fusion, both.normalised_square, both.degrees_of_freedom), (Fusion::Done, 3.0, 2));
        assert_eq!(nothing.followed_by(nothing), nothing);
        let reset = told(0, Fate::Used, Fusion::Reset).followed_by(told(1, Fate::Used, Fusion::Done));
        assert_eq!(reset.fusion, Fusion::Reset);
    }
}
