//! Training of the per-wheel network.

use indicatif::ProgressBar;
use kapvik_firmware::network::{GOLDEN_PAIRS, WheelGolden, WheelTable};

use super::calibration::calibrated;
use super::curve::Curve;
use super::dataset::{wheel_example, wheel_examples, wheel_inputs};
use super::epochs::train_by_epochs;
use super::example::normalisation;
use super::fifth_input::Candidate;
use super::plan::{Plan, Purpose};
use super::scene::Scene;
use super::wheel_weights::WheelWeights;

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
    let curve = Curve::new("per-wheel network");
    let (weights, curve): (WheelWeights, Curve) =
        train_by_epochs(plan, plan.wheel, &watched, curve, progress, scenes.len(), |seed| {
            let normal = &normal;
            move |place| wheel_example(scenes, place, fifth, seed, normal)
        });
    let network = weights.rounded();
    let posterior = calibrated(&watched, |input| network.run(input));
    let golden = [const { WheelGolden::ZERO }; GOLDEN_PAIRS];
    let mut table = WheelTable { normalisation: normal, network, posterior, golden };
    let pairs = raw.iter().take(GOLDEN_PAIRS);
    let pairs: Vec<WheelGolden> =
        pairs.map(|input| WheelGolden { input: *input, output: table.outputs(input) }).collect();
    table.golden.iter_mut().zip(pairs).for_each(|(place, pair)| *place = pair);
    (table, curve)
}
