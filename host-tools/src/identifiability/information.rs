//! What an observation says of the soil, and of the lasting errors of the sensors that made it.

use std::ops::{Add, Mul};

use nalgebra::{SMatrix, SVector};

use super::beforehand::PARAMETERS;

/// Unknowns that all wheels share: the soil, the velocimeter's scale, the pitch.
pub const SHARED: usize = PARAMETERS + 2;
/// Place of the velocimeter's scale.
pub const SPEED_SCALE: usize = PARAMETERS;
/// Place of the pitch.
pub const PITCH: usize = PARAMETERS + 1;
/// Unknowns that belong to the sensors of a wheel, or of the wheels of a side: at most so many.
pub const OWN: usize = 6;
/// All unknowns of an observation: shared ones, then own ones. Each in units of what is known of it beforehand.
pub const UNKNOWNS: usize = SHARED + OWN;

/// Changes of channels with the unknowns.
pub type Slopes<const C: usize> = SMatrix<f64, C, UNKNOWNS>;

/// Information on what is shared.
pub type SharedInformation = SMatrix<f64, SHARED, SHARED>;

/// The Fisher information of an observation: adds up over independent instants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Information(SMatrix<f64, UNKNOWNS, UNKNOWNS>);

impl Information {
    /// Nothing was seen.
    pub fn none() -> Self {
        Self(SMatrix::zeros())
    }

    /// Of the first `seen` of C channels, by their slopes and their covariance; none where that has no root.
    pub fn new<const C: usize>(mut slopes: Slopes<C>, covariance: &SMatrix<f64, C, C>, seen: usize) -> Option<Self> {
        let root = covariance.cholesky()?.unpack();
        // A lower triangular root: the first rows do not know of those that were not seen.
        root.solve_lower_triangular_unchecked_mut(&mut slopes);
        slopes.row_iter_mut().skip(seen).for_each(|mut unseen| unseen.fill(0.0));
        Some(Self(slopes.transpose() * slopes))
    }

    /// What is left on the shared unknowns once the own ones, known to their unit beforehand, are integrated out.
    pub fn on_shared(&self) -> Option<SharedInformation> {
        let whole = &self.0;
        let own = whole.fixed_view::<OWN, OWN>(SHARED, SHARED) + SMatrix::<f64, OWN, OWN>::identity();
        let cross = whole.fixed_view::<OWN, SHARED>(SHARED, 0).into_owned();
        let solved = own.cholesky()?.solve(&cross);
        Some(whole.fixed_view::<SHARED, SHARED>(0, 0) - cross.transpose() * solved)
    }
}

impl Add for Information {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Mul<f64> for Information {
    type Output = Self;
    fn mul(self, instants: f64) -> Self {
        Self(self.0 * instants)
    }
}

/// Covariance of channels from independent errors: one column for each, times its standard deviation.
pub fn covariance<const C: usize, const E: usize>(errors: &SMatrix<f64, C, E>) -> SMatrix<f64, C, C> {
    errors * errors.transpose()
}

/// A unit vector.
pub fn unit<const C: usize>(place: usize) -> SVector<f64, C> {
    SVector::from_fn(|row, _| if row == place { 1.0 } else { 0.0 })
}
