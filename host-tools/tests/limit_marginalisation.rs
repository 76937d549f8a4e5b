//! The likelihood of a wheel, with its true slip and load integrated out to first order, against a full integration over
//! slip and sinkage.

use kapvik_firmware::terramechanics::{Soil, Wheel, sinkage_for_load, wheel_forces};
use kapvik_firmware::wheel_state::{SoilQuery, WheelNoise, WheelState};
use kapvik_host::limit::case::KAPVIK_LOADS;
use kapvik_host::limit::coordinates::{Coordinates, soil_at, targets_at};
use kapvik_host::limit::sampler::Effort;
use kapvik_host::limit::summary::draws;
use kapvik_host::limit::wheel_likelihood::{LoadPrior, WheelObservation};
use kapvik_host::train::dataset::stream;
use kapvik_host::train::observe::observe;
use kapvik_host::train::scene::{Design, scenes};

/// Half of the width of the integration, in standard deviations, and the intervals across it.
const REACH: f64 = 6.0;
const INTERVALS: usize = 36;

/// Chains are long enough for a handful of soils that lie all over the posterior.
const EFFORT: Effort = Effort {
    chains: 4,
    rounds: 1,
    round_steps: 10,
    batch_steps: 20,
    effective_size: 40.0,
    split_r_hat: 1.2,
    batches: 10,
};

/// ∫∫ N(DP) N(T) N(z) N(W) N(i) |∂W/∂z| di dz by the trapezoidal rule.
fn integrated(wheel: &Wheel<f64>, soil: &Soil<f64>, seen: &WheelState, noise: &WheelNoise, loads: LoadPrior) -> f64 {
    let load = |slip: f64, z: f64| wheel_forces(wheel, soil, slip, z).unwrap().load_n;
    let (slip_mean, slip_std) = (f64::from(seen.slip), f64::from(noise.slip));
    let (load_mean, load_std) = (f64::from(seen.load_n), f64::from(noise.load_n));
    let (low, high) = match loads {
        LoadPrior::Flat => (f64::NEG_INFINITY, f64::INFINITY),
        LoadPrior::Between(low, high) => (low, high),
    };
    let (least, most) = ((load_mean - REACH * load_std).max(low), (load_mean + REACH * load_std).min(high));
    if least >= most {
        return 0.0;
    }
    let grid = |low: f64, high: f64| (0..=INTERVALS).map(move |k| low + (high - low) * k as f64 / INTERVALS as f64);
    let mut sum = 0.0;
    for slip in grid(slip_mean - REACH * slip_std, slip_mean + REACH * slip_std) {
        let shallow = sinkage_for_load(wheel, soil, slip, least).unwrap();
        let deep = sinkage_for_load(wheel, soil, slip, most).unwrap();
        for (place, z) in grid(shallow, deep).enumerate() {
            let forces = wheel_forces(wheel, soil, slip, z).unwrap();
            let step = 1e-5 * z;
            let load_by_sinkage = (load(slip, z + step) - load(slip, z - step)) / (2.0 * step);
            let deviation = |value: f64, seen: f32, std: f32| ((value - f64::from(seen)) / f64::from(std)).powi(2);
            let mut squares = deviation(forces.drawbar_pull_n, seen.drawbar_pull_n, noise.drawbar_pull_n);
            squares += deviation(forces.torque_nm, seen.torque_nm, noise.torque_nm);
            squares += deviation(forces.load_n, seen.load_n, noise.load_n);
            squares += deviation(slip, seen.slip, noise.slip);
            squares += seen.sinkage_m.map_or(0.0, |seen| deviation(z, seen, noise.sinkage_m));
            let end = if place == 0 || place == INTERVALS { 0.5 } else { 1.0 };
            sum += end * (-0.5 * squares).exp() * load_by_sinkage * (deep - shallow);
        }
    }
    sum
}

/// Full less first-order logarithm of the likelihood of all wheels, but for a constant.
fn difference(query: &SoilQuery, wheel: &Wheel<f64>, point: &Coordinates, loads: LoadPrior) -> f64 {
    let soil = soil_at(point);
    let of_wheel = |state: &WheelState| {
        let first_order = WheelObservation::new(state, &query.noise).explain(wheel, point, loads, 0.02).unwrap();
        integrated(wheel, &soil, state, &query.noise, loads).ln() - first_order.ln_likelihood
    };
    query.wheels.iter().map(of_wheel).sum()
}

/// Weights the draws by full over first-order likelihood. Returns the standard deviation of its logarithm, and by how many
/// posterior standard deviations the mean of each target moves.
fn effect(instants: u32, sinkage: bool, case: usize, soils: usize) -> (f64, [f64; 3]) {
    let scene = scenes(Design::Kapvik { instants, sinkage }, case + 1, 3).pop().unwrap();
    let mut random = stream(4, case);
    let query = observe(&scene, &mut random);
    let all = draws(&query, KAPVIK_LOADS, &EFFORT, &mut random).unwrap();
    let points: Vec<&Coordinates> = all.iter().collect();
    let points: Vec<&Coordinates> = points.iter().step_by((points.len() / soils).max(1)).copied().collect();
    let wheel = &scene.wheel;
    let differences: Vec<f64> = points.iter().map(|point| difference(&query, wheel, point, KAPVIK_LOADS)).collect();
    let count = points.len() as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let std = (differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count).sqrt();
    let total: f64 = differences.iter().map(|d| (d - mean).exp()).sum();
    let shift = |k: usize| {
        let value = |point: &Coordinates| targets_at(point)[k];
        let plain = points.iter().map(|point| value(point)).sum::<f64>() / count;
        let spread = (points.iter().map(|point| (value(point) - plain).powi(2)).sum::<f64>() / count).sqrt();
        let weighted: f64 = points.iter().zip(&differences).map(|(point, d)| value(point) * (d - mean).exp()).sum();
        (weighted / total - plain) / spread
    };
    (std, [shift(0), shift(1), shift(2)])
}

/// The likelihood's logarithm, and with it every posterior mean, is known far better than sampling knows it (0.07 standard
/// deviations for an effective size of 200).
#[test]
fn first_order_is_enough() {
    for (instants, sinkage, case) in [(1, true, 0), (1, true, 6), (1, false, 4), (100, true, 3)] {
        let (std, shifts) = effect(instants, sinkage, case, 8);
        println!("{instants} instants, sinkage {sinkage}, case {case}: {std:.4}, {shifts:.4?}");
        assert!(std < 0.05, "the logarithm of the likelihood errs by {std}");
        assert!(shifts.iter().all(|shift| shift.abs() < 0.05), "the means move by {shifts:?} standard deviations");
    }
}
