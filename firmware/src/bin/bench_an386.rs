//! What flight functions cost on the target, and the fingerprints of their results: run under `-icount shift=0`.
#![no_std]
#![no_main]

use core::hint::black_box;

use heapless::Vec;
use kapvik_board_an386::{bench::Bench, entry, exit};
use kapvik_firmware::filter::trial::{self, Scales, Trial};
use kapvik_firmware::filter::{Gate, Gaussian, Innovation, Prediction, SigmaPointFilter};
use kapvik_firmware::fingerprint::{FINGERPRINTS, SOILS};
use kapvik_firmware::frozen::{ROVER, WHEEL as WHEEL_TABLE};
use kapvik_firmware::math;
use kapvik_firmware::network::RoverGolden;
use kapvik_firmware::terramechanics::{Wheel, sinkage_for_load, wheel_forces};
use kapvik_firmware::wheel_state::{SoilQuery, WheelNoise, WheelState};

/// The problem that the filter's steps are counted on.
const SCALES: Scales = Scales::NOMINAL;

const WHEEL: Wheel<f32> = Wheel { radius_m: 0.075, width_m: 0.07 };

#[entry]
fn main() -> ! {
    let bench = Bench::start();
    let [firm, ..] = SOILS;
    // A line each: name, the range of the input, the function.
    bench.kernel("sin_cos", -3.1, 3.1, math::sin_cos);
    bench.kernel("acos", -1.0, 1.0, math::acos);
    bench.kernel("exp", -20.0, 5.0, math::exp);
    bench.kernel("ln", 1e-3, 1e3, math::ln);
    bench.kernel("powf", 0.0, 1.0, |x| math::powf(x, 1.1));
    bench.kernel("sqrt", 0.0, 1e3, math::sqrt);
    bench.kernel("tanh", -4.0, 4.0, math::tanh);
    bench.kernel("wheel_forces", 0.0, 0.9, |slip| wheel_forces(&WHEEL, &firm, slip, 0.015));
    bench.kernel("sinkage_for_load", 10.0, 90.0, |load_n| sinkage_for_load(&WHEEL, &firm, 0.2, load_n));
    let [one_wheel, ..] = &WHEEL_TABLE.golden;
    bench.kernel("wheel_network", 0.02, 0.6, |slip| {
        let mut input = one_wheel.input;
        input[2] = slip;
        WHEEL_TABLE.outputs(&input)
    });
    let [first, ..] = &ROVER.golden;
    let six_wheels = ROVER.golden.iter().find(|pair| pair.count == 6.0).unwrap_or(first);
    bench.kernel("rover_network", 0.02, 0.6, |slip| rover_outputs(six_wheels, slip));
    let mut query = six_wheels_query();
    bench.kernel("rover_features", 0.02, 0.6, |slip| {
        query.wheels.iter_mut().take(1).for_each(|state| state.slip = slip);
        black_box(&query.rover_features());
    });
    filter_step::<6, 6>(&bench, "filter_6_6", predicted);
    filter_step::<12, 18>(&bench, "filter_12_18", predicted);
    filter_step::<9, 12>(&bench, "filter_9_12_random_walk", drifted);
    filter_step::<3, 2>(&bench, "filter_3_2", predicted);
    for print in &FINGERPRINTS {
        bench.fingerprint(print.name, (print.compute)());
    }
    exit(0)
}

/// Six wheels at spread slips, with sinkage.
fn six_wheels_query() -> SoilQuery {
    let noise = WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.05, slip: 0.01, sinkage_m: 0.002 };
    let mut query = SoilQuery { wheel: WHEEL, noise, slope: None, wheels: Vec::new() };
    for slip in [0.05, 0.16, 0.27, 0.38, 0.49, 0.60] {
        let state = WheelState {
            drawbar_pull_n: 20.0 * slip - 4.0,
            load_n: 60.0 + 10.0 * slip,
            torque_nm: 1.0 + 2.0 * slip,
            slip,
            sinkage_m: Some(0.018),
        };
        let _ = query.wheels.push(state);
    }
    query
}

/// The rover network with one slip changed, so that nothing is computed ahead.
fn rover_outputs(pair: &RoverGolden, slip: f32) -> [f32; 6] {
    let mut wheels = pair.wheels;
    wheels[0][2] = slip;
    ROVER.outputs(&pair.context, wheels.iter().copied())
}

/// One step of a filter of `N` states and `M` measurements that runs on, measurement after measurement.
fn filter_step<const N: usize, const M: usize>(
    bench: &Bench,
    name: &str,
    predict: fn(&mut SigmaPointFilter<f32, N>) -> Prediction,
) {
    const STEPS: usize = 64;
    let mut trial = Trial::<N, M>::new(1, SCALES);
    let measured: [[Option<f32>; M]; STEPS] = [(); STEPS].map(|()| trial.measure().map(Some));
    let started = Gaussian::independent([0.0; N], [SCALES.start_std; N])
        .and_then(|start| SigmaPointFilter::new(start, [SCALES.start_std; N]));
    let Ok(mut filter) = started else { return };
    bench.kernel(name, 0.0, (STEPS - 1) as f32, |step| {
        let prediction = predict(&mut filter);
        (prediction, measured.get(step as usize).map(|measured| update(&mut filter, measured)))
    });
}

fn predicted<const N: usize>(filter: &mut SigmaPointFilter<f32, N>) -> Prediction {
    filter.predict(trial::process, &[SCALES.process_std; N])
}

fn drifted<const N: usize>(filter: &mut SigmaPointFilter<f32, N>) -> Prediction {
    filter.random_walk(&[SCALES.process_std; N])
}

fn update<const N: usize, const M: usize>(
    filter: &mut SigmaPointFilter<f32, N>,
    measured: &[Option<f32>; M],
) -> Innovation<f32, M> {
    filter.update(trial::measurement, measured, &[SCALES.noise_std; M], Gate::one_in_a_thousand())
}
