//! Starting, stopping, standing, turning back, a wheel in the air: what the estimators say must be what is defined.

mod driven;
mod recorded;

use driven::driven;
use kapvik_firmware::estimator::WheelActivity;
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::Rover;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::simulate::{Options, Scenario};
use rayon::prelude::*;
use recorded::recorded;

fn drive(scenario: Scenario, seed: u64) -> Vec<(FrameEstimate, Truth)> {
    drive_with(scenario, seed, &Options::default())
}

fn drive_with(scenario: Scenario, seed: u64, options: &Options) -> Vec<(FrameEstimate, Truth)> {
    let rover = Rover::assumed();
    driven(&rover, recorded(scenario, seed, &rover, options).iter().copied()).0
}

/// A wheel that has stood for a second has no slip, and one that has moved for a second has one, in either direction.
#[test]
fn a_wheel_that_stands_has_no_slip_and_one_that_turns_back_has() {
    for seed in 1000..1004 {
        let frames = drive(Scenario::StartStop, seed);
        let (mut standing, mut back) = (0, 0);
        for window in frames.windows(11) {
            let Some((estimate, _)) = window.last() else { continue };
            let moved = |truth: &Truth| truth.wheels.left.front.slip.is_some();
            let slip = estimate.wheels.left.front.slip;
            if window.iter().all(|(_, truth)| !moved(truth)) {
                assert!(slip.is_none(), "seed {seed}, {} µs", estimate.time_us);
                standing += 1;
            }
            let [(_, before), .., (_, after)] = window else { continue };
            if window.iter().all(|(_, truth)| moved(truth)) && after.x_m < before.x_m - 0.01 {
                assert!(slip.is_some(), "seed {seed}, {} µs", estimate.time_us);
                back += 1;
            }
        }
        assert!(standing > 20 && back > 20, "seed {seed}: {standing} standing, {back} backing up");
    }
}

/// In the first frame in which wheels turn the filter knows only that they stood; their encoders say better, however seldom they speak.
#[test]
fn a_wheel_that_starts_is_not_taken_for_blocked() {
    let drives =
        (1000..1004).into_par_iter().flat_map_iter(|seed| [1.0, 2.0, 5.0, 10.0].map(|rate_hz| (seed, rate_hz)));
    drives.for_each(|(seed, rate_hz)| {
        let options = Options { rate_hz: Some(rate_hz), ..Options::default() };
        let mut starts = 0;
        for pair in drive_with(Scenario::StartStop, seed, &options).windows(2) {
            let [(_, before), (estimate, now)] = pair else { continue };
            let wheels = before.wheels.iter_wheels().zip(now.wheels.iter_wheels()).zip(estimate.wheels.iter_wheels());
            for ((before, now), said) in wheels {
                let has_started = before.slip.is_none() && now.slip.is_some_and(|slip| slip > -0.5);
                starts += u32::from(has_started);
                let is_blocked = has_started && said.activity == WheelActivity::Blocked;
                assert!(!is_blocked, "seed {seed}, {rate_hz} frames a second, {} µs", estimate.time_us);
            }
        }
        assert!(starts >= 6, "seed {seed}, {rate_hz} frames a second: {starts} starts");
    });
}

#[test]
fn a_wheel_in_the_air_is_told_and_bears_nothing() {
    (1000..1004).into_par_iter().for_each(|seed| {
        let frames = drive(Scenario::WheelLift, seed);
        let mut in_the_air = 0;
        for window in frames.windows(6) {
            let Some((estimate, _)) = window.last() else { continue };
            let loads = |truth: &Truth| truth.wheels.map_wheels(|wheel| wheel.normal_load_n);
            for (place, wheel) in estimate.wheels.iter_wheels().enumerate() {
                let lifted =
                    window.iter().all(|(_, truth)| loads(truth).iter_wheels().nth(place).is_some_and(|n| *n < 0.5));
                if lifted {
                    assert_eq!(wheel.activity, WheelActivity::Lifted, "seed {seed}, {} µs", estimate.time_us);
                    assert_eq!((wheel.normal_load_n.value, wheel.drawbar_pull_n.value), (0.0, 0.0));
                    in_the_air += 1;
                }
            }
        }
        assert!(in_the_air > 50, "seed {seed}: {in_the_air}");
    });
}

/// Pulls and torques of wheels that roll back are those of their mirror images: the soil is the one that it was.
#[test]
fn a_rover_that_turns_back_stays_on_its_soil() {
    for seed in 1000..1004 {
        let frames = drive(Scenario::StartStop, seed);
        let back = frames.windows(2).filter(|pair| pair[1].1.x_m < pair[0].1.x_m - 1.0e-4).count();
        assert!(back > 20, "seed {seed}: {back} frames back");
        let (last, truth) = frames.last().expect("frames");
        let soil = last.soil.as_ref().expect("a soil");
        let (estimate, truth) = (soil.estimate.friction_angle_rad, truth.soil.friction_angle_rad);
        println!("seed {seed}: {:.3} ± {:.3} rad, in truth {truth:.3}", estimate.value, estimate.std);
        assert_eq!(soil.changes, 0, "seed {seed}");
        assert!((f64::from(estimate.value) - truth).abs() < 3.0 * f64::from(estimate.std), "seed {seed}");
    }
}

/// As wheels start, load shifts to the rear of a bogie, which turns, and its hubs go forward by that. What they are then said to slip, from
/// the second frame on in which they do, is as sure as is said: by the terrain alone they would slip by a sixth of the rims' speed more.
#[test]
fn wheels_of_a_bogie_that_start_slip_as_surely_as_they_say() {
    const STARTING: std::ops::Range<usize> = 1..8;
    let (mut starting, mut within, mut squares) = (0_u32, 0_u32, 0.0);
    let drives: Vec<_> = (1000..1020).into_par_iter().map(|seed| drive(Scenario::StartStop, seed)).collect();
    for frames in drives {
        let mut rolling = [0; 4];
        for (estimate, truth) in frames {
            let bogies = estimate.wheels.as_ref().zip(truth.wheels.as_ref());
            let bogies = [bogies.left, bogies.right]
                .map(|(said, true_one)| [(&said.middle, &true_one.middle), (&said.rear, &true_one.rear)]);
            for (frames, (said, true_one)) in rolling.iter_mut().zip(bogies.into_iter().flatten()) {
                *frames = if true_one.slip.is_some() { *frames + 1 } else { 0 };
                let (Some(slip), Some(said)) = (true_one.slip, said.slip) else { continue };
                if STARTING.contains(frames) {
                    let off = f64::from(said.value) - slip;
                    starting += 1;
                    within += u32::from(off.abs() < 2.0 * f64::from(said.std));
                    squares += off * off;
                }
            }
        }
    }
    let (rms, share) = ((squares / f64::from(starting)).sqrt(), f64::from(within) / f64::from(starting));
    println!("{starting} frames: slips err by {rms:.3}, {:.1} % within 2 σ", 100.0 * share);
    assert!(starting > 1000 && rms < 0.15 && share > 0.9, "{starting} frames: {rms}, {share}");
}
