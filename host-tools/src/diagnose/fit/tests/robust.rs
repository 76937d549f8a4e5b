//! Outliers.

use super::toy::{campaign, plain};
use crate::diagnose::fit::{Options, Start, fit};

#[test]
fn one_gross_outlier_moves_no_parameter_by_a_standard_deviation() {
    for seed in 0..5 {
        let (model, rows) = campaign(&[1; 40], 2, seed);
        let options = Options { huber: 3.0, ..plain() };
        let estimate = |rows: &[_], options: &Options| fit(&model, rows, &Start::of(&model, rows), options).unwrap();
        let clean = estimate(&rows, &options);
        let mut spoilt = rows.clone();
        spoilt[7].readings[0] = spoilt[7].readings[0].map(|reading| reading + 1e3 * rows[7].noise[0]);
        let robust = estimate(&spoilt, &options);
        let squares = estimate(&spoilt, &plain());
        let moved = |p: usize, fit: &crate::diagnose::fit::Fit| {
            (fit.parameters[p] - clean.parameters[p]).abs() / clean.covariance[(p, p)].sqrt()
        };
        assert!(robust.converged);
        assert!((0..2).all(|p| moved(p, &robust) < 1.0), "{} {}", moved(0, &robust), moved(1, &robust));
        assert!((0..2).any(|p| moved(p, &squares) > 5.0), "squares should have followed the outlier");
    }
}

#[test]
fn an_outlier_counts_little_in_the_score_of_its_run() {
    let (model, rows) = campaign(&[3; 10], 2, 9);
    let options = Options { huber: 3.0, ..plain() };
    let score = |rows: &[_]| {
        let fit = fit(&model, rows, &Start::of(&model, rows), &options).unwrap();
        fit.leave_out_exact(&model, &[4]).unwrap().log_score().unwrap()
    };
    let mut spoilt = rows.clone();
    spoilt[13].readings[1] = spoilt[13].readings[1].map(|reading| reading + 50.0 * rows[13].noise[1]);
    let lost = score(&rows) - score(&spoilt);
    // Fifty noises squared would cost more than a thousand.
    assert!(lost > 10.0 && lost < 160.0, "{lost}");
}
