//! What a fit asks of a model.

use super::observation::{ByLatents, CHANNELS};

/// A parameter of a fit, in the fit's own unit: that of the parameter, or its logarithm.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinate {
    /// Name for reports.
    pub name: String,
    /// Lower bound; may be −∞.
    pub low: f64,
    /// Upper bound, above `low`; may be ∞.
    pub high: f64,
    /// Where a fit starts unless told otherwise.
    pub start: f64,
    /// Mean and standard deviation of a Gaussian prior; none for a flat prior within the bounds.
    pub prior: Option<(f64, f64)>,
}

impl Coordinate {
    /// Half the square of a value by the prior; nothing by a flat one, whose bounds are wide.
    pub fn penalty(&self, value: f64) -> f64 {
        self.prior.map_or(0.0, |(mean, std)| 0.5 * ((value - mean) / std).powi(2))
    }

    /// Precision that the bounds add to the prior's, so that together they have at least that of the flat distribution on the
    /// bounds, 12 / width²; 0 where a bound is infinite.
    pub(super) fn box_precision(&self) -> f64 {
        let prior = self.prior.map_or(0.0, |(_, std)| 1.0 / (std * std));
        (12.0 / (self.high - self.low).powi(2) - prior).max(0.0)
    }

    /// A middling value: the prior's mean, the middle of the bounds, or the start where there is neither.
    pub(super) fn middle(&self) -> f64 {
        let middle = match self.prior {
            Some((mean, _)) => mean,
            None if self.low.is_finite() && self.high.is_finite() => 0.5 * (self.low + self.high),
            None => self.start,
        };
        middle.clamp(self.low, self.high)
    }
}

/// What is true of a row and only measured with error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Latent {
    /// True slip.
    pub slip: f64,
    /// True load, N.
    pub load_n: f64,
    /// The model's sinkage, m, as a warm start for its next evaluation; no quantity of the fit.
    pub sinkage_m: f64,
}

/// What a model expects of a row without run offset and noise, and how that changes.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// The readings, in the units of the channels. One that the row does not measure is never looked at.
    pub value: [f64; CHANNELS],
    /// Their derivatives.
    pub slopes: Derivatives,
}

/// How the readings of a row change.
#[derive(Debug, Clone, PartialEq)]
pub struct Derivatives {
    /// Their derivative by each coordinate.
    pub by_parameter: Vec<[f64; CHANNELS]>,
    /// Their derivative by the true slip.
    pub by_slip: [f64; CHANNELS],
    /// Their derivative by the true load, 1/N.
    pub by_load: [f64; CHANNELS],
}

impl Derivatives {
    /// Derivatives by both latents.
    pub(super) fn by_latents(&self) -> ByLatents {
        ByLatents::from_columns(&[self.by_slip.into(), self.by_load.into()])
    }
}

/// A model of the readings.
pub trait Model: Sync {
    /// The parameters that it frees.
    fn coordinates(&self) -> &[Coordinate];

    /// Predictions of all rows of one run, in the rows' order (effects with memory run along it); none where they cannot be
    /// had, as of a soil that cannot carry the load. `rows` are indices into the campaign's rows. Of `latents`, one per row, a
    /// model reads all and may change `sinkage_m`.
    fn predict(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>>;

    /// The values of [`Model::predict`] alone, where they are to be had for less: many a step of a fit is judged by them and not
    /// taken. `sinkage_m` is left such that the same values come of predicting from there.
    fn values(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<[f64; CHANNELS]>> {
        let predictions = self.predict(parameters, rows, latents)?;
        Some(predictions.into_iter().map(|prediction| prediction.value).collect())
    }
}
