//! The bound against the scatter of estimates from simulated measurements of a manoeuvre.
//!
//! The estimator knows nothing of the bound's code: forces from the f64 equations at a sinkage that is solved for, balances as
//! METHODS 3.2 writes them for level ground, all slopes by differences, and a plain Gauss–Newton iteration.

use kapvik_firmware::rover::{PerAxle, Rover};
use kapvik_firmware::terramechanics::{Soil, sinkage_for_load, wheel_forces};
use kapvik_host::identifiability::beforehand::{Beforehand, prior_stds};
use kapvik_host::identifiability::cost::CostWeights;
use kapvik_host::identifiability::manoeuvre::{Leg, Pattern, RimSpeeds};
use kapvik_host::identifiability::rover_side::RoverMeasurement;
use kapvik_host::identifiability::search::{Manoeuvre, Question};
use kapvik_host::identifiability::sensors::{FRAMES_PER_SECOND, LastingErrors};
use kapvik_host::identifiability::target::Target;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

const TIME_S: f64 = 20.0;
const DRAWS: usize = 120;
/// ln c, φ, ln K, n, ln k, c₁, c₂; velocimeter's scale, pitch; biases of three load cells and three torques, left and right.
const UNKNOWNS: usize = 7 + 2 + 12;
/// Three torques, forces along and across the ground, moments of bogie and rocker.
const CHANNELS: usize = 7;

fn soil_of(x: &[f64]) -> Soil<f64> {
    Soil {
        cohesion_pa: x[0].exp(),
        friction_angle_rad: x[1],
        shear_modulus_m: x[2].exp(),
        sinkage_exponent: x[3],
        frictional_modulus: x[4].exp(),
        cohesive_modulus: 0.0,
        peak_stress_c1: x[5],
        peak_stress_c2: x[6],
        rebound_ratio: 0.0,
    }
}

fn truth() -> [f64; 7] {
    [250_f64.ln(), 31.9_f64.to_radians(), 0.0114_f64.ln(), 1.10, (15.6e3_f64 / 0.070 + 2407.4e3).ln(), 0.18, 0.32]
}

/// What one side showed, averaged.
#[derive(Clone, Copy)]
struct Seen {
    slips: [f64; 3],
    loads_n: [f64; 3],
    torques_nm: [f64; 3],
    pulls_by_ground_n: [f64; 3],
    pitch_rad: f64,
}

/// Channels of a side: what the soil predicts less what was seen.
fn channels(
    rover: &Rover<f64>,
    soil: &Soil<f64>,
    seen: &Seen,
    biases: &[f64],
    scale: f64,
    pitch: f64,
) -> SVector<f64, CHANNELS> {
    let wheel = &rover.wheel;
    let (mut pulls, mut torques, mut loads) = ([0.0; 3], [0.0; 3], [0.0; 3]);
    for axle in 0..3 {
        let slip = seen.slips[axle] - (1.0 - seen.slips[axle].abs()) * scale;
        loads[axle] = seen.loads_n[axle] - biases[axle];
        let sinkage_m = sinkage_for_load(wheel, soil, slip, loads[axle]).unwrap();
        let forces = wheel_forces(wheel, soil, slip, sinkage_m).unwrap();
        pulls[axle] = forces.drawbar_pull_n + seen.pulls_by_ground_n[axle];
        torques[axle] = forces.torque_nm;
    }
    let [p1, p2, p3] = pulls;
    let [w1, w2, w3] = loads;
    let [t1, t2, t3] = torques;
    let half_n = 0.5 * rover.mass_kg * rover.gravity_m_s2;
    let (sine, cosine) = (seen.pitch_rad - pitch).sin_cos();
    let seen_nm = |axle: usize| seen.torques_nm[axle] - biases[3 + axle];
    SVector::from([
        t1 - seen_nm(0),
        t2 - seen_nm(1),
        t3 - seen_nm(2),
        p1 + p2 + p3 - half_n * sine,
        w1 + w2 + w3 - half_n * cosine,
        -0.10 * (p2 + p3) - 0.175 * w2 + 0.175 * w3 - t2 - t3,
        -0.20 * p1 - 0.35 * w1 - t1 - 0.10 * (p2 + p3) + 0.175 * (w2 + w3) - half_n * 0.05 * sine,
    ])
}

