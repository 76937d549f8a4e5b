//! The predictive density of a run that a fit has not seen.
//!
//! Slip and load of a row are known from readings y_u alone, so that what is left between a reading and its prediction is
//! `r = (J_θ − k J_θu) δθ + b − k b_u + e − k e_u` with k = J_u G⁻¹, G the derivatives of y_u by slip and load. Parameters δθ and offsets
//! b are the same for all rows of the run; the readings are taken one after the other, each updating what is known of those
//! (Kalman's filter), so that the product of the densities is the joint one. Where a reading is an outlier Huber's density
//! takes the place of the normal one, and the update takes its noise for as large as makes it a tolerable one.

use nalgebra::{DMatrix, DVector, RowVector2};

use super::held_out::{HeldOutRow, HeldOutRun};
use super::huber::Huber;
use super::measured_latents::{MeasuredRun, by_readings};
use super::model::{Derivatives, Prediction};
use super::observation::{CHANNELS, Reading, Row};
use super::problem::{Problem, RunRows};
use super::state::Scales;

/// Power of the load with which a sinkage goes, below which it tells no load; steady wheels have 0.4 to 0.8, and some 0.3 where soil stiffens
/// under load.
const LEAST_POWER: f64 = 0.2;

/// Judges the prediction of a run by parameters of covariance `covariance`.
pub(super) fn judge(
    problem: &Problem<'_>,
    scales: &Scales,
    covariance: &DMatrix<f64>,
    run: &RunRows,
    measured: &MeasuredRun,
) -> HeldOutRun {
    let with_offset = run.rows.len() >= problem.options.smallest_run_with_offset;
    let offset = if with_offset { scales.offset } else { [0.0; CHANNELS] };
    let prior = Knowledge::new(covariance, &offset);
    let mut filter = prior.clone();
    let mut judged = HeldOutRun::without_answer(run.id);
    let mut total = 0.0;
    for (place, &index) in run.rows.iter().enumerate() {
        let row = &problem.rows[index];
        let prediction = &measured.predictions[place];
        let none = [None; CHANNELS];
        let mut seen = HeldOutRow { row: index, residual: none, std: none, std_within_run: none };
        let inverse =
            measured.sources[place].and_then(|sources| Some((sources, by_readings(&prediction.slopes, sources)?)));
        if let Some((sources, inverse)) = inverse {
            let source_noise = sources.map(|reading| scales.noise(row, reading.index()));
            let mut fresh = prior.clone();
            fresh.new_row(source_noise);
            filter.new_row(source_noise);
            for (c, residual) in residuals(row, prediction, sources) {
                let gain = RowVector2::new(prediction.slopes.by_slip[c], prediction.slopes.by_load[c]) * inverse;
                let noise = scales.noise(row, c);
                let direction = fresh.direction(&prediction.slopes, c, sources, gain);
                let score = filter.take(&direction, residual, noise, problem.huber);
                seen.residual[c] = Some(residual);
                let variance = fresh.variance(&direction, noise);
                seen.std[c] = Some(variance.sqrt());
                seen.std_within_run[c] = Some((variance - fresh.of_offsets(&direction, &offset)).max(0.0).sqrt());
                total += score;
            }
            if sources.contains(&Reading::Load) {
                seen.residual[Reading::Load.index()] = load_residual(row, prediction);
            }
        }
        judged.rows.push(seen);
    }
    // What is left of a fit without most of the readings may be no number.
    judged.log_score = Some(total).filter(|total| total.is_finite());
    judged
}

/// Channel and residual of what is judged in a row.
fn residuals<'a>(
    row: &'a Row,
    prediction: &'a Prediction,
    sources: [Reading; 2],
) -> impl Iterator<Item = (usize, f64)> + 'a {
    let judged = Reading::JUDGED.into_iter().filter(move |reading| !sources.contains(reading)).map(Reading::index);
    judged.filter_map(|c| Some((c, row.readings[c]? - prediction.value[c])))
}

