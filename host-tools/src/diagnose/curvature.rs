//! What a fit to first order in the true slip and load leaves out.

use super::fit::{CHANNELS, Latent, Model, Reading};
use super::measurements::Measurements;
use super::trial::Trial;

/// Steps that are tried, in standard deviations, until one has an answer.
const STEPS: [f64; 3] = [1.0, 0.5, 0.25];

/// For each row and channel ½ f″ σ², summed over slip and load: by how much the mean reading of a wheel whose slip and load
/// are known to a standard deviation σ differs from the reading at their mean.
pub fn curvature(trial: &Trial<'_>, measurements: &Measurements) -> Vec<[f64; CHANNELS]> {
    let mut bends = vec![[0.0; CHANNELS]; measurements.rows.len()];
    for run in &measurements.rows_of_run {
        for reading in [Reading::Slip, Reading::Load] {
            // Near where the soil no longer carries, only a part of the way has an answer.
            let along = Along { trial, measurements, run, reading };
            let seconds = STEPS.iter().find_map(|step| along.second_differences(*step));
            for (row, seconds) in run.iter().zip(seconds.into_iter().flatten()) {
                for channel in Reading::JUDGED.map(Reading::index) {
                    bends[*row][channel] += 0.5 * seconds[channel].abs();
                }
            }
        }
    }
    bends
}

/// A run of which one latent of every row is moved.
struct Along<'a> {
    trial: &'a Trial<'a>,
    measurements: &'a Measurements,
    run: &'a [usize],
    reading: Reading,
}

impl Along<'_> {
    /// f″ σ² of the rows, from steps of so many standard deviations; none where the model has no answer there.
    fn second_differences(&self, step: f64) -> Option<Vec<[f64; CHANNELS]>> {
        let [less, here, more] = [-step, 0.0, step].map(|step| self.predictions(step));
        let second = |((less, here), more): (([f64; CHANNELS], [f64; CHANNELS]), [f64; CHANNELS])| {
            std::array::from_fn(|channel| (less[channel] - 2.0 * here[channel] + more[channel]) / (step * step))
        };
        Some(less?.into_iter().zip(here?).zip(more?).map(second).collect())
    }

    /// The readings with the latent of every row moved by so many of its standard deviations.
    fn predictions(&self, step: f64) -> Option<Vec<[f64; CHANNELS]>> {
        let Self { trial, measurements, run, reading } = self;
        let moved = |row: &usize| {
            let (latent, step) = (trial.fit.latents[*row], step * measurements.rows[*row].noise[reading.index()]);
            match reading {
                Reading::Slip => Latent { slip: (latent.slip + step).clamp(-0.99, 0.99), ..latent },
                _ => Latent { load_n: latent.load_n + step, ..latent },
            }
        };
        let mut latents: Vec<Latent> = run.iter().map(moved).collect();
        trial.model.values(&trial.fit.parameters, run, &mut latents)
    }
}

/// Counts it as noise: a fit that knows only slopes cannot tell it from structure.
pub fn add_curvature(measurements: &mut Measurements, bends: &[[f64; CHANNELS]]) {
    for (row, bend) in measurements.rows.iter_mut().zip(bends) {
        for (noise, bend) in row.noise.iter_mut().zip(bend) {
            *noise = noise.hypot(*bend);
        }
    }
}
