//! Evaluations of equations 1–11 per second, at a given sinkage, on one core in double precision.
//!
//! Beside the library stand a composite Simpson loop as one would write it, with as many intervals as the library's
//! stated accuracy takes, and SciPy's adaptive `quad`. All three evaluate the same cases in the same run.

use std::hint::black_box;
use std::io::Write;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use kapvik_firmware::terramechanics::{WheelForces, sinkage_for_load, wheel_forces};

use crate::prior::{KAPVIK_LOAD_N, KAPVIK_WHEEL};
use crate::soil_catalogue::TABLE_1;

const SLIPS: [f64; 6] = [0.05, 0.10, 0.20, 0.30, 0.40, 0.60];
const SINKAGE_M: f64 = 0.018;

/// What the library states: error in parts of W (of rW for the torque).
const ACCURACY: f64 = 1e-7;

/// Intervals of the loop that all results are judged by: its own error is then of the order of 1e-13.
const REFERENCE_INTERVALS: u32 = 1 << 18;

/// The time that each method is given, split into repeats of which the fastest counts.
const TIME: Duration = Duration::from_secs(2);
const REPEATS: u32 = 20;

/// What was measured of one method.
struct Measured {
    method: String,
    error: f64,
    seconds: f64,
}

/// Measures all methods and prints them as a table.
pub fn print() {
    let exact = SLIPS.map(|slip| simpson(slip, REFERENCE_INTERVALS));
    let ours = SLIPS.map(library);
    let intervals = simpson_intervals(&exact);
    let mut rows = vec![
        Measured {
            method: "this library".into(),
            error: greatest_error(&exact, &ours),
            seconds: seconds_per_call(library),
        },
        Measured {
            method: format!("Simpson loop, 2 × {intervals} intervals"),
            error: greatest_error(&exact, &SLIPS.map(|slip| simpson(slip, intervals))),
            seconds: seconds_per_call(|slip| simpson(slip, intervals)),
        },
    ];
    let scipy = scipy(&exact);
    println!(
        "Forward model at a given sinkage: Kapvik-size wheel, Table 1 sand, {SINKAGE_M} m, {} slips; one core, f64",
        SLIPS.len()
    );
    println!("Simpson has the fewest intervals that meet the accuracy stated for the library, {ACCURACY:e} of W.\n");
    println!("{:<36} {:>12} {:>12} {:>14} {:>9}", "", "error", "µs each", "per second", "ratio");
    let note = scipy.as_ref().err().cloned();
    rows.extend(scipy);
    let fastest = rows.first().map_or(1.0, |row| row.seconds);
    for Measured { method, error, seconds } in &rows {
        let (micros, rate, ratio) = (1e6 * seconds, seconds.recip(), seconds / fastest);
        println!("{method:<36} {error:>12.1e} {micros:>12.2} {rate:>14.0} {ratio:>9.1}");
    }
    if let Some(reason) = note {
        println!("SciPy's quad: left out, {reason}");
    }
    let solve = seconds_per_call(|slip| sinkage_for_load(&KAPVIK_WHEEL, &TABLE_1, slip, KAPVIK_LOAD_N));
    println!(
        "\nSinkage for a load of {KAPVIK_LOAD_N} N: {:.2} µs, the time of {:.1} evaluations",
        1e6 * solve,
        solve / fastest
    );
    println!(
        "error: the greatest against the loop with {REFERENCE_INTERVALS} intervals; of W for DP and W, of rW for T"
    );
}

/// Equations 1–11 by the library; a refusal shows as an error that is not a number.
fn library(slip: f64) -> WheelForces<f64> {
    let refused = WheelForces { drawbar_pull_n: f64::NAN, load_n: f64::NAN, torque_nm: f64::NAN };
    wheel_forces(&KAPVIK_WHEEL, &TABLE_1, slip, SINKAGE_M).unwrap_or(refused)
}