#[test]
fn estimates_scatter_as_the_bound_says() {
    let rover = Rover::<f64>::assumed();
    let lasting = LastingErrors::default();
    let ground_n = 0.5 * FRAMES_PER_SECOND.sqrt();
    let soil = soil_of(&truth());
    let question = Question {
        rover,
        soil,
        targets: Target::ALL.to_vec(),
        accuracy: 0.1,
        longest_s: 120.0,
        steepest_rad: 0.0,
        speeds: RimSpeeds::default(),
        measurement: RoverMeasurement { sinkage_m: None, ground_n, lasting, beforehand: Beforehand::default() },
        weights: CostWeights::default(),
    };
    let pattern = Pattern::Roll(PerAxle::from_array([1.0, 1.3, 1.0]));
    let driven = question.driven(Leg { pattern, slope_rad: 0.0 }).unwrap();
    let legs = [driven];
    let bound = question.bound(&Manoeuvre::of(&legs).unwrap(), TIME_S).unwrap();

    let wheels = legs[0].drive.wheels.into_array();
    let speed = legs[0].drive.hub_speed_m_s;
    let exact = wheels.map(|wheel| {
        let sinkage_m = sinkage_for_load(&rover.wheel, &soil, wheel.slip, wheel.load_n).unwrap();
        wheel_forces(&rover.wheel, &soil, wheel.slip, sinkage_m).unwrap().torque_nm
    });
    let quiet = Seen {
        slips: wheels.map(|wheel| wheel.slip),
        loads_n: wheels.map(|wheel| wheel.load_n),
        torques_nm: exact,
        pulls_by_ground_n: [0.0; 3],
        pitch_rad: 0.0,
    };
    // The steady drive balances by the closed forms, too.
    let left_over = channels(&rover, &soil, &quiet, &[0.0; 6], 0.0, 0.0);
    assert!(left_over.amax() < 2e-3, "{left_over}");

    let root = 1.0 / (TIME_S * FRAMES_PER_SECOND).sqrt();
    let noise = rover.noise;
    let slip_stds = wheels.map(|wheel| {
        // d(1 − v/(rω)) by v and by ω.
        let of_speed = noise.velocity_m_s / wheel.rim_speed_m_s;
        let of_rate = speed / wheel.rim_speed_m_s.powi(2) * noise.wheel_rate_rad_s * rover.wheel.radius_m;
        assert!(wheel.slip > 0.0);
        root * of_speed.hypot(of_rate)
    });
    let blurred = |random: &mut dyn FnMut() -> f64, lasting_errors: &[f64], scale: f64, pitch: f64| {
        let mut seen = quiet;
        for axle in 0..3 {
            seen.slips[axle] += slip_stds[axle] * random() + (1.0 - quiet.slips[axle].abs()) * scale;
            seen.loads_n[axle] += root * noise.load_cell_n * random() + lasting_errors[axle];
            seen.torques_nm[axle] += root * noise.motor_torque_nm * random() + lasting_errors[3 + axle];
            seen.pulls_by_ground_n[axle] += root * ground_n * random();
        }
        seen.pitch_rad += pitch + root * noise.accel_m_s2 / rover.gravity_m_s2 * random();
        seen
    };
    // Covariance by differences: each of the thirteen white errors in turn, of one standard deviation.
    let mut covariance = SMatrix::<f64, CHANNELS, CHANNELS>::zeros();
    for error in 0..13 {
        let mut place = 0;
        let seen = blurred(
            &mut || {
                place += 1;
                if place == error + 1 { 1.0 } else { 0.0 }
            },
            &[0.0; 6],
            0.0,
            0.0,
        );
        let change = channels(&rover, &soil, &seen, &[0.0; 6], 0.0, 0.0) - left_over;
        covariance += change * change.transpose();
    }
    let whitening = covariance.cholesky().unwrap();

    let mut stds = [0.0; UNKNOWNS];
    stds[..7].copy_from_slice(&prior_stds());
    (stds[7], stds[8]) = (lasting.speed_scale, lasting.pitch_rad);
    for own in 0..12 {
        stds[9 + own] = if own % 6 < 3 { lasting.load_n } else { lasting.torque_nm };
    }
    let mut centre = [0.0; UNKNOWNS];
    centre[..7].copy_from_slice(&truth());

    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut errors = Vec::new();
    for _ in 0..DRAWS {
        let mut normal = || random.sample::<f64, _>(StandardNormal);
        // A belief that is off by its own standard deviation is one more measurement.
        let believed: Vec<f64> =
            (0..UNKNOWNS).map(|k| if k < 7 { centre[k] + BELIEF * stds[k] * normal() } else { 0.0 }).collect();
        let actual: Vec<f64> = (0..UNKNOWNS).map(|k| if k < 7 { centre[k] } else { stds[k] * normal() }).collect();
        let sides = [9, 15].map(|own| blurred(&mut normal, &actual[own..own + 6], actual[7], actual[8]));
        let residuals = |x: &[f64]| {
            let soil = soil_of(x);
            let mut all: Vec<f64> = (0..UNKNOWNS).map(|k| (x[k] - believed[k]) / stds[k]).collect();
            for (seen, own) in sides.iter().zip([9, 15]) {
                let found = channels(&rover, &soil, seen, &x[own..own + 6], x[7], x[8]);
                all.extend(whitening.l().solve_lower_triangular(&found).unwrap().iter());
            }
            DVector::from_vec(all)
        };
        errors.push(gauss_newton(&centre, &stds, residuals));
    }
    for (target, name) in [(1, "φ"), (2, "ln K")] {
        let scatter = (errors.iter().map(|x| (x[target] - centre[target]).powi(2)).sum::<f64>() / DRAWS as f64).sqrt();
        let expected = bound.stds()[target];
        println!("{name}: scatter {scatter} bound {expected}");
        // The scatter of DRAWS normal errors is known to 1/√(2 DRAWS).
        let tolerance = 4.0 / (2.0 * DRAWS as f64).sqrt();
        assert!((scatter / expected - 1.0).abs() < tolerance, "{name}: {scatter}, bound {expected}");
    }
    let _ = random.random::<f64>();
}

