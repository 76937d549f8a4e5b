//! The trend of wheels that were made from one.

use super::{BENDS, Bend, LoadSums, OFFSET, SINKAGE_TERMS, TERMS, Trend, TrendNoise, WheelFeatures};

fn trend(wheels: &[WheelFeatures], noise: TrendNoise) -> Trend {
    let mut loads = LoadSums::default();
    wheels.iter().for_each(|wheel| loads.add(wheel));
    super::trend(wheels, loads, noise)
}

/// Mean coefficients over the training prior, of Legendre's polynomials of degree 3, 0, 1 and 2, of q, and of u q: least
/// squares, soil by soil, in f64.
const MEANS: [[f32; TERMS]; 2] = [
    [0.002_579, 0.330_678, 0.010_596, 0.006_308, 0.010_733, -0.000_126],
    [-0.004_183, 0.320_073, 0.125_643, 0.009_361, 0.001_276, -0.005_283],
];
/// The same of ln(z/r), of degree 0, 1 and 2 and of q.
const MEAN_OF_SINKAGE: [f32; SINKAGE_TERMS] = [-1.453_11, 0.021_135, 0.018_307, 0.064_809];

/// Six wheels whose channels are known combinations of the regressors; Legendre's polynomials written out anew.
fn wheels([resistance, torque]: [[f32; TERMS]; 2], sinkage: Option<[f32; SINKAGE_TERMS]>) -> Vec<WheelFeatures> {
    let ln_loads = [0.20_f32, 0.05, -0.15, 0.10, -0.25, 0.05]; // their mean is 0
    let slips = [0.02_f32, 0.10, 0.20, 0.35, 0.50, 0.70];
    let (least, most) = ((0.02 + OFFSET).ln(), (0.70 + OFFSET).ln());
    let wheel = |(slip, ln_load): (f32, f32)| {
        let u = (2.0 * (slip + OFFSET).ln() - least - most) / (most - least);
        let q = 10.0 * ln_load;
        let terms = |Bend { slip, load, both }| {
            let (v, load, u) = (u + slip * q, q + load * q * q, u + both * q);
            [(5.0 * v * v * v - 3.0 * v) / 2.0, 1.0, v, (3.0 * v * v - 1.0) / 2.0, load, load * u]
        };
        let sum = |coefficients: &[f32], terms: &[f32]| -> f32 {
            terms.iter().zip(coefficients).map(|(term, coefficient)| term * coefficient).sum()
        };
        let [of_resistance, of_torque] = BENDS.map(terms);
        let torque = sum(&torque, &of_torque);
        let plain = terms(Bend { slip: 0.0, load: 0.0, both: 0.0 });
        let sinkage = sinkage.map_or(0.0, |sinkage| sum(&sinkage, &plain[1..]).exp());
        [torque - sum(&resistance, &of_resistance), torque, slip, sinkage, ln_load]
    };
    slips.into_iter().zip(ln_loads).map(wheel).collect()
}

fn noise(share: f32, sinkage: bool) -> TrendNoise {
    let sinkage = sinkage.then_some(0.027 * share);
    TrendNoise { pull: 0.008 * share, load: 0.015 * share, torque: 0.01 * share, slip: 0.01 * share, sinkage }
}

/// The trend's coefficients less others, each over how much it matters: all regressors are at most 1 but for q and u q.
fn check(found: &Trend, truth: [[f32; TERMS]; 2], sinkage: [f32; SINKAGE_TERMS], bounds: [f32; 2]) {
    let (forces, others) = found.split_at(2 * TERMS);
    let (resistance, torque) = forces.split_at(TERMS);
    let (mut resistance, mut torque) = (resistance.to_vec(), torque.to_vec());
    resistance[1] = resistance[1].exp();
    let level = torque[1].exp();
    torque.iter_mut().for_each(|coefficient| *coefficient *= level);
    torque[1] = level;
    for (found, truth) in resistance.iter().chain(&torque).zip(truth.as_flattened()) {
        assert!((found - truth).abs() < bounds[0], "{found}, truth {truth}");
    }
    for (found, truth) in others.iter().zip(sinkage) {
        assert!((found - truth).abs() < bounds[1], "sinkage: {found}, truth {truth}");
    }
}

#[test]
fn finds_the_coefficients_that_made_the_wheels() {
    let truth = [[0.0024, 0.36, 0.012, 0.006, 0.012, 0.001], [-0.006, 0.40, 0.10, 0.008, 0.010, -0.007]];
    let sinkage = [-1.3, 0.03, 0.02, 0.07];
    let found = trend(&wheels(truth, Some(sinkage)), noise(1e-3, true));
    // The regression never trusts a wheel further than the misfit of its regressors.
    check(&found, truth, sinkage, [1e-3, 5e-3]);
}

#[test]
fn wheels_that_tell_nothing_leave_the_mean_of_the_prior() {
    let nothing = [[0.0; TERMS]; 2];
    for sinkage in [false, true] {
        let seen = sinkage.then_some([0.0; SINKAGE_TERMS]);
        let found = trend(&wheels(nothing, seen), noise(1e6, sinkage));
        check(&found, MEANS, MEAN_OF_SINKAGE, [1e-3 * MEANS[1][1], 1e-3]);
    }
}

#[test]
fn an_unseen_sinkage_is_what_the_forces_let_expect() {
    // A soil whose wheels meet twice the resistance sinks in deeper; the features say 0 for the sinkage.
    let twice = [MEANS[0].map(|coefficient| 2.0 * coefficient), MEANS[1]];
    let [.., least, _, _, _, _, _, _] = trend(&wheels(MEANS, None), noise(0.1, false));
    let [.., most, _, _, _, _, _, _] = trend(&wheels(twice, None), noise(0.1, false));
    assert!((least - MEAN_OF_SINKAGE[0]).abs() < 0.01, "{least}");
    assert!(most > least + 0.5, "{most}, {least}");
}

#[test]
fn the_order_of_the_wheels_does_not_matter_and_one_wheel_is_enough() {
    let mut wheels = wheels(MEANS, Some(MEAN_OF_SINKAGE));
    let first = trend(&wheels, noise(0.1, true));
    wheels.reverse();
    for (there, back) in first.into_iter().zip(trend(&wheels, noise(0.1, true))) {
        assert!((there - back).abs() < 1e-4 * (1.0 + there.abs()), "{there}, {back}");
    }
    assert!(trend(&wheels[..1], noise(0.1, true)).iter().all(|value| value.is_finite()));
}

#[test]
fn noise_of_any_size_gives_finite_numbers() {
    let wheels = wheels(MEANS, Some(MEAN_OF_SINKAGE));
    for share in [1e-30, 1e-6, 1.0, 1e6, 1e12, 1e30] {
        let sizes = [(share, 1.0), (1.0, share), (share, share)];
        for (of_torque, of_others) in sizes {
            let TrendNoise { torque, .. } = noise(of_torque, true);
            let found = trend(&wheels, TrendNoise { torque, ..noise(of_others, true) });
            assert!(found.iter().all(|value| value.is_finite()), "{of_torque:e}, {of_others:e}: {found:?}");
        }
    }
}
