//! Offsets that the rows of a run share, against the dense Gaussian.

use super::dense::Dense;
use super::toy::{Linear, OFFSET, campaign, plain};
use crate::diagnose::fit::{CHANNELS, Fit, OffsetStd, Options, Row, Start, VarianceCriterion, fit};

/// Priors of the latents that a dense matrix can bear.
fn options(offset: impl Fn(usize) -> OffsetStd) -> Options {
    Options { offsets: std::array::from_fn(offset), latent_prior_std: [1.0, 100.0], ..plain() }
}

fn fitted(model: &Linear, rows: &[Row], options: &Options) -> Fit {
    fit(model, rows, &Start::of(model, rows), options).unwrap()
}

#[test]
fn known_offsets_give_the_dense_estimate_and_density() {
    for seed in 0..5 {
        // One run is too small for an offset.
        let (model, rows) = campaign(&[3, 4, 1, 2, 5], 3, seed);
        let options = options(|c| if OFFSET[c] > 0.0 { OffsetStd::Known(OFFSET[c]) } else { OffsetStd::None });
        let fit = fitted(&model, &rows, &options);
        let dense = Dense::new(&model, &rows, &options, &OFFSET, &[1.0; CHANNELS]);
        let (parameters, covariance) = dense.estimate();
        for p in 0..3 {
            let std = covariance[(p, p)].sqrt();
            assert!((fit.parameters[p] - parameters[p]).abs() < 1e-4 * std, "{:?} {parameters}", fit.parameters);
            assert!((fit.covariance[(p, p)].sqrt() / std - 1.0).abs() < 1e-5);
        }
        let expected = dense.ln_density(parameters.as_slice());
        assert!((fit.log_likelihood - expected).abs() < 1e-4, "{} {expected}", fit.log_likelihood);
        assert!(fit.offsets[2].offset == [0.0; CHANNELS] && fit.offsets[0].offset[0] != 0.0);
    }
}

/// The estimated offsets are where the dense `criterion` is highest: no channel's can be moved by a little and gain.
fn is_highest(criterion: VarianceCriterion, value: impl Fn(&Dense) -> f64) {
    for seed in 10..14 {
        let (model, rows) = campaign(&[3, 4, 2, 3, 5, 2, 4], 3, seed);
        let mut options = options(|c| if c < 4 { OffsetStd::Estimated } else { OffsetStd::None });
        options.variance_criterion = criterion;
        let fit = fitted(&model, &rows, &options);
        assert!(fit.converged);
        let at = |offset: &[f64; CHANNELS]| value(&Dense::new(&model, &rows, &options, offset, &[1.0; CHANNELS]));
        let best = at(&fit.offset_std);
        for c in 0..4 {
            for factor in [0.8, 1.25] {
                let mut moved = fit.offset_std;
                moved[c] *= factor;
                assert!(at(&moved) < best + 1e-3, "channel {c}: {} × {factor}", fit.offset_std[c]);
            }
        }
    }
}

#[test]
fn estimated_offsets_are_at_the_maximum_of_the_dense_restricted_likelihood() {
    is_highest(VarianceCriterion::Restricted, Dense::restricted);
}

#[test]
fn estimated_offsets_are_at_the_maximum_of_the_dense_likelihood() {
    is_highest(VarianceCriterion::MaximumLikelihood, |dense| dense.ln_density(dense.estimate().0.as_slice()));
}

/// Noise and offsets together, from a first guess of the noise that is wrong by different factors.
#[test]
fn estimated_noise_is_at_the_maximum_of_the_dense_restricted_likelihood() {
    for seed in 14..17 {
        let (model, mut rows) = campaign(&[6, 5, 7, 6, 5, 6], 3, seed);
        for row in &mut rows {
            row.noise[0] *= 3.0;
            row.noise[1] *= 0.5;
        }
        let mut options = options(|c| if c < 4 { OffsetStd::Estimated } else { OffsetStd::None });
        options.estimate_noise = [true, true, false, false, false, false];
        let fit = fitted(&model, &rows, &options);
        assert!(fit.converged);
        let at = |noise: &[f64; CHANNELS]| Dense::new(&model, &rows, &options, &fit.offset_std, noise).restricted();
        let best = at(&fit.noise_scale);
        for (c, truth) in [(0, 1.0 / 3.0), (1, 2.0)] {
            assert!((fit.noise_scale[c] / truth).ln().abs() < 0.5, "{:?}", fit.noise_scale);
            for factor in [0.9, 1.1] {
                let mut moved = fit.noise_scale;
                moved[c] *= factor;
                assert!(at(&moved) < best + 1e-3, "channel {c}: {} × {factor}", fit.noise_scale[c]);
            }
        }
    }
}

#[test]
fn offsets_that_are_not_there_are_estimated_small() {
    // Rows that each drew offsets of their own, filed as runs of four: noise and nothing else.
    let (model, mut rows) = campaign(&[1; 48], 2, 21);
    for (index, row) in rows.iter_mut().enumerate() {
        row.run = index / 4;
        for (noise, offset) in row.noise.iter_mut().zip(OFFSET) {
            *noise = noise.hypot(offset);
        }
    }
    let options = options(|c| if c < 4 { OffsetStd::Estimated } else { OffsetStd::None });
    let fit = fitted(&model, &rows, &options);
    for c in 0..4 {
        assert!(fit.offset_std[c] < 0.6 * rows[0].noise[c], "{c}: {} of {}", fit.offset_std[c], rows[0].noise[c]);
    }
}

/// From where a fit ended, standard deviations included, the same answer is a step or two away. Scales are estimated until
/// they hardly change, so that what is gained by going on is little, and nothing is lost.
#[test]
fn a_fit_goes_on_from_where_one_ended() {
    let (model, rows) = campaign(&[3, 4, 2, 3, 5, 2, 4], 3, 10);
    let options = options(|c| if c < 4 { OffsetStd::Estimated } else { OffsetStd::None });
    let first = fitted(&model, &rows, &options);
    let again = fit(&model, &rows, &first.onward(), &options).unwrap();
    assert!(again.converged && again.iterations < first.iterations, "{} {}", again.iterations, first.iterations);
    let gain = again.log_likelihood - first.log_likelihood;
    assert!(gain > -1e-3 && gain < 1e-2, "{gain}");
    for c in 0..4 {
        assert!((again.offset_std[c] / first.offset_std[c]).ln().abs() < 0.05);
    }
}