const BELIEF: f64 = 1.0;

/// The least sum of squares from `start`, by Gauss–Newton with steps that are halved until they lead down.
fn gauss_newton(start: &[f64], scales: &[f64], residuals: impl Fn(&[f64]) -> DVector<f64>) -> Vec<f64> {
    let mut x = start.to_vec();
    let mut at = residuals(&x);
    for _ in 0..15 {
        let mut jacobian = DMatrix::zeros(at.len(), x.len());
        for k in 0..x.len() {
            let step = 1e-4 * scales[k];
            let moved = |by: f64| {
                let mut moved = x.clone();
                moved[k] += by;
                residuals(&moved)
            };
            jacobian.set_column(k, &((moved(step) - moved(-step)) / (2.0 * step)));
        }
        let step = jacobian.clone().svd(true, true).solve(&at, 1e-14).unwrap();
        let mut share = 1.0;
        let next = loop {
            let to: Vec<f64> = x.iter().zip(step.iter()).map(|(x, step)| x - share * step).collect();
            let found = residuals(&to);
            if found.norm_squared() < at.norm_squared() || share < 1e-3 {
                break (to, found);
            }
            share *= 0.5;
        };
        let gain = at.norm_squared() - next.1.norm_squared();
        (x, at) = next;
        if gain < 1e-6 {
            break;
        }
    }
    x
}
