//! Training of the per-wheel network.

use std::time::Instant;

use indicatif::ProgressBar;
use kapvik_firmware::network::{GOLDEN_PAIRS, WheelGolden, WheelNetwork, WheelTable};

use super::back_propagation::{Adam, mean_loss};
use super::calibration::calibrate;
use super::curve::Curve;
use super::dataset::{prior_scale, shuffle, wheel_examples, wheel_inputs};
use super::example::normalisation;
use super::fifth_input::Candidate;
use super::plan::{Plan, Purpose};
use super::scene::Scene;
use super::trainable::{GRADIENT, initial};

/// Trains the per-wheel network on the first wheel of each scene, watches and calibrates it on `held_out`.
pub fn train_wheel(
    plan: &Plan,
    fifth: Candidate,
    scenes: &[Scene],
    held_out: &[Scene],
    progress: &ProgressBar,
) -> (WheelTable, Curve) {
    let raw = wheel_inputs(held_out, fifth, plan.stream(Purpose::HeldOutNoise));
    let normal = normalisation(raw.iter());
    let watched = wheel_examples(held_out, &raw, &normal);
    let mut network: WheelNetwork = initial(plan.stream(Purpose::Weights));
    let mut curve = Curve::new("per-wheel network");
    let begin = Instant::now();
    let mut adam = Adam::new(&network);
    progress.set_length(plan.wheel_epochs as u64);
    for epoch in 0..plan.wheel_epochs {
        let inputs = wheel_inputs(scenes, fifth, plan.stream(Purpose::TrainingNoise) + epoch as u64);
        let mut examples = wheel_examples(scenes, &inputs, &normal);
        shuffle(&mut examples, plan.stream(Purpose::Order) + epoch as u64);
        adam.pass(&mut network, &examples, epoch, plan.wheel_epochs);
        curve.points.push((begin.elapsed().as_secs_f64(), mean_loss(&network, &watched)));
        progress.set_message(format!("held-out loss {:.4}", curve.last()));
        progress.inc(1);
    }
    let mut posterior = prior_scale();
    calibrate(&network, &watched, &mut posterior);
    let golden = [const { WheelGolden::ZERO }; GOLDEN_PAIRS];
    let mut table = WheelTable { gradient: GRADIENT, normalisation: normal, network, posterior, golden };
    let pairs = raw.iter().take(GOLDEN_PAIRS);
    let pairs: Vec<WheelGolden> =
        pairs.map(|input| WheelGolden { input: *input, output: table.outputs(input) }).collect();
    table.golden.iter_mut().zip(pairs).for_each(|(place, pair)| *place = pair);
    (table, curve)
}
