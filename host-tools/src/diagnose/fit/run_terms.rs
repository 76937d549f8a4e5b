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
}

impl RunTerms {
    /// Terms of a run; `damping` lengthens the diagonals of latents and offsets.
    pub(super) fn new(problem: &Problem<'_>, state: &State, scales: &Scales, run: usize, damping: f64) -> Self {
        let places = 0..problem.runs[run].rows.len();
        let rows: Vec<RowTerms> =
            places.map(|place| RowTerms::new(problem, state, scales, (run, place), damping)).collect();
        let active = active_offsets(problem, scales, run, &rows);
        let count = state.parameters.len();
        let mut sums = Sums {
            information: DMatrix::zeros(count, count),
            cross: ParameterByChannel::zeros(count),
            pull: DVector::zeros(count),
        };
        for (row, prediction) in rows.iter().zip(&state.predictions[run]) {
            sums.add(row, prediction);
        }
        let mut terms = Self {
            active,
            offset_covariance: ChannelMatrix::zeros(),
            offset_pull: Channels::zeros(),
            cross: sums.cross,
            information: sums.information,
            pull: sums.pull,
            ln_det: rows.iter().map(|row| row.ln_det).sum(),
            rows,
        };
        terms.eliminate_offsets(&state.offsets[run], scales, damping);
        terms
    }

    fn eliminate_offsets(&mut self, offsets: &Channels, scales: &Scales, damping: f64) {
        let precision =
            Channels::from_fn(|c, _| if self.active[c] { 1.0 / (scales.offset[c] * scales.offset[c]) } else { 0.0 });
        let mut curvature = self.rows.iter().map(|row| row.information).sum::<ChannelMatrix>();
        for c in 0..CHANNELS {
            if self.active[c] {
                curvature[(c, c)] = (curvature[(c, c)] + precision[c]) * (1.0 + damping);
            } else {
                curvature.row_mut(c).fill(0.0);
                curvature.column_mut(c).fill(0.0);
                curvature[(c, c)] = 1.0;
                self.cross.column_mut(c).fill(0.0);
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
        self.information -= &gain * self.cross.transpose();
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

/// Sums over the rows of a run.
struct Sums {
    information: DMatrix<f64>,
    cross: ParameterByChannel,
    pull: DVector<f64>,
}

impl Sums {
    fn add(&mut self, row: &RowTerms, prediction: &Prediction) {
        let count = self.pull.len();
        let derivative =
            |p: usize| Channels::from_fn(|c, _| if row.weight[c] > 0.0 { prediction.by_parameter[p][c] } else { 0.0 });
        let derivatives: Vec<Channels> = (0..count).map(derivative).collect();
        for (p, by_p) in derivatives.iter().enumerate() {
            let informed = row.information * by_p;
            self.pull[p] += by_p.dot(&row.pull);
            for c in 0..CHANNELS {
                self.cross[(p, c)] += informed[c];
            }
            for (q, by_q) in derivatives.iter().enumerate().take(p + 1) {
                let product = informed.dot(by_q);
                self.information[(p, q)] += product;
                if q < p {
                    self.information[(q, p)] += product;
                }
            }
        }
    }
}
