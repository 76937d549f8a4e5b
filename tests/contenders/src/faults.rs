//! What can go wrong, and how a filter comes through.

use kapvik_firmware::filter::trial::{Scales, Trial};
use semihosting::println;

use crate::contender::Answer;

/// Steps before a fault, for the filter to settle.
const SETTLING: usize = 100;
/// Steps that a fault lasts where it lasts.
const LASTING: usize = 20;
/// Good steps after the fault.
const AFTER: usize = 300;
/// Those of them, the last, over which the error is averaged.
const AVERAGED: usize = 100;
/// Steps of the drift.
const DRIFTING: usize = 1_000_000;

/// A fault of one run.
#[derive(Clone, Copy)]
enum Fault {
    /// None: what the others are compared with.
    Nothing,
    /// One measurement of one step becomes this.
    First(f32),
    /// No measurement at all for a while.
    Dropped,
}

/// How a filter came through.
struct Outcome {
    /// Steps of a finite mean that did not fail.
    good: usize,
    /// Of so many.
    steps: usize,
    /// Whether the filter said something while it lasted.
    told: bool,
    /// The greatest error after the fault and the root mean square at the end, in standard deviations of the noise.
    peak: f32,
    end: f32,
}

/// Every fault on filters of 6 states and 6 measurements.
pub fn all<C: FnMut(Option<&[f32; 6]>) -> Answer<6>>(name: &str, start: impl Fn(&Scales) -> C) {
    let scales = Scales::NOMINAL;
    let faults = [
        ("none", Fault::Nothing),
        ("nan", Fault::First(f32::NAN)),
        ("infinity", Fault::First(f32::INFINITY)),
        ("outlier_1e6", Fault::First(1e6)),
        ("dropped", Fault::Dropped),
    ];
    for (fault_name, fault) in faults {
        print(name, fault_name, &faulty_run(&mut start(&scales), fault));
    }
}

/// A start 10¹⁰ times as uncertain, in variance, as the measurements.
pub fn stiff<const N: usize, const M: usize, C: FnMut(Option<&[f32; M]>) -> Answer<N>>(
    name: &str,
    start: impl Fn(&Scales) -> C,
) {
    let outcome = plain_run(&mut start(&Scales::STIFF), Scales::STIFF, AFTER);
    let fault = if N == 6 { "stiff_6_6" } else { "stiff_12_18" };
    print(name, fault, &outcome);
}

/// A long drift; the third of three states is seen by no measurement.
pub fn drift<C: FnMut(Option<&[f32; 2]>) -> Answer<3>>(name: &str, start: impl Fn(&Scales) -> C) {
    print(name, "drift", &plain_run(&mut start(&Scales::NOMINAL), Scales::NOMINAL, DRIFTING));
}

fn faulty_run(step: &mut impl FnMut(Option<&[f32; 6]>) -> Answer<6>, fault: Fault) -> Outcome {
    let scales = Scales::NOMINAL;
    let mut trial = Trial::<6, 6>::new(2, scales);
    for _ in 0..SETTLING {
        step(Some(&trial.measure()));
    }
    let mut told = false;
    let lasting = if matches!(fault, Fault::Dropped) { LASTING } else { 1 };
    for _ in 0..lasting {
        let mut measured = trial.measure();
        if let Fault::First(value) = fault {
            measured[0] = value;
        }
        let dropped = matches!(fault, Fault::Dropped);
        told |= step((!dropped).then_some(&measured)).told;
    }
    Outcome { told, ..watch(step, &mut trial, &scales, AFTER) }
}

fn plain_run<const N: usize, const M: usize>(
    step: &mut impl FnMut(Option<&[f32; M]>) -> Answer<N>,
    scales: Scales,
    steps: usize,
) -> Outcome {
    watch(step, &mut Trial::<N, M>::new(2, scales), &scales, steps)
}

/// Steps with good measurements. The errors are of states that a measurement sees.
fn watch<const N: usize, const M: usize>(
    step: &mut impl FnMut(Option<&[f32; M]>) -> Answer<N>,
    trial: &mut Trial<N, M>,
    scales: &Scales,
    steps: usize,
) -> Outcome {
    let mut outcome = Outcome { good: 0, steps, told: false, peak: 0.0, end: 0.0 };
    let (mut squares, mut count) = (0.0, 0.0);
    for index in 0..steps {
        let answer = step(Some(&trial.measure()));
        let finite = answer.mean.iter().all(|mean| mean.is_finite());
        outcome.good += usize::from(finite && !answer.failed);
        for (mean, truth) in answer.mean.iter().zip(trial.truth()).take(M) {
            let error = (mean - truth) / scales.noise_std;
            outcome.peak = if error.abs() <= outcome.peak { outcome.peak } else { error.abs() };
            if index + AVERAGED >= steps {
                squares += error * error;
                count += 1.0;
            }
        }
    }
    outcome.end = kapvik_firmware::math::sqrt(squares / count);
    outcome
}

fn print(name: &str, fault: &str, outcome: &Outcome) {
    let Outcome { good, steps, told, peak, end } = outcome;
    println!("survival {name} {fault} {good} {steps} {told} {peak} {end}");
}
