//! The readings of a linear campaign as one Gaussian vector with a dense covariance matrix: the reference.

use nalgebra::{DMatrix, DVector};

use super::toy::Linear;
use crate::diagnose::fit::{CHANNELS, Options, Row, Start};

/// All readings, their mean as a function of the parameters (`x θ + fixed`), and their covariance.
pub struct Dense {
    /// Row and channel of each reading.
    pub place: Vec<(usize, usize)>,
    pub y: DVector<f64>,
    pub x: DMatrix<f64>,
    pub fixed: DVector<f64>,
    pub v: DMatrix<f64>,
}

impl Dense {
    pub fn new(
        model: &Linear,
        rows: &[Row],
        options: &Options,
        offset: &[f64; CHANNELS],
        noise: &[f64; CHANNELS],
    ) -> Self {
        let start = Start::at(vec![0.0; model.coordinates.len()], rows);
        let mut place = Vec::new();
        for (index, row) in rows.iter().enumerate() {
            place.extend((0..CHANNELS).filter(|&c| row.readings[c].is_some()).map(|c| (index, c)));
        }
        let size = |run: usize| rows.iter().filter(|row| row.run == run).count();
        let zeros = vec![0.0; model.coordinates.len()];
        let v = DMatrix::from_fn(place.len(), place.len(), |i, j| {
            let ((row, c), (other, d)) = (place[i], place[j]);
            let mut covariance = 0.0;
            if row == other {
                let terms = &model.terms[row];
                covariance += options.latent_prior_std[0].powi(2) * terms.slip[c] * terms.slip[d]
                    + options.latent_prior_std[1].powi(2) * terms.load[c] * terms.load[d];
            }
            if i == j {
                covariance += (noise[c] * rows[row].noise[c]).powi(2);
            }
            let run = rows[row].run;
            if c == d && run == rows[other].run && size(run) >= options.smallest_run_with_offset {
                covariance += offset[c].powi(2);
            }
            covariance
        });
        Self {
            y: DVector::from_iterator(place.len(), place.iter().filter_map(|&(row, c)| rows[row].readings[c])),
            x: DMatrix::from_fn(place.len(), zeros.len(), |i, p| model.terms[place[i].0].parameters[p][place[i].1]),
            fixed: DVector::from_fn(place.len(), |i, _| {
                model.value(place[i].0, &zeros, &start.latents[place[i].0])[place[i].1]
            }),
            v,
            place,
        }
    }

    /// Generalised least squares: the parameters and their covariance.
    pub fn estimate(&self) -> (DVector<f64>, DMatrix<f64>) {
        let inverse = self.v.clone().cholesky().unwrap().inverse();
        let covariance = (self.x.transpose() * &inverse * &self.x).cholesky().unwrap().inverse();
        (&covariance * self.x.transpose() * inverse * (&self.y - &self.fixed), covariance)
    }

    /// ln of the density at some parameters.
    pub fn ln_density(&self, parameters: &[f64]) -> f64 {
        gaussian(&(&self.y - &self.fixed - &self.x * DVector::from_column_slice(parameters)), &self.v)
    }

    /// Restricted log-likelihood at the estimate, but for a constant.
    pub fn restricted(&self) -> f64 {
        let (parameters, covariance) = self.estimate();
        self.ln_density(parameters.as_slice()) + 0.5 * covariance.determinant().ln()
    }
}

/// ln of the normal density of `residual` with mean zero.
pub fn gaussian(residual: &DVector<f64>, covariance: &DMatrix<f64>) -> f64 {
    let factor = covariance.clone().cholesky().unwrap();
    let ln_det = 2.0 * factor.l().diagonal().map(f64::ln).sum();
    let norm = residual.len() as f64 * (2.0 * std::f64::consts::PI).ln();
    -0.5 * (residual.dot(&factor.solve(residual)) + ln_det + norm)
}
