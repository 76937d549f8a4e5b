//! A model with two optima, one with places where it predicts nothing, and threads.

use super::toy::{agreeing, blank, campaign, free, plain};
use crate::diagnose::fit::{
    Coordinate, Derivatives, FitError, Latent, Model, OffsetStd, Options, Prediction, Row, Start, fit, fit_from_many,
    scattered_starts,
};

/// A first reading of (θ² − 1)² + θ / 5, and nothing at all above `end`.
struct TwoValleys {
    coordinates: [Coordinate; 1],
    end: f64,
}

impl Model for TwoValleys {
    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], _: &mut [Latent]) -> Option<Vec<Prediction>> {
        let x = parameters[0];
        let mut value = [0.0; 6];
        let mut slope = [0.0; 6];
        value[0] = (x * x - 1.0).powi(2) + 0.2 * x;
        slope[0] = 4.0 * x * (x * x - 1.0) + 0.2;
        let prediction = Prediction {
            value,
            slopes: Derivatives { by_parameter: vec![slope], by_slip: [0.0; 6], by_load: [0.0; 6] },
        };
        (x <= self.end).then(|| vec![prediction; rows.len()])
    }
}

fn valleys(end: f64) -> (TwoValleys, Vec<Row>) {
    let coordinate = Coordinate { low: -2.0, high: 2.0, start: 1.5, ..free("x") };
    let mut row = blank(0);
    // Lower than either valley: the deeper one is nearer.
    row.readings[0] = Some(-3.0);
    row.noise[0] = 0.1;
    (TwoValleys { coordinates: [coordinate], end }, vec![row])
}

#[test]
fn many_starts_find_the_deeper_valley() {
    let (model, rows) = valleys(f64::INFINITY);
    let one = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    assert!(one.parameters[0] > 0.0);
    let starts = scattered_starts(&model, &rows, 8, 1);
    let best = fit_from_many(&model, &rows, &[], &starts, &plain()).unwrap();
    // The roots of 4 x (x² − 1) + 0.2.
    assert!((best.parameters[0] + 1.0241).abs() < 1e-3, "{:?}", best.parameters);
    let [agreed, fitted] = agreeing(&model, &rows, &starts, &plain());
    assert!(fitted == 8 && (2..8).contains(&agreed), "{agreed} of {fitted}");
    assert_eq!(fit_from_many(&model, &rows, &[], &[], &plain()).unwrap_err(), FitError::NoStart);
}

#[test]
fn where_nothing_is_predicted_the_fit_begins_nearer_to_the_middle() {
    let (model, rows) = valleys(0.9);
    let found = fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap();
    assert!(found.parameters[0] <= 0.9);
    let (model, rows) = valleys(-3.0);
    assert_eq!(fit(&model, &rows, &Start::of(&model, &rows), &plain()).unwrap_err(), FitError::NoPrediction);
}

#[test]
fn threads_change_no_bit() {
    let (model, rows) = campaign(&[4; 12], 4, 5);
    let with = |parallel: bool| {
        let offsets = std::array::from_fn(|c| if c < 4 { OffsetStd::Estimated } else { OffsetStd::None });
        let options = Options { parallel, offsets, ..plain() };
        let fit = fit(&model, &rows, &Start::of(&model, &rows), &options).unwrap();
        let mut numbers = fit.parameters.clone();
        numbers.extend(fit.offset_std);
        numbers.push(fit.log_likelihood);
        numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(with(true), with(false));
}
