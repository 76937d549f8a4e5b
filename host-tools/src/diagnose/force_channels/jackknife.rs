//! Least squares through instruments, with each run left out in turn: for standard errors that hold where rows of one run are
//! correlated and spreads differ, and for the probability of readings that the fit did not know.
//!
//! Two-stage least squares: the regressors are replaced by their projection on the instruments, which the noise of the
//! readings does not reach (Wooldridge 2010, Econometric Analysis of Cross Section and Panel Data, chapter 5). Standard errors
//! by leaving clusters out: MacKinnon, Nielsen & Webb 2023, "Cluster-robust inference", J. Econometrics 232, their CV3.

use nalgebra::{DMatrix, DVector};

use super::regression::{Problem, Term};
use crate::statistics::root_mean_square;

/// Singular values below this share of the largest count as none.
const SINGULAR: f64 = 1e-10;

/// A fit with each run left out in turn.
#[derive(Debug, Clone)]
pub struct Jackknife {
    /// The coefficient of each term.
    pub coefficients: Vec<f64>,
    /// One standard deviation of each.
    pub std: Vec<f64>,
    /// Runs beyond those that the coefficients use up.
    pub degrees_of_freedom: f64,
    /// ln of the probability density of each run's readings, by the fit without it.
    pub log_scores: Vec<f64>,
}

/// Sums of products of the columns over some rows: all that a fit needs of them.
#[derive(Clone)]
struct Moments {
    /// Instruments by instruments.
    zz: DMatrix<f64>,
    /// Instruments by regressors.
    zx: DMatrix<f64>,
    zy: DVector<f64>,
    xx: DMatrix<f64>,
    xy: DVector<f64>,
    yy: f64,
    rows: f64,
}

struct Solution {
    coefficients: DVector<f64>,
    /// Covariance over the variance of a reading.
    spread: DMatrix<f64>,
    /// Variance of a reading, N².
    variance: f64,
}

impl Jackknife {
    /// Fits the chosen terms; none where they are too many for the runs, or the same.
    pub fn fit(problem: &Problem, chosen: &[&Term]) -> Option<Self> {
        let scales: Vec<f64> = chosen.iter().map(|term| root_mean_square(term.values.iter().copied())).collect();
        if scales.iter().any(|scale| *scale <= 0.0 || !scale.is_finite()) {
            return None;
        }
        let scaled = chosen.iter().zip(&scales).map(|(term, scale)| divided(&term.values, *scale));
        let regressors: Vec<Vec<f64>> = problem.fixed.iter().cloned().chain(scaled).collect();
        let instruments = instruments(problem, chosen, &regressors);
        let count = problem.runs();
        let mut of_run = vec![Moments::none(instruments.len(), regressors.len()); count];
        for row in 0..problem.rows() {
            let (z, x) = (at(&instruments, row), at(&regressors, row));
            of_run[problem.run[row]].add(&z, &x, problem.readings_n[row]);
        }
        let all = of_run.iter().fold(Moments::none(instruments.len(), regressors.len()), |sum, run| sum.with(run, 1.0));
        // Readings are predicted from what the instruments say of a force. Its own reading has noise of its own, which would
        // make a force that is measured well a better answer than the one that acts.
        let projection = inverse(&all.zz)? * &all.zx;
        let whole = all.solve(&projection)?;
        let without: Vec<Solution> =
            of_run.iter().map(|run| all.with(run, -1.0).solve(&projection)).collect::<Option<Vec<_>>>()?;
        let first = problem.fixed.len();
        let share = (count as f64 - 1.0) / count as f64;
        let std = (first..regressors.len()).map(|place| {
            let off = |solution: &Solution| (solution.coefficients[place] - whole.coefficients[place]).powi(2);
            (share * without.iter().map(off).sum::<f64>()).sqrt()
        });
        let mut log_scores = vec![0.0; count];
        for row in 0..problem.rows() {
            let solution = &without[problem.run[row]];
            let projected = projection.tr_mul(&at(&instruments, row));
            log_scores[problem.run[row]] += solution.log_density(&projected, problem.readings_n[row]);
        }
        Some(Self {
            coefficients: scales
                .iter()
                .enumerate()
                .map(|(term, scale)| whole.coefficients[first + term] / scale)
                .collect(),
            std: std.zip(&scales).map(|(std, scale)| std / scale).collect(),
            degrees_of_freedom: count as f64 - regressors.len() as f64,
            log_scores,
        })
    }
}

