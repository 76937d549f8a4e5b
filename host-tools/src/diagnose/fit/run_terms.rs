//! One run with its rows' latents and its offsets eliminated.

use nalgebra::{DMatrix, DVector, Vector2};

use super::model::Prediction;
use super::observation::{CHANNELS, ChannelMatrix, Channels, ParameterByChannel};
use super::problem::Problem;
use super::row_terms::{RowTerms, shift_by};
use super::state::{Scales, State};

/// What a run says of the parameters once latents and offsets follow them.
pub(super) struct RunTerms {
    pub rows: Vec<RowTerms>,
    /// Channels that have an offset here.
    pub active: [bool; CHANNELS],
    /// Covariance of the offsets at given parameters; 0 without one.
    pub offset_covariance: ChannelMatrix,
    /// Negative slope of the objective along the offsets.
    offset_pull: Channels,
    /// Mixed curvature of parameters and offsets.
    pub cross: ParameterByChannel,
    /// Curvature of the objective along the parameters.
    pub information: DMatrix<f64>,
    /// Negative slope of the objective along the parameters.
    pub pull: DVector<f64>,
    /// ln det of all that was eliminated.
    pub ln_det: f64,
    sums: Sums,
}

impl RunTerms {
    /// Terms of a run; `damping` lengthens the diagonals of latents and offsets.
    pub(super) fn new(problem: &Problem<'_>, state: &State, scales: &Scales, run: usize, damping: f64) -> Self {
        let places = 0..problem.runs[run].rows.len();
        let rows: Vec<RowTerms> =
            places.map(|place| RowTerms::new(problem, state, scales, (run, place), damping)).collect();
        let active = active_offsets(problem, scales, run, &rows);
        let count = state.parameters.len();
        let mut sums = Sums::new(count);
        for (row, prediction) in rows.iter().zip(&state.predictions[run]) {
            sums.add(row, prediction);
        }
        let mut terms = Self {
            active,
            offset_covariance: ChannelMatrix::zeros(),
            offset_pull: Channels::zeros(),
            cross: ParameterByChannel::zeros(count),
            information: DMatrix::zeros(count, count),
            pull: DVector::zeros(count),
            ln_det: 0.0,
            rows,
            sums,
        };
        terms.eliminate_offsets(&state.offsets[run], scales, damping);
        terms
    }

    /// Lets the offsets, of these standard deviations, follow the parameters.
    pub(super) fn eliminate_offsets(&mut self, offsets: &Channels, scales: &Scales, damping: f64) {
        self.sums.whole(&mut self.information);
        self.pull.copy_from(&self.sums.pull);
        self.ln_det = self.rows.iter().map(|row| row.ln_det).sum();
        if !self.active.contains(&true) {
            return;
        }
        let precision =
            Channels::from_fn(|c, _| if self.active[c] { 1.0 / (scales.offset[c] * scales.offset[c]) } else { 0.0 });
        let mut curvature = self.rows.iter().map(|row| row.information).sum::<ChannelMatrix>();
        for c in 0..CHANNELS {
            if self.active[c] {
                curvature[(c, c)] = (curvature[(c, c)] + precision[c]) * (1.0 + damping);
                self.cross.column_mut(c).copy_from(&self.sums.cross.column(c));
            } else {
                curvature.row_mut(c).fill(0.0);
                curvature.column_mut(c).fill(0.0);
                curvature[(c, c)] = 1.0;
            }
        }
        // The prior of the offsets keeps this positive definite.
        let Some(factor) = curvature.cholesky() else { return };
        self.ln_det += 2.0 * factor.l_dirty().diagonal().map(f64::ln).sum();
        let mask = Channels::from_fn(|c, _| if self.active[c] { 1.0 } else { 0.0 });
        let pull: Channels = self.rows.iter().map(|row| row.pull).sum();
        self.offset_pull = Channels::component_mul(&mask, &(pull - precision.component_mul(offsets)));
        self.offset_covariance = ChannelMatrix::component_mul(&factor.inverse(), &(mask * mask.transpose()));
        let gain = &self.cross * self.offset_covariance;
        for c in (0..CHANNELS).filter(|&c| self.active[c]) {
            self.information.ger(-1.0, &gain.column(c), &self.cross.column(c), 1.0);
        }
        self.pull -= gain * self.offset_pull;
    }

    /// Steps of the offsets and latents that go with a step of the parameters.
    pub(super) fn follow(&self, predictions: &[Prediction], step: &DVector<f64>) -> (Channels, Vec<Vector2<f64>>) {
        let offset = self.offset_covariance * (self.offset_pull - self.cross.tr_mul(step));
        let latents =
            self.rows.iter().zip(predictions).map(|(row, prediction)| {
                row.latent_step(&(shift_by(prediction, &row.weight, step.as_slice()) + offset))
            });
        (offset, latents.collect())
    }
}

/// Channels of a run that have an offset: those of a run of enough rows, with a reading, and a τ.
fn active_offsets(problem: &Problem<'_>, scales: &Scales, run: usize, rows: &[RowTerms]) -> [bool; CHANNELS] {
    let large = problem.runs[run].rows.len() >= problem.options.smallest_run_with_offset;
    std::array::from_fn(|c| large && scales.offset[c] > 0.0 && rows.iter().any(|row| row.weight[c] > 0.0))
}

/// Sums over the rows of a run, offsets where they are.
struct Sums {
    /// Curvature along the parameters: its upper triangle.
    information: DMatrix<f64>,
    /// Mixed curvature of parameters and the channels' offsets.
    cross: ParameterByChannel,
    pull: DVector<f64>,
    /// Of the row at hand, the derivatives by each parameter.
    derivatives: Vec<Channels>,
}

impl Sums {
    fn new(count: usize) -> Self {
        Self {
            information: DMatrix::zeros(count, count),
            cross: ParameterByChannel::zeros(count),
            pull: DVector::zeros(count),
            derivatives: Vec::with_capacity(count),
        }
    }

    fn add(&mut self, row: &RowTerms, prediction: &Prediction) {
        let measured = |by: &[f64; CHANNELS]| Channels::from_fn(|c, _| if row.weight[c] > 0.0 { by[c] } else { 0.0 });
        self.derivatives.clear();
        self.derivatives.extend(prediction.by_parameter.iter().map(measured));
        for (p, by_p) in self.derivatives.iter().enumerate() {
            let informed = row.information * by_p;
            self.pull[p] += by_p.dot(&row.pull);
            for c in 0..CHANNELS {
                self.cross[(p, c)] += informed[c];
            }
            for (sum, by_q) in self.information.column_mut(p).iter_mut().zip(&self.derivatives[..=p]) {
                *sum += informed.dot(by_q);
            }
        }
    }

    /// The curvature along the parameters, both triangles.
    fn whole(&self, information: &mut DMatrix<f64>) {
        information.copy_from(&self.information);
        information.fill_lower_triangle_with_upper_triangle();
    }
}
