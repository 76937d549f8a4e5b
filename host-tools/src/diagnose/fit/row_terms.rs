//! One row with its two latents eliminated.

use nalgebra::{Matrix2, Vector2};

use super::model::Derivatives;
use super::observation::{ByLatents, CHANNELS, ChannelMatrix, Channels};
use super::problem::Problem;
use super::state::{Scales, State, latent_difference};

/// What a row says of parameters and offsets once its latents follow them: with D the weights, J the derivatives by the latents
/// and A = JᵀDJ + P₀ their information, M = D − D J A⁻¹ Jᵀ D.
pub(super) struct RowTerms {
    /// Measured less predicted less offset; 0 where not measured.
    pub residual: Channels,
    /// D: Huber's weight over the noise squared; 0 where not measured.
    pub weight: Channels,
    by_latents: ByLatents,
    /// A⁻¹.
    pub latent_covariance: Matrix2<f64>,
    /// Negative slope of the objective along the latents.
    latent_pull: Vector2<f64>,
    /// M.
    pub information: ChannelMatrix,
    /// Negative slope of the objective along a shift of the channels, latents following.
    pub pull: Channels,
    /// ln det A.
    pub ln_det: f64,
}

impl RowTerms {
    /// Terms of the row at `place` of a run; `damping` lengthens the diagonal of A.
    pub(super) fn new(problem: &Problem<'_>, state: &State, scales: &Scales, at: (usize, usize), damping: f64) -> Self {
        let (run, place) = at;
        let index = problem.runs[run].rows[place];
        let row = &problem.rows[index];
        let standardised = state.standardised(row, scales, run, place);
        let mut residual = Channels::zeros();
        let mut weight = Channels::zeros();
        let mut by_latents = state.slopes[run][place].by_latents();
        for c in 0..CHANNELS {
            match standardised[c] {
                Some(t) => {
                    let noise = scales.noise(row, c);
                    residual[c] = t * noise;
                    weight[c] = problem.huber.weight(t) / (noise * noise);
                }
                // Nothing is known of what a model says of a channel that is not measured, not even that it is a number.
                None => by_latents.row_mut(c).fill(0.0),
            }
        }
        let prior = Vector2::from(problem.options.latent_prior_std).map(|std| 1.0 / (std * std));
        let away = latent_difference(&state.latents[run][place], &problem.latent_start[index]);
        let weighted = Channels::component_mul(&weight, &residual);
        let by_latents_weighted = ByLatents::from_fn(|c, k| weight[c] * by_latents[(c, k)]);
        let latent_pull = by_latents.transpose() * weighted - prior.component_mul(&away);
        let mut latent_information = by_latents.transpose() * by_latents_weighted + Matrix2::from_diagonal(&prior);
        for k in 0..2 {
            latent_information[(k, k)] *= 1.0 + damping;
        }
        let (latent_covariance, ln_det) = inverse(&latent_information);
        let gain = by_latents_weighted * latent_covariance;
        Self {
            residual,
            weight,
            by_latents,
            latent_covariance,
            latent_pull,
            information: ChannelMatrix::from_diagonal(&weight) - gain * by_latents_weighted.transpose(),
            pull: weighted - gain * latent_pull,
            ln_det,
        }
    }

    /// The latents' best step when the prediction, offset included, is shifted by `shift`.
    pub(super) fn latent_step(&self, shift: &Channels) -> Vector2<f64> {
        let seen = Channels::component_mul(&self.weight, shift);
        self.latent_covariance * (self.latent_pull - self.by_latents.transpose() * seen)
    }

    /// The residual after `shift` and a step of the latents, to first order.
    pub(super) fn residual_after(&self, shift: &Channels, latent_step: &Vector2<f64>) -> Channels {
        self.residual - shift - self.by_latents * latent_step
    }

    /// Share of a shift that is left once the latents have followed it: 1 − J A⁻¹ Jᵀ D.
    pub(super) fn unfollowed(&self) -> ChannelMatrix {
        let spread = self.by_latents * self.latent_covariance * self.by_latents.transpose();
        ChannelMatrix::identity() - ChannelMatrix::from_fn(|c, d| spread[(c, d)] * self.weight[d])
    }

    /// Variance of each channel's prediction through the latents alone.
    pub(super) fn latent_variance(&self) -> Channels {
        let spread = self.by_latents * self.latent_covariance * self.by_latents.transpose();
        spread.diagonal()
    }
}

/// Inverse and ln det of a symmetric positive definite matrix.
fn inverse(matrix: &Matrix2<f64>) -> (Matrix2<f64>, f64) {
    let [a, b, d] = [matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 1)]];
    let det = a * d - b * b;
    (Matrix2::new(d, -b, -b, a) / det, det.ln())
}

/// Change of the predicted channels with a step of the parameters. What is not measured (no weight) does not count.
pub(super) fn shift_by(slopes: &Derivatives, weight: &Channels, step: &[f64]) -> Channels {
    let mut shift = Channels::zeros();
    for (derivatives, step) in slopes.by_parameter.iter().zip(step) {
        for (shift, derivative) in shift.iter_mut().zip(derivatives) {
            *shift += derivative * step;
        }
    }
    shift.zip_map(weight, |shift, weight| if weight == 0.0 { 0.0 } else { shift })
}