/// How well the instruments tell of a term beside what is in already: the F statistic of the first stage, for as many
/// observations as there are runs.
pub fn first_stage_strength(problem: &Problem, chosen: &[&Term], term: &Term) -> f64 {
    let own = chosen.iter().filter(|other| !other.by_instruments).map(|other| other.values.clone());
    let known: Vec<Vec<f64>> = problem.fixed.iter().cloned().chain(own).collect();
    let wider: Vec<Vec<f64>> = known.iter().chain(&problem.instruments).cloned().collect();
    let left = |columns: &[Vec<f64>]| {
        let mut moments = Moments::none(columns.len(), columns.len());
        for row in 0..problem.rows() {
            let x = at(columns, row);
            moments.add(&x, &x, term.values[row]);
        }
        moments.left()
    };
    let (before, after) = (left(&known), left(&wider));
    let degrees = problem.runs() as f64 - wider.len() as f64;
    let added = problem.instruments.len() as f64;
    (before - after) / added.max(1.0) * degrees.max(0.0) / after.max(1e-12 * before + f64::MIN_POSITIVE)
}

/// Terms that no force moves are their own instruments.
fn instruments(problem: &Problem, chosen: &[&Term], regressors: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let first = problem.fixed.len();
    let own = chosen.iter().enumerate().filter(|(_, term)| !term.by_instruments);
    let own = own.map(|(place, _)| regressors[first + place].clone());
    let mut found: Vec<Vec<f64>> = problem.fixed.iter().cloned().chain(own).collect();
    if chosen.iter().any(|term| term.by_instruments) {
        found.extend(problem.instruments.iter().cloned());
    }
    found
}

impl Moments {
    fn none(instruments: usize, regressors: usize) -> Self {
        Self {
            zz: DMatrix::zeros(instruments, instruments),
            zx: DMatrix::zeros(instruments, regressors),
            zy: DVector::zeros(instruments),
            xx: DMatrix::zeros(regressors, regressors),
            xy: DVector::zeros(regressors),
            yy: 0.0,
            rows: 0.0,
        }
    }

    fn add(&mut self, z: &DVector<f64>, x: &DVector<f64>, y: f64) {
        self.zz += z * z.transpose();
        self.zx += z * x.transpose();
        self.zy += z * y;
        self.xx += x * x.transpose();
        self.xy += x * y;
        self.yy += y * y;
        self.rows += 1.0;
    }

    fn with(&self, other: &Self, sign: f64) -> Self {
        Self {
            zz: &self.zz + &other.zz * sign,
            zx: &self.zx + &other.zx * sign,
            zy: &self.zy + &other.zy * sign,
            xx: &self.xx + &other.xx * sign,
            xy: &self.xy + &other.xy * sign,
            yy: self.yy + other.yy * sign,
            rows: self.rows + other.rows * sign,
        }
    }

    /// The coefficients; the variance is that about the regressors as `projection` sees them.
    fn solve(&self, projection: &DMatrix<f64>) -> Option<Solution> {
        let regressors = self.xx.nrows();
        let to_instruments = self.zx.transpose() * inverse(&self.zz)?;
        let projected = &to_instruments * &self.zx;
        if regressors > 0 {
            let singular = projected.clone().symmetric_eigenvalues();
            if singular.min() <= SINGULAR * singular.max() {
                return None;
            }
        }
        let spread = inverse(&projected)?;
        let coefficients = &spread * (&to_instruments * &self.zy);
        let seen = projection * &coefficients;
        let squares = self.yy - 2.0 * seen.dot(&self.zy) + seen.dot(&(&self.zz * &seen));
        let variance = squares / (self.rows - regressors as f64);
        // Readings that are all the same, or nearly so, have no noise to measure an effect by.
        (variance > 1e-14 * self.yy / self.rows).then_some(Solution { coefficients, spread, variance })
    }

    /// The sum of squares that ordinary least squares leaves.
    fn left(&self) -> f64 {
        inverse(&self.xx).map_or(self.yy, |inverse| self.yy - self.xy.dot(&(inverse * &self.xy))).max(0.0)
    }
}

impl Solution {
    fn log_density(&self, x: &DVector<f64>, y: f64) -> f64 {
        let variance = self.variance * (1.0 + x.dot(&(&self.spread * x)));
        let off = y - x.dot(&self.coefficients);
        -0.5 * (off * off / variance + (std::f64::consts::TAU * variance).ln())
    }
}

/// The inverse on what a symmetric matrix spans.
fn inverse(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if matrix.nrows() == 0 {
        return Some(matrix.clone());
    }
    let largest = matrix.diagonal().amax();
    matrix.clone().pseudo_inverse(SINGULAR * largest).ok()
}

fn at(columns: &[Vec<f64>], row: usize) -> DVector<f64> {
    DVector::from_iterator(columns.len(), columns.iter().map(|column| column[row]))
}

fn divided(values: &[f64], by: f64) -> Vec<f64> {
    values.iter().map(|value| value / by).collect()
}
