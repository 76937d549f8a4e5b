//! Readings that are not there.

use super::dense::Dense;
use super::toy::{campaign, plain};
use crate::diagnose::fit::{CHANNELS, FitError, Latent, Model, Options, Prediction, Start, fit};

fn options() -> Options {
    Options { latent_prior_std: [1.0, 100.0], ..plain() }
}

#[test]
fn what_is_left_counts_as_in_the_dense_gaussian() {
    let (model, mut rows) = campaign(&[1; 20], 2, 1);
    for (index, row) in rows.iter_mut().enumerate() {
        row.readings[index % CHANNELS] = None;
        row.readings[(index / 2) % CHANNELS] = None;
    }
    // A row of which nothing is measured, and one of a single torque: no reading tells its latents apart.
    rows[11].readings = [None; CHANNELS];
    rows[12].readings = [None, Some(0.1), None, None, None, None];
    let fit = fit(&model, &rows, &Start::of(&model, &rows), &options()).unwrap();
    let dense = Dense::new(&model, &rows, &options(), &[0.0; CHANNELS], &[1.0; CHANNELS]);
    let (parameters, covariance) = dense.estimate();
    assert!(fit.converged);
    for p in 0..2 {
        assert!((fit.parameters[p] - parameters[p]).abs() < 1e-4 * covariance[(p, p)].sqrt());
    }
    assert!((fit.log_likelihood - dense.ln_density(parameters.as_slice())).abs() < 1e-4);
    assert!(fit.standardised[11].iter().all(Option::is_none));
}

/// A model that knows nothing of channels that are not measured.
struct Ignorant(super::toy::Linear);

impl Model for Ignorant {
    fn coordinates(&self) -> &[crate::diagnose::fit::Coordinate] {
        self.0.coordinates()
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        let mut predictions = self.0.predict(parameters, rows, latents)?;
        for prediction in &mut predictions {
            prediction.value[3] = f64::NAN;
            prediction.slopes.by_slip[3] = f64::NAN;
            prediction.slopes.by_load[3] = f64::NAN;
            prediction.slopes.by_parameter.iter_mut().for_each(|derivatives| derivatives[3] = f64::NAN);
        }
        Some(predictions)
    }
}

#[test]
fn a_channel_that_is_not_measured_need_not_be_predicted() {
    let (model, mut rows) = campaign(&[2; 10], 2, 2);
    let ignorant = Ignorant(model.clone());
    let start = Start::of(&model, &rows);
    assert_eq!(fit(&ignorant, &rows, &start, &options()).unwrap_err(), FitError::NoPrediction);
    rows.iter_mut().for_each(|row| row.readings[3] = None);
    let expected = fit(&model, &rows, &start, &options()).unwrap();
    let found = fit(&ignorant, &rows, &start, &options()).unwrap();
    assert_eq!(found.parameters, expected.parameters);
    assert_eq!(found.log_likelihood.to_bits(), expected.log_likelihood.to_bits());
    let held = |model: &dyn Model| found.leave_out(model, &[0]).unwrap().log_score().unwrap();
    assert_eq!(held(&ignorant).to_bits(), held(&model).to_bits());
}

#[test]
fn unsound_input_is_refused() {
    let (model, rows) = campaign(&[2; 3], 2, 3);
    let start = Start::of(&model, &rows);
    let refusal = |rows: &[_], start: &Start| fit(&model, rows, start, &options()).unwrap_err();
    let mut spoilt = rows.clone();
    spoilt[4].noise[0] = 0.0;
    assert_eq!(refusal(&spoilt, &start), FitError::UnsoundRow { row: 4 });
    let mut spoilt = rows.clone();
    spoilt[2].readings[1] = Some(f64::NAN);
    assert_eq!(refusal(&spoilt, &start), FitError::UnsoundRow { row: 2 });
    assert_eq!(refusal(&rows, &Start { parameters: vec![0.0], ..start.clone() }), FitError::UnfitStart);
    assert_eq!(refusal(&[], &Start { latents: Vec::new(), ..start.clone() }), FitError::NoRows);
    let all = fit(&model, &rows, &start, &options()).unwrap();
    assert_eq!(all.leave_out(&model, &[0, 1, 2]).unwrap_err(), FitError::NoRows);
}
