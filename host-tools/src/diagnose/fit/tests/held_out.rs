//! Predictions of runs without their own help.

use nalgebra::{DMatrix, DVector};

use super::dense::{Dense, gaussian};
use super::toy::{Linear, OFFSET, campaign, plain};
use crate::diagnose::fit::{
    CHANNELS, Coordinate, HeldOut, Latent, Model, OffsetStd, Options, Prediction, Row, Start, fit, fit_without,
};

fn options() -> Options {
    let offset = |c: usize| if OFFSET[c] > 0.0 { OffsetStd::Known(OFFSET[c]) } else { OffsetStd::None };
    Options { offsets: std::array::from_fn(offset), latent_prior_std: [3.0, 300.0], ..plain() }
}

fn close(one: &HeldOut, other: &HeldOut, tolerance: f64) {
    assert_eq!(one.runs.len(), other.runs.len());
    for (one, other) in one.runs.iter().zip(&other.runs) {
        assert!((one.log_score.unwrap() - other.log_score.unwrap()).abs() < tolerance, "{one:?} {other:?}");
        for (one, other) in one.rows.iter().zip(&other.rows) {
            for c in 0..4 {
                let (residual, std) = (one.residual[c].unwrap(), one.std[c].unwrap());
                assert!((residual - other.residual[c].unwrap()).abs() < tolerance * std);
                assert!((std / other.std[c].unwrap() - 1.0).abs() < tolerance);
            }
        }
    }
}

#[test]
fn one_step_is_the_refit_where_the_model_is_linear() {
    let (model, rows) = campaign(&[3, 4, 1, 2, 5], 3, 1);
    let options = options();
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &options).unwrap();
    for runs in [&[0][..], &[2], &[1, 4]] {
        let quick = fit.leave_out(&model, runs).unwrap();
        close(&quick, &fit.leave_out_exact(&model, runs).unwrap(), 1e-3);
        let fresh = fit_without(&model, &rows, runs, &Start::of(&model, &rows), &options).unwrap();
        close(&quick, &fresh.predict_unseen(&model, runs).unwrap(), 1e-3);
    }
}

/// ln density of a run's judged readings given its slips and loads and all other runs: from one dense covariance of everything,
/// the parameters' prior and the latents' wide.
#[test]
fn the_score_is_the_conditional_density_of_the_dense_gaussian() {
    let (model, rows) = campaign(&[3, 4, 2, 5], 2, 2);
    let options = options();
    let wide = Options { latent_prior_std: [30.0, 3000.0], ..options.clone() };
    let dense = Dense::new(&model, &rows, &wide, &OFFSET, &[1.0; CHANNELS]);
    let prior = DMatrix::from_diagonal_element(2, 2, 1e6);
    let all = &dense.v + &dense.x * prior * dense.x.transpose();
    let density = |keep: &dyn Fn(&(usize, usize)) -> bool| {
        let kept: Vec<usize> = (0..dense.place.len()).filter(|&i| keep(&dense.place[i])).collect();
        let residual = DVector::from_fn(kept.len(), |i, _| dense.y[kept[i]] - dense.fixed[kept[i]]);
        gaussian(&residual, &DMatrix::from_fn(kept.len(), kept.len(), |i, j| all[(kept[i], kept[j])]))
    };
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &options).unwrap();
    for held in 0..4 {
        let known = density(&|&(row, c)| rows[row].run != held || c >= 4);
        let expected = density(&|_| true) - known;
        let score = fit.leave_out_exact(&model, &[held]).unwrap().log_score().unwrap();
        assert!((score - expected).abs() < 0.02, "run {held}: {score}, {expected}");
    }
}

#[test]
fn a_runs_own_forces_and_sinkage_do_not_reach_its_prediction() {
    let (model, rows) = campaign(&[3, 4, 2, 5], 2, 3);
    let options = options();
    let exact = |rows: &[Row]| {
        let fit = fit(&model, rows, &Start::of(&model, rows), &options).unwrap();
        fit.leave_out_exact(&model, &[1]).unwrap()
    };
    let mut spoilt = rows.clone();
    for row in spoilt.iter_mut().filter(|row| row.run == 1) {
        for c in 0..4 {
            row.readings[c] = row.readings[c].map(|reading| reading + 100.0 * row.noise[c]);
        }
    }
    let (one, other) = (exact(&rows), exact(&spoilt));
    for (one, other) in one.runs[0].rows.iter().zip(&other.runs[0].rows) {
        for c in 0..4 {
            let moved = other.residual[c].unwrap() - one.residual[c].unwrap();
            assert!((moved / rows[one.row].noise[c] - 100.0).abs() < 1e-3);
        }
    }
}