/// Equations 1–11 by Simpson's rule on each side of the peak stress.
fn simpson(slip: f64, intervals: u32) -> WheelForces<f64> {
    let r = KAPVIK_WHEEL.radius_m;
    let entry = (1.0 - SINKAGE_M / r).acos();
    let exit = -(1.0 - TABLE_1.rebound_ratio * SINKAGE_M / r).acos();
    let peak = (TABLE_1.peak_stress_c1 + TABLE_1.peak_stress_c2 * slip) * entry;
    let k = TABLE_1.stiffness(KAPVIK_WHEEL.width_m) * r.powf(TABLE_1.sinkage_exponent);
    let (sin_entry, cos_entry, tan_phi) = (entry.sin(), entry.cos(), TABLE_1.friction_angle_rad.tan());
    let mut sum = [0.0; 3];
    for (from, to) in [(exit, peak), (peak, entry)] {
        let step = (to - from) / f64::from(intervals);
        for index in 0..=intervals {
            let theta = from + f64::from(index) * step;
            let front = if theta < peak { entry - (theta - exit) / (peak - exit) * (entry - peak) } else { theta };
            let sigma = k * (front.cos() - cos_entry).max(0.0).powf(TABLE_1.sinkage_exponent);
            let j = r * ((entry - theta) - (1.0 - slip) * (sin_entry - theta.sin()));
            let strength = TABLE_1.cohesion_pa + sigma * tan_phi;
            let tau = strength * (1.0 - (-j / TABLE_1.shear_modulus_m).exp());
            let weight =
                step / 3.0 * if index == 0 || index == intervals { 1.0 } else { 2.0 + 2.0 * f64::from(index % 2) };
            sum[0] += weight * (tau * theta.cos() - sigma * theta.sin());
            sum[1] += weight * (sigma * theta.cos() + tau * theta.sin());
            sum[2] += weight * tau;
        }
    }
    let area = r * KAPVIK_WHEEL.width_m;
    WheelForces { drawbar_pull_n: area * sum[0], load_n: area * sum[1], torque_nm: area * r * sum[2] }
}

/// The fewest intervals (to one in fifty) whose error is within [`ACCURACY`].
fn simpson_intervals(exact: &[WheelForces<f64>; SLIPS.len()]) -> u32 {
    const MOST: u32 = 1 << 20;
    let mut intervals = 2;
    while intervals < MOST && greatest_error(exact, &SLIPS.map(|slip| simpson(slip, intervals))) > ACCURACY {
        intervals += 2 * (intervals / 100).max(1);
    }
    intervals
}

fn greatest_error(exact: &[WheelForces<f64>], found: &[WheelForces<f64>]) -> f64 {
    let error = |(exact, found): (&WheelForces<f64>, &WheelForces<f64>)| {
        let pull = (found.drawbar_pull_n - exact.drawbar_pull_n).abs();
        let load = (found.load_n - exact.load_n).abs();
        let torque = (found.torque_nm - exact.torque_nm).abs() / KAPVIK_WHEEL.radius_m;
        pull.max(load).max(torque) / exact.load_n
    };
    exact.iter().zip(found).map(error).fold(0.0, worse)
}

/// The greater of two errors, and what is no number before any number.
fn worse(greatest: f64, error: f64) -> f64 {
    if greatest.is_nan() || error <= greatest { greatest } else { error }
}

/// The fastest of several repeats, per call.
fn seconds_per_call<T>(evaluate: impl Fn(f64) -> T) -> f64 {
    let share = TIME / REPEATS;
    let repeat = |_| {
        let (start, mut evaluations) = (Instant::now(), 0_u32);
        while start.elapsed() < share {
            for _ in 0..20 {
                for slip in SLIPS {
                    black_box(evaluate(black_box(slip)));
                }
            }
            evaluations += 20 * SLIPS.len() as u32;
        }
        start.elapsed().as_secs_f64() / f64::from(evaluations)
    };
    (0..REPEATS).map(repeat).fold(f64::INFINITY, f64::min)
}

/// The same cases by SciPy's `quad`, or why it was left out.
fn scipy(exact: &[WheelForces<f64>]) -> Result<Measured, String> {
    let soil = [
        TABLE_1.sinkage_exponent,
        TABLE_1.stiffness(KAPVIK_WHEEL.width_m),
        TABLE_1.cohesion_pa,
        TABLE_1.friction_angle_rad,
        TABLE_1.shear_modulus_m,
        TABLE_1.peak_stress_c1,
        TABLE_1.peak_stress_c2,
        TABLE_1.rebound_ratio,
    ];
    let numbers = [KAPVIK_WHEEL.radius_m, KAPVIK_WHEEL.width_m, SINKAGE_M].into_iter().chain(soil).chain(SLIPS);
    let mut python = Command::new("python3")
        .arg("-")
        .args(numbers.map(|number| format!("{number:?}")))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|error| format!("python3 does not start: {error}"))?;
    let script = include_str!("forward_scipy.py");
    if let Some(mut stdin) = python.stdin.take() {
        stdin.write_all(script.as_bytes()).map_err(|error| format!("python3 takes no script: {error}"))?;
    }
    let output = python.wait_with_output().map_err(|error| format!("python3: {error}"))?;
    if !output.status.success() {
        return Err("python3 has no scipy".into());
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let (Some(seconds), results) = (numbers.first(), numbers.get(1..).unwrap_or(&[])) else {
        return Err("its script printed nothing".into());
    };
    let found: Vec<WheelForces<f64>> = results
        .chunks_exact(3)
        .map(|forces| WheelForces { drawbar_pull_n: forces[0], load_n: forces[1], torque_nm: forces[2] })
        .collect();
    if found.len() != exact.len() {
        return Err("its script printed too little".into());
    }
    Ok(Measured { method: "SciPy quad".into(), error: greatest_error(exact, &found), seconds: *seconds })
}
