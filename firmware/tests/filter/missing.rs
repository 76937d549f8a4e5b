//! A measurement that is not there changes nothing.

use kapvik_firmware::filter::trial::{self, Scales, Trial};
use kapvik_firmware::filter::{Fate, Fusion, Gate, Prediction, SigmaPointFilter};

use super::{bits, predict, start, update};

const N: usize = 6;
const M: usize = 6;
const SCALES: Scales = Scales::NOMINAL;

/// The update of a filter that knows of no other measurements than the `K` at these places.
fn update_with_only<const K: usize>(filter: &mut SigmaPointFilter<f32, N>, measured: &[f32; M], places: &[usize]) {
    let chosen: [usize; K] = places.try_into().expect("as many places");
    let model = |x: &[f32; N]| {
        let all: [f32; M] = trial::measurement(x);
        chosen.map(|place| all[place])
    };
    let told = filter.update(model, &chosen.map(|place| Some(measured[place])), &[SCALES.noise_std; K], Gate::Open);
    assert_eq!(told.degrees_of_freedom, K);
}

#[test]
fn every_pattern_gives_the_bits_of_a_filter_without_those_rows() {
    let mut trial = Trial::<N, M>::new(3, SCALES);
    for pattern in 0_u32..1 << M {
        let mut filter = start::<f32, N>(&SCALES);
        for _ in 0..3 {
            assert_eq!(predict(&mut filter, &SCALES), Prediction::Done);
            let measured = trial.measure();
            let there = |place: usize| pattern >> place & 1 == 1;
            let places: Vec<usize> = (0..M).filter(|place| there(*place)).collect();
            let mut other = filter;
            match places.len() {
                0 => (),
                1 => update_with_only::<1>(&mut other, &measured, &places),
                2 => update_with_only::<2>(&mut other, &measured, &places),
                3 => update_with_only::<3>(&mut other, &measured, &places),
                4 => update_with_only::<4>(&mut other, &measured, &places),
                5 => update_with_only::<5>(&mut other, &measured, &places),
                _ => update_with_only::<6>(&mut other, &measured, &places),
            }
            let mut place = 0..M;
            let given = measured.map(|value| there(place.next().expect("as many")).then_some(value));
            let told = update(&mut filter, &SCALES, &given, Gate::Open);
            assert_eq!(told.degrees_of_freedom, places.len());
            assert_eq!(told.fusion, if places.is_empty() { Fusion::NothingToFuse } else { Fusion::Done });
            for (index, residual) in told.residuals.iter().enumerate() {
                assert_eq!(residual.fate, if there(index) { Fate::Used } else { Fate::Missing });
                assert!(residual.std > SCALES.noise_std, "what would have been expected is known all the same");
            }
            assert_eq!(bits(filter.estimate()), bits(other.estimate()), "pattern {pattern:06b}");
        }
    }
}
