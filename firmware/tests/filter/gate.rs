//! The gate keeps wild measurements out, and nothing else.

use kapvik_firmware::filter::trial::{Scales, Trial};
use kapvik_firmware::filter::{Fate, Fusion, Gate, Gaussian, Prediction, SigmaPointFilter};

use super::{bits, predict, start, update};

const SCALES: Scales = Scales::NOMINAL;

#[test]
fn the_threshold_is_where_it_says() {
    // Prior variance 3 and noise variance 1: the innovation has a standard deviation of 2.
    let start = Gaussian::independent([10.0], [3.0_f64.sqrt()]).expect("numbers");
    let edge = 2.0 * 10.8_f64.sqrt();
    for (offset, fate) in [(edge - 1e-6, Fate::Used), (edge + 1e-6, Fate::Rejected), (-edge - 1e-6, Fate::Rejected)] {
        let mut filter = SigmaPointFilter::new(start, [1.0]).expect("numbers");
        let told = filter.update(|x| *x, &[Some(10.0 + offset)], &[1.0], Gate::one_in_a_thousand());
        assert_eq!(told.residuals[0].fate, fate, "{offset}");
        assert!((told.residuals[0].normalised().expect("measured") - offset / 2.0).abs() < 1e-12);
        assert_eq!(told.fusion, if fate == Fate::Used { Fusion::Done } else { Fusion::NothingToFuse });
        assert_eq!(filter.estimate().mean()[0] == 10.0, fate == Fate::Rejected);
    }
}

#[test]
fn one_wild_measurement_does_not_poison_the_others() {
    let wild = [20.0 * SCALES.noise_std, -1e6, 1e30, f32::MAX, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for (seed, (place, error)) in (0..6).flat_map(|place| wild.map(|error| (place, error))).enumerate() {
        let mut trial = Trial::<6, 6>::new(seed as u32 + 1, SCALES);
        let mut filter = start::<f32, 6>(&SCALES);
        for _ in 0..20 {
            assert_eq!(predict(&mut filter, &SCALES), Prediction::Done);
            let _ = update(&mut filter, &SCALES, &trial.measure().map(Some), Gate::one_in_a_thousand());
        }
        assert_eq!(predict(&mut filter, &SCALES), Prediction::Done);
        let mut measured = trial.measure().map(Some);
        let mut without = filter;
        measured[place] = None;
        let expected = update(&mut without, &SCALES, &measured, Gate::one_in_a_thousand());
        measured[place] = Some(trial.truth()[place] + error);
        let told = update(&mut filter, &SCALES, &measured, Gate::one_in_a_thousand());
        let fate = if error.is_finite() { Fate::Rejected } else { Fate::NotFinite };
        assert_eq!(told.residuals[place].fate, fate, "{error}");
        assert_eq!(told.degrees_of_freedom, expected.degrees_of_freedom);
        assert_eq!(told.normalised_square, expected.normalised_square);
        assert_eq!(bits(filter.estimate()), bits(without.estimate()), "{error}");
    }
}

#[test]
fn an_open_gate_takes_what_it_gets() {
    let mut filter = start::<f32, 6>(&SCALES);
    let told = update(&mut filter, &SCALES, &[Some(100.0); 6], Gate::Open);
    assert_eq!((told.fusion, told.degrees_of_freedom), (Fusion::Done, 6));
    assert!(told.normalised_square > 6.0 * 10.8);
}

#[test]
fn a_filter_that_shuts_everything_out_finds_back_once_it_is_widened() {
    let mut trial = Trial::<6, 6>::new(4, SCALES);
    let mut filter = start::<f32, 6>(&SCALES);
    for _ in 0..50 {
        assert_eq!(predict(&mut filter, &SCALES), Prediction::Done);
        let _ = update(&mut filter, &SCALES, &trial.measure().map(Some), Gate::one_in_a_thousand());
    }
    let jumped = Gaussian::independent(filter.estimate().mean().map(|mean| mean + 5.0), filter.estimate().stds());
    filter.restart(jumped.expect("numbers"));
    for step in 0..20 {
        assert_eq!(predict(&mut filter, &SCALES), Prediction::Done);
        let told = update(&mut filter, &SCALES, &trial.measure().map(Some), Gate::one_in_a_thousand());
        if step == 0 {
            assert_eq!(told.fusion, Fusion::NothingToFuse);
        }
        if told.fusion == Fusion::NothingToFuse {
            let before = filter.estimate().stds();
            assert_eq!(filter.widen(10.0), Prediction::Done);
            let after = filter.estimate().stds();
            assert!(before.iter().zip(after).all(|(before, after)| (after / before - 10.0).abs() < 1e-5));
        }
    }
    let stds = filter.estimate().stds();
    let errors = filter.estimate().mean().iter().zip(trial.truth()).zip(stds);
    assert!(errors.into_iter().all(|((mean, truth), std)| (mean - truth).abs() < 4.0 * std));
}