#[test]
fn without_a_load_the_sinkage_tells_it_and_is_not_judged() {
    let (model, mut rows) = campaign(&[3, 4, 2, 5], 2, 4);
    rows[3].readings[5] = None;
    rows[4].readings[4] = None;
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &options()).unwrap();
    let held = fit.leave_out(&model, &[1]).unwrap();
    let judged = |c: usize| held.runs[0].rows.iter().filter(|row| row.std[c].is_some()).count();
    assert_eq!([0, 1, 2, 3, 4, 5].map(judged), [3, 3, 2, 3, 0, 0]);
    assert_eq!(held.runs[0].rows[0].residual[2], None);
    assert_eq!(held.runs[0].rows[1].residual, [None; CHANNELS]);
}

#[test]
fn half_of_the_residuals_lie_within_their_probable_error() {
    let mut inside = 0;
    let mut all = 0;
    for seed in 0..12 {
        let (model, rows) = campaign(&[3; 10], 3, 100 + seed);
        let fit = fit(&model, &rows, &Start::of(&model, &rows), &options()).unwrap();
        for run in 0..10 {
            for row in &fit.leave_out(&model, &[run]).unwrap().runs[0].rows {
                for c in 0..4 {
                    inside += usize::from(row.residual[c].unwrap().abs() < 0.6745 * row.std[c].unwrap());
                    all += 1;
                }
            }
        }
    }
    // Rows of a run are correlated: 480 groups of three.
    let share = inside as f64 / all as f64;
    assert!((share - 0.5).abs() < 4.0 * 0.5 / 480.0_f64.sqrt(), "{share}");
}

#[test]
fn each_run_in_turn_is_each_run_by_itself() {
    let (model, rows) = campaign(&[3, 4, 1, 2, 5], 3, 1);
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &options()).unwrap();
    let each = fit.leave_each_out(&model, 0..5).unwrap();
    let alone: Vec<HeldOut> = (0..5).map(|run| fit.leave_out(&model, &[run]).unwrap()).collect();
    assert_eq!(each, alone);
}

/// A model that says nothing of one row above some value of its first parameter.
struct Collapsing {
    linear: Linear,
    row: usize,
    above: f64,
}

impl Model for Collapsing {
    fn coordinates(&self) -> &[Coordinate] {
        self.linear.coordinates()
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        let collapses = rows.contains(&self.row) && parameters[0] > self.above;
        if collapses { None } else { self.linear.predict(parameters, rows, latents) }
    }
}

#[test]
fn a_fit_stays_where_the_run_that_it_does_not_see_is_predicted() {
    let (linear, rows) = campaign(&[3, 4, 2, 5], 2, 6);
    let start = Start::of(&linear, &rows);
    let drawn = fit_without(&linear, &rows, &[2], &start, &options()).unwrap();
    let end = drawn.parameters[0];
    assert!(end > start.parameters[0] + 0.02);
    let above = end - 0.01;
    let model = Collapsing { linear, row: 7, above };
    let kept = fit_without(&model, &rows, &[2], &start, &options()).unwrap();
    assert!(kept.parameters[0] <= above && kept.parameters[0] > above - 0.1, "{:?}, {above}", kept.parameters);
    assert!(kept.predict_unseen(&model, &[2]).unwrap().log_score().is_some());
    // What was not predicted at the start either does not hold the fit back.
    let lost = Collapsing { above: start.parameters[0] - 1.0, ..model };
    let free = fit_without(&lost, &rows, &[2], &start, &options()).unwrap();
    assert_eq!(free.parameters, drawn.parameters);
    assert_eq!(free.predict_unseen(&lost, &[2]).unwrap().log_score(), None);
}
