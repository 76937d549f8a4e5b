//! A valley that bends.

use nalgebra::{DMatrix, DVector};

use super::toy::{blank, free, plain};
use crate::diagnose::fit::bend::Bend;
use crate::diagnose::fit::problem::Problem;
use crate::diagnose::fit::state::{State, Step};
use crate::diagnose::fit::{CHANNELS, Coordinate, Derivatives, Latent, Model, Prediction, Row, Start, fit};

/// Two readings, 10 (y − x²) and x: their valley is a parabola.
struct Parabola {
    coordinates: [Coordinate; 2],
}

impl Model for Parabola {
    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], _: &mut [Latent]) -> Option<Vec<Prediction>> {
        let [x, y] = [parameters[0], parameters[1]];
        let mut value = [0.0; CHANNELS];
        (value[0], value[1]) = (10.0 * (y - x * x), x);
        let mut by_parameter = vec![[0.0; CHANNELS]; 2];
        (by_parameter[0][0], by_parameter[0][1], by_parameter[1][0]) = (-20.0 * x, 1.0, 10.0);
        let prediction = Prediction {
            value,
            slopes: Derivatives { by_parameter, by_slip: [0.0; CHANNELS], by_load: [0.0; CHANNELS] },
        };
        Some(vec![prediction; rows.len()])
    }
}

fn parabola() -> (Parabola, Vec<Row>) {
    let mut row = blank(0);
    (row.readings[0], row.readings[1]) = (Some(0.0), Some(1.0));
    (Parabola { coordinates: [free("x"), free("y")] }, vec![row])
}

/// Of squares the curvature that a step showed is all that there is: half of the step is foretold to the last digit.
#[test]
fn what_a_step_showed_foretells_a_shorter_one() {
    let (model, rows) = parabola();
    let options = plain();
    let problem = Problem::new(&model, &rows, &[], &Start::of(&model, &rows), &options).expect("a sound problem");
    let here = State::at(&problem, DVector::from_vec(vec![-1.2, 1.0])).expect("a state");
    let step =
        |share: f64| Step { parameters: DVector::from_vec(vec![2.2 * share, -3.0 * share]), ..Step::none(&here) };
    let after = |share: f64| here.after(&problem, &step(share), false).expect("a place");
    let bend = Bend::between(&here, after(1.0).place());
    let bent = bend.allowed_for(&here, &step(0.5), &DMatrix::identity(2, 2));
    let (slopes, foretold) = (&here.slopes[0][0], &bent.values[0][0]);
    for (channel, foretold) in foretold.iter().enumerate().take(2) {
        let by_slopes: f64 = (0..2).map(|p| slopes.by_parameter[p][channel] * step(0.5).parameters[p]).sum();
        let expected = after(0.5).place().values[0][0][channel] - by_slopes;
        assert!((foretold - expected).abs() < 1e-12, "channel {channel}");
    }
}

/// Rosenbrock's valley (1960, Comput. J. 3:175), from his start.
#[test]
fn a_bent_valley_is_followed_to_its_end() {
    let (model, rows) = parabola();
    let found = fit(&model, &rows, &Start::at(vec![-1.2, 1.0], &rows), &plain()).expect("a fit");
    assert!(found.converged, "{} steps to {:?}", found.iterations, found.parameters);
    assert!(found.parameters.iter().all(|value| (value - 1.0).abs() < 1e-3), "{:?}", found.parameters);
}
