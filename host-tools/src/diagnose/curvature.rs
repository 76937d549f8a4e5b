//! What a fit to first order in the true slip and load leaves out.

use super::fit::{CHANNELS, Latent, Model, Reading};
use super::measurements::Measurements;
use super::trial::Trial;

/// For each row and channel ½ f″ σ², summed over slip and load: by how much the mean reading of a wheel whose slip and load
/// are known to a standard deviation σ differs from the reading at their mean.
pub fn curvature(trial: &Trial<'_>, measurements: &Measurements) -> Vec<[f64; CHANNELS]> {
    let mut bends = vec![[0.0; CHANNELS]; measurements.rows.len()];
    for run in &measurements.rows_of_run {
        for reading in [Reading::Slip, Reading::Load] {
            let moved = |sign: f64| predictions(trial, measurements, run, reading, sign);
            let (Some(less), Some(here), Some(more)) = (moved(-1.0), moved(0.0), moved(1.0)) else { continue };
            for (place, row) in run.iter().enumerate() {
                for channel in Reading::JUDGED.map(Reading::index) {
                    let second = less[place][channel] - 2.0 * here[place][channel] + more[place][channel];
                    bends[*row][channel] += 0.5 * second.abs();
                }
            }
        }
    }
    bends
}

/// The readings of a run with one latent of every row moved by its standard deviation.
fn predictions(
    trial: &Trial<'_>,
    measurements: &Measurements,
    run: &[usize],
    reading: Reading,
    sign: f64,
) -> Option<Vec<[f64; CHANNELS]>> {
    let moved = |row: &usize| {
        let (latent, step) = (trial.fit.latents[*row], sign * measurements.rows[*row].noise[reading.index()]);
        match reading {
            Reading::Slip => Latent { slip: (latent.slip + step).clamp(-0.99, 0.99), ..latent },
            _ => Latent { load_n: latent.load_n + step, ..latent },
        }
    };
    let mut latents: Vec<Latent> = run.iter().map(moved).collect();
    trial.model.values(&trial.fit.parameters, run, &mut latents)
}

/// Counts it as noise: a fit that knows only slopes cannot tell it from structure.
pub fn add_curvature(measurements: &mut Measurements, bends: &[[f64; CHANNELS]]) {
    for (row, bend) in measurements.rows.iter_mut().zip(bends) {
        for (noise, bend) in row.noise.iter_mut().zip(bend) {
            *noise = noise.hypot(*bend);
        }
    }
}
