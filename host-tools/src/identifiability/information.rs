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

    /// Of one instant that several sets of sensors saw, whose errors in the velocimeter's scale and in the pitch, known to
    /// their unit beforehand, are this instant's own: what is left on the soil once they are integrated out.
    pub fn of_instant(seen: &[Self]) -> Option<Self> {
        const ERRORS: usize = SHARED - PARAMETERS;
        let mut whole = SharedInformation::zeros();
        for information in seen {
            whole += information.on_shared()?;
        }
        let errors =
            whole.fixed_view::<ERRORS, ERRORS>(PARAMETERS, PARAMETERS) + SMatrix::<f64, ERRORS, ERRORS>::identity();
        let cross = whole.fixed_view::<ERRORS, PARAMETERS>(PARAMETERS, 0).into_owned();
        let solved = errors.cholesky()?.solve(&cross);
        let mut soil = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
        soil.fixed_view_mut::<PARAMETERS, PARAMETERS>(0, 0)
            .copy_from(&(whole.fixed_view::<PARAMETERS, PARAMETERS>(0, 0) - cross.transpose() * solved));
        Some(Self(soil))
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

#[cfg(test)]
mod tests {
    use nalgebra::SMatrix;

    use super::{Information, PARAMETERS, PITCH, SPEED_SCALE, Slopes};

    const CHANNELS: usize = 5;

    fn slopes(phase: f64) -> Slopes<CHANNELS> {
        let mut slopes =
            Slopes::from_fn(|row, column| libm::sin(phase + 2.3 * row as f64 + 0.7 * (column * column) as f64));
        // Own unknowns would be integrated out beside those of the instant.
        slopes.columns_mut(super::SHARED, super::OWN).fill(0.0);
        slopes
    }

    /// An error that two sets of sensors share, integrated out, is the same as noise that their channels share.
    #[test]
    fn an_error_of_an_instant_is_noise_common_to_its_sensors() {
        let (one, other) = (slopes(0.4), slopes(1.9));
        let identity = SMatrix::<f64, CHANNELS, CHANNELS>::identity();
        let information = |slopes| Information::new(slopes, &identity, CHANNELS).unwrap();
        let found = Information::of_instant(&[information(one), information(other)]).unwrap();
        let all = |columns: usize, from: usize| {
            let mut rows = nalgebra::DMatrix::zeros(2 * CHANNELS, columns);
            rows.rows_mut(0, CHANNELS).copy_from(&one.columns(from, columns));
            rows.rows_mut(CHANNELS, CHANNELS).copy_from(&other.columns(from, columns));
            rows
        };
        assert_eq!((SPEED_SCALE, PITCH), (PARAMETERS, PARAMETERS + 1));
        let errors = all(2, SPEED_SCALE);
        let covariance = nalgebra::DMatrix::identity(2 * CHANNELS, 2 * CHANNELS) + &errors * errors.transpose();
        let soil = all(PARAMETERS, 0);
        let expected = soil.transpose() * covariance.cholesky().unwrap().solve(&soil);
        let found = found.on_shared().unwrap().view((0, 0), (PARAMETERS, PARAMETERS)).into_owned();
        assert!((&found - &expected).amax() < 1e-12 * expected.amax(), "{found} {expected}");
    }
}
