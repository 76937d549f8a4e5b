//! Bounds.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use super::toy::{campaign, free, plain};
use crate::diagnose::fit::bounds::bounded_step;
use crate::diagnose::fit::{Coordinate, Start, fit};

#[test]
fn a_parameter_on_its_bound_leaves_the_others_at_their_best() {
    let (mut model, rows) = campaign(&[1; 30], 3, 1);
    let unbounded = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    model.coordinates[1] = Coordinate { low: -0.4, high: 0.8, ..free("bounded") };
    let bounded = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    assert!(bounded.converged);
    assert_eq!(bounded.on_bound, [false, true, false]);
    assert!((bounded.parameters[1] - 0.8).abs() < 1e-12 && unbounded.parameters[1] > 0.8);
    assert!(bounded.covariance[(1, 1)] <= 1.2_f64.powi(2) / 12.0);
    let std = (unbounded.covariance[(1, 1)] * bounded.dispersion.max(1.0)).sqrt();
    let beyond = (unbounded.parameters[1] - 0.8) / std;
    assert!((bounded.beyond_bound(1) / beyond - 1.0).abs() < 0.05, "{} {beyond}", bounded.beyond_bound(1));
    assert_eq!(bounded.beyond_bound(0), 0.0);
    // The Gaussian of the others given this one, from the unbounded fit.
    let gain = unbounded.covariance.column(1) / unbounded.covariance[(1, 1)];
    for p in [0, 2] {
        let expected = unbounded.parameters[p] + gain[p] * (0.8 - unbounded.parameters[1]);
        let std = unbounded.covariance[(p, p)].sqrt();
        assert!((bounded.parameters[p] - expected).abs() < 1e-3 * std, "{p}: {} {expected}", bounded.parameters[p]);
    }
}

#[test]
fn a_start_out_of_bounds_is_moved_in() {
    let (mut model, rows) = campaign(&[1; 30], 2, 2);
    model.coordinates[0] = Coordinate { low: 0.0, high: 5.0, start: -7.0, ..free("bounded") };
    let found = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    assert!(found.converged && found.parameters[0] > 0.0 && found.parameters[0] < 5.0);
}

proptest! {
    #[test]
    fn a_bounded_step_meets_the_conditions_of_a_minimum(
        entries in prop::collection::vec(-1.0_f64..1.0, 25),
        pull in prop::collection::vec(-3.0_f64..3.0, 5),
        room in prop::collection::vec(0.0_f64..1.0, 10),
    ) {
        let root = DMatrix::from_vec(5, 5, entries);
        let curvature = &root * root.transpose() + DMatrix::from_diagonal_element(5, 5, 0.05);
        let pull = DVector::from_vec(pull);
        let low = DVector::from_fn(5, |p, _| -room[p]);
        let high = DVector::from_fn(5, |p, _| room[p + 5]);
        let step = bounded_step(&curvature, &pull, &low, &high).unwrap();
        let rest = &pull - &curvature * &step;
        for p in 0..5 {
            prop_assert!(step[p] >= low[p] && step[p] <= high[p]);
            prop_assert!(rest[p] <= 1e-9 || step[p] == high[p], "{} at {p}", rest[p]);
            prop_assert!(rest[p] >= -1e-9 || step[p] == low[p], "{} at {p}", rest[p]);
        }
    }
}