/// The load as measured less that under which the model's wheel sinks as deep as was measured, to first order. None where the sinkage hardly
/// follows the load, as while it lags behind: any load would then do.
fn load_residual(row: &Row, prediction: &Prediction) -> Option<f64> {
    let [load, sinkage] = [Reading::Load, Reading::Sinkage].map(Reading::index);
    let (measured_n, measured_m, predicted_m) =
        (row.readings[load]?, row.readings[sinkage]?, prediction.value[sinkage]);
    let by_load = prediction.slopes.by_load[sinkage];
    (by_load * measured_n > LEAST_POWER * predicted_m).then(|| (predicted_m - measured_m) / by_load)
}

/// What is known of parameters, offsets and the errors of a row's two source readings, in this order.
#[derive(Clone)]
struct Knowledge {
    parameters: usize,
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
}

impl Knowledge {
    fn new(parameters: &DMatrix<f64>, offset: &[f64; CHANNELS]) -> Self {
        let count = parameters.nrows();
        let size = count + CHANNELS + 2;
        let mut covariance = DMatrix::zeros(size, size);
        covariance.view_mut((0, 0), (count, count)).copy_from(parameters);
        for (c, std) in offset.iter().enumerate() {
            covariance[(count + c, count + c)] = std * std;
        }
        Self { parameters: count, mean: DVector::zeros(size), covariance }
    }

    /// Forgets the errors of the last row's sources.
    fn new_row(&mut self, source_noise: [f64; 2]) {
        for (k, noise) in source_noise.into_iter().enumerate() {
            let at = self.parameters + CHANNELS + k;
            self.covariance.row_mut(at).fill(0.0);
            self.covariance.column_mut(at).fill(0.0);
            self.covariance[(at, at)] = noise * noise;
            self.mean[at] = 0.0;
        }
    }

    /// How the residual of a channel depends on all that.
    fn direction(&self, slopes: &Derivatives, c: usize, sources: [Reading; 2], gain: RowVector2<f64>) -> DVector<f64> {
        let mut direction = DVector::zeros(self.mean.len());
        for (p, derivatives) in slopes.by_parameter.iter().enumerate() {
            direction[p] = derivatives[c];
        }
        direction[self.parameters + c] = 1.0;
        for (k, source) in sources.into_iter().map(Reading::index).enumerate() {
            for (p, derivatives) in slopes.by_parameter.iter().enumerate() {
                direction[p] -= gain[k] * derivatives[source];
            }
            direction[self.parameters + source] -= gain[k];
            direction[self.parameters + CHANNELS + k] = -gain[k];
        }
        direction
    }

    fn variance(&self, direction: &DVector<f64>, noise: f64) -> f64 {
        direction.dot(&(&self.covariance * direction)) + noise * noise
    }

    /// The part of that variance which the offsets of a run have of which nothing is known yet.
    fn of_offsets(&self, direction: &DVector<f64>, offset: &[f64; CHANNELS]) -> f64 {
        direction.iter().skip(self.parameters).zip(offset).map(|(by, std)| (by * std).powi(2)).sum()
    }

    /// ln density of a residual, which is then known.
    fn take(&mut self, direction: &DVector<f64>, residual: f64, noise: f64, huber: Huber) -> f64 {
        let spread = &self.covariance * direction;
        let variance = direction.dot(&spread) + noise * noise;
        let innovation = residual - direction.dot(&self.mean);
        let t = innovation / variance.sqrt();
        let weight = huber.weight(t);
        // The variance at which the innovation would lie on Huber's threshold.
        let taken = variance / (weight * weight);
        self.mean += &spread * (innovation / taken);
        self.covariance.ger(-1.0 / taken, &spread, &spread, 1.0);
        -huber.loss(t) - huber.ln_integral() - 0.5 * variance.ln()
    }
}
