//! The posterior of a soil: by a second method, and calibrated over cases drawn from its own prior.

use kapvik_firmware::wheel_state::SoilQuery;
use kapvik_host::limit::calibration::{distance_bound, distance_from_uniform};
use kapvik_host::limit::case::{KAPVIK_LOADS, cases};
use kapvik_host::limit::coordinates::{Coordinates, targets_at};
use kapvik_host::limit::posterior::SoilPosterior;
use kapvik_host::limit::sampler::Effort;
use kapvik_host::limit::summary::{EFFORT, draws};
use kapvik_host::train::dataset::stream;
use kapvik_host::train::observe::observe;
use kapvik_host::train::scene::{Design, scenes};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Mean of a target and its standard error, by weighting draws from the prior.
fn from_the_prior(query: &SoilQuery, count: usize) -> [(f64, f64); 3] {
    let posterior = SoilPosterior::new(query, KAPVIK_LOADS);
    let weighted: Vec<(Coordinates, f64)> = (0..count)
        .into_par_iter()
        .filter_map(|index| {
            let mut random = stream(11, index);
            let point = Coordinates::from_fn(|_, _| StandardNormal.sample(&mut random));
            let found = posterior.evaluate(&point, &posterior.guess())?;
            Some((point, found.ln_density + 0.5 * point.norm_squared()))
        })
        .collect();
    let greatest = weighted.iter().map(|draw| draw.1).fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = weighted.iter().map(|draw| (draw.1 - greatest).exp()).sum();
    let shares: Vec<(Coordinates, f64)> =
        weighted.iter().map(|(point, ln)| (*point, (ln - greatest).exp() / total)).collect();
    let worth = 1.0 / shares.iter().map(|(_, share)| share * share).sum::<f64>();
    assert!(worth > 200.0, "only {worth} draws of the prior count");
    std::array::from_fn(|k| {
        let value = |point: &Coordinates| targets_at(point)[k];
        let mean: f64 = shares.iter().map(|(point, share)| share * value(point)).sum();
        let squares: f64 = shares.iter().map(|(point, share)| (share * (value(point) - mean)).powi(2)).sum();
        (mean, squares.sqrt())
    })
}

/// Two wheels with noisy sensors leave so much of the prior that draws from it find the posterior too.
#[test]
fn draws_from_the_prior_find_the_same_posterior() {
    for (case, sinkage) in [(0, true), (1, false)] {
        let mut scene = scenes(Design::Kapvik { instants: 1, sinkage }, case + 1, 3).pop().unwrap();
        scene.wheels = [scene.wheels[1], scene.wheels[5]].into_iter().collect();
        let noise = &mut scene.noise;
        for std in [&mut noise.drawbar_pull_n, &mut noise.torque_nm, &mut noise.sinkage_m] {
            *std *= 3.0;
        }
        let mut random = stream(4, case);
        let query = observe(&scene, &mut random);
        let effort = Effort { effective_size: 1500.0, batch_steps: 200, ..EFFORT };
        let draws = draws(&query, KAPVIK_LOADS, &effort, &mut random).unwrap();
        let expected = from_the_prior(&query, 30_000);
        for (k, (mean, error)) in expected.into_iter().enumerate() {
            let found = draws.diagnose(|point| targets_at(point)[k]);
            let error = error.hypot(found.standard_error());
            println!("case {case} target {k}: {} and {mean}, ± {error}", found.mean);
            assert!((found.mean - mean).abs() < 4.0 * error, "target {k}: {} not {mean} ± {error}", found.mean);
        }
    }
}

#[test]
fn the_truth_has_a_uniform_rank() {
    let count = 24;
    let effort = Effort { effective_size: 60.0, split_r_hat: 1.1, ..EFFORT };
    for instants in [1, 100] {
        let design = Design::Kapvik { instants, sinkage: true };
        let cases = cases(design, count, 99, KAPVIK_LOADS, &effort, || ()).unwrap();
        // 1/60 more for the scatter of the draws themselves.
        let bound = distance_bound(count, 1e-4) + 1.0 / 60.0;
        for k in 0..3 {
            let distance = distance_from_uniform(cases.iter().map(|case| case.summary.ranks(&case.truth)[k]).collect());
            assert!(distance < bound, "target {k}: {distance} from uniform, bound {bound}");
            // A standardised error has mean square one, which scatters as χ² does where it is normal and less where it is uniform.
            let squares = cases.iter().map(|case| {
                let target = case.summary.targets[k];
                ((case.truth[k] - target.mean) / target.std).powi(2)
            });
            let mean = squares.sum::<f64>() / count as f64;
            println!("{instants} instants, target {k}: {distance:.3} from uniform, mean square error {mean:.3}");
            let chi_squared = ChiSquared::new(count as f64).unwrap();
            let [low, high] = [1e-3, 1.0 - 1e-3].map(|share| chi_squared.inverse_cdf(share) / count as f64);
            assert!(low < mean && mean < high, "target {k}: mean square error {mean} not within {low} and {high}");
        }
    }
}

#[test]
fn ranks_that_crowd_are_told() {
    assert!((distance_from_uniform(vec![0.125, 0.375, 0.625, 0.875]) - 0.125).abs() < 1e-12);
    assert!((distance_from_uniform(vec![0.9, 0.5, 0.7, 0.6]) - 0.5).abs() < 1e-12);
    // Kolmogorov's limiting distribution has its 99 % point at 1.6276/√n.
    assert!((distance_bound(100, 0.01) / 0.162_76 - 1.0).abs() < 0.001);
}
