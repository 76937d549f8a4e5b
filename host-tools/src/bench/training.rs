//! Training time to the same validation loss, beside scikit-learn and PyTorch: same data, same network, same method (Adam,
//! mean square error), two cores.

use std::io::Write as _;
use std::process::{Command, Stdio};
use std::time::Instant;

use kapvik_firmware::network::{TARGETS, WHEEL_HIDDEN, WHEEL_INPUTS};
use serde::{Deserialize, Serialize};

use crate::error::HostError;
use crate::train::back_propagation::{Adam, mean_of};
use crate::train::dataset::{shuffle, wheel_examples, wheel_inputs};
use crate::train::example::{Example, WheelInput, normalisation};
use crate::train::fifth_input::Candidate;
use crate::train::loss::mean_square;
use crate::train::scene::{Design, scenes};
use crate::train::trainable::initial;
use crate::train::wheel_weights::WheelWeights;

const SCRIPT: &str = include_str!("training.py");
const EPOCHS: usize = 60;
const BATCH: usize = 200;
const RATE: f32 = 1e-3;

/// Validation loss over the seconds that training alone took.
#[derive(Deserialize)]
struct Run {
    name: String,
    points: Vec<(f64, f64)>,
}

#[derive(Serialize)]
struct Problem<'a> {
    hidden: usize,
    epochs: usize,
    batch: usize,
    rate: f32,
    inputs: Vec<&'a [f32; WHEEL_INPUTS]>,
    targets: Vec<&'a [f32; TARGETS]>,
    held_out_inputs: Vec<&'a [f32; WHEEL_INPUTS]>,
    held_out_targets: Vec<&'a [f32; TARGETS]>,
}

/// Trains with each, prints seconds to the loss that all of them reach.
///
/// # Errors
/// Where Python is there but the script fails.
pub fn print() -> Result<(), HostError> {
    let [training, held_out] = examples(16_000, 6_000);
    let mut runs = vec![ours(&training, &held_out)];
    match others(&training, &held_out)? {
        Some(others) => runs.extend(others),
        None => println!("Left out: scikit-learn and PyTorch (python3 with them is not installed)."),
    }
    let best = |run: &Run| run.points.iter().map(|point| point.1).fold(f64::INFINITY, f64::min);
    let goal = runs.iter().map(best).fold(f64::NEG_INFINITY, f64::max);
    let seconds = |run: &Run| run.points.iter().find(|point| point.1 <= goal).map_or(f64::NAN, |point| point.0);
    println!("Seconds of training to a validation mean square error of {goal:.5}, which all reach in {EPOCHS} epochs:");
    let reference = runs.first().map_or(f64::NAN, seconds);
    for run in &runs {
        let per_epoch = 1e3 * run.points.last().map_or(f64::NAN, |point| point.0) / EPOCHS as f64;
        let (name, taken) = (&run.name, seconds(run));
        println!(
            "  {name:14} {taken:8.3} s   {:6.1} x   {per_epoch:7.1} ms/epoch   best {:.5}",
            taken / reference,
            best(run)
        );
    }
    Ok(())
}

/// Examples to learn from and to watch, both on the scale of the first.
fn examples(training: usize, held_out: usize) -> [Vec<Example<WheelInput>>; 2] {
    let sets = [(training, 1), (held_out, 2)].map(|(count, seed)| {
        let scenes = scenes(Design::Training, count, seed);
        let inputs = wheel_inputs(&scenes, Candidate::None, u64::from(seed));
        (scenes, inputs)
    });
    let normal = normalisation(sets[0].1.iter());
    sets.map(|(scenes, inputs)| wheel_examples(&scenes, &inputs, &normal))
}

fn ours(training: &[Example<WheelInput>], held_out: &[Example<WheelInput>]) -> Run {
    let mut examples = training.to_vec();
    let mut network: WheelWeights = initial(1);
    let mut adam = Adam::with_loss(&network, mean_square);
    let (mut spent, mut points) = (0.0, Vec::new());
    for epoch in 0..EPOCHS {
        let begin = Instant::now();
        shuffle(&mut examples, epoch as u64);
        examples.chunks(BATCH).for_each(|batch| {
            adam.step(&mut network, batch, RATE);
        });
        spent += begin.elapsed().as_secs_f64();
        points.push((spent, mean_of(&network, held_out, mean_square)));
    }
    Run { name: "kapvik".into(), points }
}

/// The same by Python; none where Python or its packages are missing.
fn others(training: &[Example<WheelInput>], held_out: &[Example<WheelInput>]) -> Result<Option<Vec<Run>>, HostError> {
    let failed = |error: &dyn std::fmt::Display| HostError::Failed(format!("the Python comparison failed: {error}"));
    let problem = Problem {
        hidden: WHEEL_HIDDEN,
        epochs: EPOCHS,
        batch: BATCH,
        rate: RATE,
        inputs: training.iter().map(|example| &example.input).collect(),
        targets: training.iter().map(|example| &example.target).collect(),
        held_out_inputs: held_out.iter().map(|example| &example.input).collect(),
        held_out_targets: held_out.iter().map(|example| &example.target).collect(),
    };
    let problem = serde_json::to_vec(&problem).map_err(|error| failed(&error))?;
    let python = Command::new("python3").args(["-c", SCRIPT]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let Ok(mut python) = python else { return Ok(None) };
    if let Some(mut input) = python.stdin.take() {
        // A script that stops early, for want of its packages, closes the pipe; its output says so.
        let _ = input.write_all(&problem);
    }
    let output = python.wait_with_output().map_err(|error| failed(&error))?;
    if !output.status.success() {
        return Err(failed(&output.status));
    }
    let runs: Vec<Run> = serde_json::from_slice(&output.stdout).map_err(|error| failed(&error))?;
    Ok((!runs.is_empty()).then_some(runs))
}
