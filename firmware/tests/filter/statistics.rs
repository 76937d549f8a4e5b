//! On a problem that is as the filter believes, its errors are as large as it says: normalised squares against χ².

use kapvik_firmware::filter::trial::{Scales, Trial};
use kapvik_firmware::filter::{Gate, Prediction, SigmaPointFilter};
use nalgebra::{SMatrix, SVector};

use super::{predict, start, update};

const RUNS: u32 = 400;
const STEPS: usize = 60;
/// Steps until the start's uncertainty is gone: over that wide a spread the cubic models have moments beyond those that any
/// sigma-point filter carries, and the innovations are not normal.
const SETTLING: usize = 10;

/// How many standard deviations a sum of squares of `count` independent normal numbers is from its mean: χ² with many degrees
/// of freedom is normal, with variance 2 `count`.
fn deviation(sum: f64, count: f64) -> f64 {
    (sum - count) / (2.0 * count).sqrt()
}

/// (x − m)ᵀ P⁻¹ (x − m)
fn error_squared<const N: usize>(filter: &SigmaPointFilter<f32, N>, truth: &[f32; N]) -> f64 {
    let estimate = filter.estimate();
    let covariance = SMatrix::<f64, N, N>::from_fn(|i, j| f64::from(estimate.covariance(i, j).expect("two states")));
    let error = SVector::<f64, N>::from_fn(|i, _| f64::from(truth[i] - estimate.mean()[i]));
    let solved = covariance.cholesky().expect("positive definite").solve(&error);
    error.dot(&solved)
}

/// Independent runs: the squared errors at the end of each, and the squared innovations of every step once settled.
fn consistency<const N: usize, const M: usize>() -> (f64, f64) {
    let scales = Scales::NOMINAL;
    let (mut errors, mut innovations, mut measurements) = (0.0, 0.0, 0.0);
    for run in 1..=RUNS {
        let mut trial = Trial::<N, M>::new(run.wrapping_mul(0x9e37_79b9), scales);
        let mut filter = start::<f32, N>(&scales);
        for step in 0..STEPS {
            assert_eq!(predict(&mut filter, &scales), Prediction::Done);
            let told = update(&mut filter, &scales, &trial.measure().map(Some), Gate::Open);
            if step >= SETTLING {
                innovations += f64::from(told.normalised_square);
                measurements += told.degrees_of_freedom as f64;
            }
        }
        errors += error_squared(&filter, trial.truth());
    }
    let states = f64::from(RUNS) * N as f64;
    println!("{N}/{M}: NEES {:.3} a state, NIS {:.4} a measurement", errors / states, innovations / measurements);
    (deviation(errors, states), deviation(innovations, measurements))
}

#[test]
fn errors_and_innovations_are_as_large_as_the_filter_says() {
    for (errors, innovations) in [consistency::<6, 6>(), consistency::<12, 18>(), consistency::<3, 2>()] {
        println!("errors {errors:.2} and innovations {innovations:.2} standard deviations of χ² from their mean");
        // Six numbers, each beyond 3.3 in one of a thousand sets of data.
        assert!(errors.abs() < 3.3 && innovations.abs() < 3.3, "{errors} {innovations}");
    }
}
