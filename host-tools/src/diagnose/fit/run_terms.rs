//! One run with its rows' latents and its offsets eliminated.

use nalgebra::{DMatrix, DVector, Vector2};

use super::model::Derivatives;
use super::observation::{CHANNELS, ChannelMatrix, Channels, ParameterByChannel};
use super::problem::Problem;
use super::row_terms::{RowTerms, shift_by};
use super::run_sums::RunSums;
use super::slices::add_times;
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
    /// By how much the offsets fall as each parameter grows.
    pub following: ParameterByChannel,
    /// Curvature of the objective along the parameters.
    pub information: DMatrix<f64>,
    /// Negative slope of the objective along the parameters.
    pub pull: DVector<f64>,
    /// ln det of all that was eliminated.
    pub ln_det: f64,
    sums: RunSums,
    /// Mixed curvature of parameters and offsets.
    cross: ParameterByChannel,
}

impl RunTerms {
    /// Terms of a run; `damping` lengthens the diagonals of latents and offsets.
    pub(super) fn new(problem: &Problem<'_>, state: &State, scales: &Scales, run: usize, damping: f64) -> Self {
        let places = 0..problem.runs[run].rows.len();
        let rows: Vec<RowTerms> =
            places.map(|place| RowTerms::new(problem, state, scales, (run, place), damping)).collect();
        let active = active_offsets(problem, scales, run, &rows);
        let count = state.parameters.len();
        let mut sums = RunSums::new(count);
        for (row, slopes) in rows.iter().zip(&state.slopes[run]) {
            sums.add(row, slopes);
        }
        let mut terms = Self {
            active,
            offset_covariance: ChannelMatrix::zeros(),
            offset_pull: Channels::zeros(),
            following: ParameterByChannel::zeros(count),
            information: DMatrix::zeros(count, count),
            pull: DVector::zeros(count),
            ln_det: 0.0,
            rows,
            cross: sums.cross(count),
            sums,
        };
        terms.eliminate_offsets(&state.offsets[run], scales, damping);
        terms
    }

    /// Lets the offsets, of these standard deviations, follow the parameters.
    pub(super) fn eliminate_offsets(&mut self, offsets: &Channels, scales: &Scales, damping: f64) {
        self.sums.information(&mut self.information);
        self.sums.pull(&mut self.pull);
        self.ln_det = self.sums.ln_det;
        if !self.active.contains(&true) {
            return;
        }
        let precision =
            Channels::from_fn(|c, _| if self.active[c] { 1.0 / (scales.offset[c] * scales.offset[c]) } else { 0.0 });
        let mut curvature = self.sums.by_channel;
        for c in 0..CHANNELS {
            if self.active[c] {
                curvature[(c, c)] = (curvature[(c, c)] + precision[c]) * (1.0 + damping);
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
        self.offset_pull = Channels::component_mul(&mask, &(self.sums.channel_pull - precision.component_mul(offsets)));
        self.offset_covariance = ChannelMatrix::component_mul(&factor.inverse(), &(mask * mask.transpose()));
        for c in (0..CHANNELS).filter(|&c| self.active[c]) {
            let mut following = self.following.column_mut(c);
            let following = following.as_mut_slice();
            following.fill(0.0);
            for d in (0..CHANNELS).filter(|&d| self.active[d]) {
                add_times(following, self.offset_covariance[(d, c)], self.cross.column(d).as_slice());
            }
            add_times(self.pull.as_mut_slice(), -self.offset_pull[c], following);
            for (mut column, cross) in self.information.column_iter_mut().zip(self.cross.column(c).iter()) {
                add_times(column.as_mut_slice(), -cross, following);
            }
        }
    }

    /// Steps of the offsets and latents that go with a step of the parameters.
    pub(super) fn follow(&self, slopes: &[Derivatives], step: &DVector<f64>) -> (Channels, Vec<Vector2<f64>>) {
        let offset = self.offset_covariance * (self.offset_pull - self.cross.tr_mul(step));
        let latents = self
            .rows
            .iter()
            .zip(slopes)
            .map(|(row, slopes)| row.latent_step(&(shift_by(slopes, &row.weight, step.as_slice()) + offset)));
        (offset, latents.collect())
    }
}

/// Channels of a run that have an offset: those of a run of enough rows, with a reading, and a τ.
fn active_offsets(problem: &Problem<'_>, scales: &Scales, run: usize, rows: &[RowTerms]) -> [bool; CHANNELS] {
    let large = problem.runs[run].rows.len() >= problem.options.smallest_run_with_offset;
    std::array::from_fn(|c| large && scales.offset[c] > 0.0 && rows.iter().any(|row| row.weight[c] > 0.0))
}
