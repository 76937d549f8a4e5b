//! What single precision costs, and that it survives what costs the most.

use kapvik_firmware::filter::trial::{Scales, Trial};
use kapvik_firmware::filter::{Fusion, Gate, Gaussian, Prediction, SigmaPointFilter};

use super::worse::worse;
use super::{predict, start, update};

/// The furthest that single precision is from double, in standard deviations, over a run; and the worst ratio of the two's
/// standard deviations, less one.
fn worst_difference<const N: usize, const M: usize>(scales: &Scales, steps: usize) -> (f64, f64) {
    let mut trial = Trial::<N, M>::new(1, *scales);
    let (mut single, mut double) = (start::<f32, N>(scales), start::<f64, N>(scales));
    let (mut of_mean, mut of_std) = (0.0_f64, 0.0_f64);
    for _ in 0..steps {
        let measured = trial.measure();
        assert_eq!((predict(&mut single, scales), predict(&mut double, scales)), (Prediction::Done, Prediction::Done));
        let in_single = update(&mut single, scales, &measured.map(Some), Gate::Open);
        let in_double = update(&mut double, scales, &measured.map(|value| Some(f64::from(value))), Gate::Open);
        assert_eq!((in_single.fusion, in_double.fusion), (Fusion::Done, Fusion::Done));
        let stds = single.estimate().stds().into_iter().zip(double.estimate().stds());
        for ((a, b), (std_a, std_b)) in single.estimate().mean().iter().zip(double.estimate().mean()).zip(stds) {
            of_mean = worse(of_mean, (f64::from(*a) - b).abs() / std_b);
            of_std = worse(of_std, (f64::from(std_a) / std_b - 1.0).abs());
        }
    }
    println!("{N} states, {M} measurements: means differ by {of_mean:.1e} σ, standard deviations by {of_std:.1e}");
    (of_mean, of_std)
}

#[test]
fn single_precision_is_within_a_thousandth_of_a_standard_deviation() {
    for (of_mean, of_std) in
        [worst_difference::<6, 6>(&Scales::NOMINAL, 4000), worst_difference::<12, 18>(&Scales::NOMINAL, 1500)]
    {
        assert!(of_mean <= 1e-3 && of_std <= 1e-3, "{of_mean} {of_std}");
    }
}

/// Runs a stiff problem in single precision; gives the root mean square error of the second half, in units of the noise.
fn survive<const N: usize, const M: usize>(scales: &Scales, seed: u32, steps: usize) -> f32 {
    let mut trial = Trial::<N, M>::new(seed, *scales);
    let mut filter = start::<f32, N>(scales);
    let (mut squares, mut count) = (0.0, 0.0);
    for step in 0..steps {
        assert_eq!(predict(&mut filter, scales), Prediction::Done);
        let told = update(&mut filter, scales, &trial.measure().map(Some), Gate::Open);
        assert_eq!(told.fusion, Fusion::Done, "step {step}");
        assert!(filter.estimate().mean().iter().chain(&filter.estimate().variances()).all(|value| value.is_finite()));
        if 2 * step >= steps {
            let errors = filter.estimate().mean().iter().zip(trial.truth()).map(|(mean, truth)| mean - truth);
            squares += errors.map(|error| (error / scales.noise_std).powi(2)).sum::<f32>();
            count += N as f32;
        }
    }
    assert_eq!(filter.resets(), 0);
    (squares / count).sqrt()
}

#[test]
fn a_start_10_to_the_10_times_as_uncertain_as_the_sensors_is_survived() {
    let ratio = (Scales::STIFF.start_std / Scales::STIFF.noise_std).powi(2);
    assert!(ratio >= 0.999e10, "{ratio}");
    for seed in 1..=10 {
        let errors = [survive::<6, 6>(&Scales::STIFF, seed, 1500), survive::<12, 18>(&Scales::STIFF, seed, 1500)];
        println!("seed {seed}: errors of {errors:?} standard deviations of the noise");
        // No estimate is worse than the bare measurement.
        assert!(errors.iter().all(|error| *error < 1.0), "{errors:?}");
    }
}

#[test]
fn a_million_steps_of_a_random_walk_stay_well() {
    let scales = Scales::NOMINAL;
    let start = Gaussian::independent([0.0_f32; 3], [scales.start_std; 3]).expect("numbers");
    let mut filter = SigmaPointFilter::new(start, [scales.start_std; 3]).expect("numbers");
    let mut trial = Trial::<3, 2>::new(7, scales);
    for _ in 0..1_000_000 {
        assert_eq!(filter.random_walk(&[scales.process_std; 3]), Prediction::Done);
        let told = update(&mut filter, &scales, &trial.measure().map(Some), Gate::Open);
        assert_eq!(told.fusion, Fusion::Done);
    }
    assert_eq!(filter.resets(), 0);
    let [_, _, unmeasured] = filter.estimate().stds();
    assert!(filter.estimate().mean().iter().all(|mean| mean.abs() < 10.0 * scales.start_std + unmeasured));
    // Nothing but the drift's variance gathers in the state that no measurement sees.
    let expected = scales.start_std.hypot(1000.0 * scales.process_std);
    assert!((unmeasured / expected - 1.0).abs() < 0.05, "{unmeasured} {expected}");
}
