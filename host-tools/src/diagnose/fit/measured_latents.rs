//! True slip and load of rows as their own slip and load readings give them.

use nalgebra::{DVector, Matrix2, Vector2};

use super::model::{Derivatives, Latent, Prediction};
use super::observation::{Reading, Row};
use super::problem::{Problem, RunRows, within};

/// Most Newton steps.
const STEPS: usize = 20;
/// Most halvings of a step after which the model predicts nothing.
const HALVINGS: usize = 6;
/// Deviation from the readings, in units of their noise, that is none.
const SETTLED: f64 = 1e-4;
/// Determinant over the product of the columns' lengths below which the readings do not tell slip and load apart.
const SINGULAR: f64 = 1e-9;

/// A run with its latents solved for.
pub(super) struct MeasuredRun {
    pub predictions: Vec<Prediction>,
    /// By row: the readings that gave slip and load; none where there are not two.
    pub sources: Vec<Option<[Reading; 2]>>,
}

/// The readings that tell slip and load of a row: its slip, and its load, or its sinkage where no load was measured.
fn sources(row: &Row) -> Option<[Reading; 2]> {
    let measured = |reading: &Reading| row.readings[reading.index()].is_some();
    let second = [Reading::Load, Reading::Sinkage].into_iter().find(measured)?;
    measured(&Reading::Slip).then_some([Reading::Slip, second])
}

/// Derivatives of two readings by slip and load, inverted; none where the two do not tell them apart.
pub(super) fn by_readings(slopes: &Derivatives, sources: [Reading; 2]) -> Option<Matrix2<f64>> {
    derivatives(slopes, sources)?.try_inverse()
}

/// Derivatives of two readings by slip and load; none where the two do not tell them apart.
fn derivatives(slopes: &Derivatives, sources: [Reading; 2]) -> Option<Matrix2<f64>> {
    let [first, second] = sources.map(Reading::index);
    let matrix =
        Matrix2::new(slopes.by_slip[first], slopes.by_load[first], slopes.by_slip[second], slopes.by_load[second]);
    let size = matrix.column(0).norm() * matrix.column(1).norm();
    (matrix.determinant().abs() > SINGULAR * size).then_some(matrix)
}

/// ln of how much readings that tell slip and load stretch these; 0 where none do.
pub(super) fn ln_stretch(row: &Row, slopes: &Derivatives) -> f64 {
    let derivatives = sources(row).and_then(|sources| derivatives(slopes, sources));
    derivatives.map_or(0.0, |derivatives| derivatives.determinant().abs().ln())
}

/// The latents at which slip and load readings of a run come out as measured, with the predictions there; none where the model
/// predicts nothing at the readings themselves.
pub(super) fn measured_run(problem: &Problem<'_>, parameters: &DVector<f64>, run: &RunRows) -> Option<MeasuredRun> {
    let sources: Vec<Option<[Reading; 2]>> = run.rows.iter().map(|&row| sources(&problem.rows[row])).collect();
    let mut latents: Vec<Latent> = run.rows.iter().map(|&row| problem.latent_start[row]).collect();
    let mut predictions = problem.predict(parameters, run, &mut latents)?;
    for _ in 0..STEPS {
        let steps: Vec<Vector2<f64>> = (0..latents.len())
            .map(|place| newton_step(&problem.rows[run.rows[place]], &predictions[place], sources[place]))
            .collect();
        if steps.iter().all(|step| *step == Vector2::zeros()) {
            break;
        }
        let halved = |halvings: usize| {
            let share = 0.5_f64.powi(halvings as i32);
            let mut moved: Vec<Latent> =
                latents.iter().zip(&steps).map(|(latent, step)| moved(problem, latent, &(step * share))).collect();
            problem.predict(parameters, run, &mut moved).map(|predictions| (moved, predictions))
        };
        let Some((next, seen)) = (0..=HALVINGS).find_map(halved) else { break };
        if next == latents {
            break;
        }
        (latents, predictions) = (next, seen);
    }
    Some(MeasuredRun { predictions, sources })
}

fn moved(problem: &Problem<'_>, latent: &Latent, step: &Vector2<f64>) -> Latent {
    within(problem.options, Latent { slip: latent.slip + step[0], load_n: latent.load_n + step[1], ..*latent })
}

/// The step to the readings; zero where they are met, or tell nothing.
fn newton_step(row: &Row, prediction: &Prediction, sources: Option<[Reading; 2]>) -> Vector2<f64> {
    let step = || {
        let sources = sources?;
        let away = sources.map(|reading| {
            let c = reading.index();
            row.readings[c].map_or(0.0, |measured| measured - prediction.value[c])
        });
        let met = (0..2).all(|k| away[k].abs() <= SETTLED * row.noise[sources[k].index()]);
        if met { None } else { Some(by_readings(&prediction.slopes, sources)? * Vector2::from(away)) }
    };
    step().unwrap_or_else(Vector2::zeros)
}
