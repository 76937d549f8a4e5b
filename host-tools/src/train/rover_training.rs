//! Training of the rover network.

use indicatif::ProgressBar;
use kapvik_firmware::network::{GOLDEN_PAIRS, PosteriorScale, ROVER_WHEELS, RoverGolden, RoverNetwork, RoverTable};
use rayon::prelude::*;

use super::calibration::calibrate;
use super::curve::Curve;
use super::dataset::{prior_scale, rover_examples, rover_inputs, rover_inputs_anew};
use super::epochs::train_by_epochs;
use super::example::{Example, RoverInput, RoverNormalisation};
use super::plan::{Plan, Purpose};
use super::rover_weights::RoverWeights;
use super::scene::Scene;
use super::trainable::GRADIENT;

/// Trains the rover network on `scenes`, watches and calibrates it on `held_out`.
pub fn train_rover(plan: &Plan, scenes: &[Scene], held_out: &[Scene], progress: &ProgressBar) -> (RoverTable, Curve) {
    let raw = rover_inputs(held_out, plan.stream(Purpose::HeldOutNoise));
    let normal = RoverNormalisation::new(&raw);
    let watched = rover_examples(held_out, &raw, &normal);
    let curve = Curve::new("rover network");
    let (weights, curve): (RoverWeights, Curve) =
        train_by_epochs(plan, plan.rover, &watched, curve, progress, |seed| {
            rover_examples(scenes, &rover_inputs_anew(scenes, seed), &normal)
        });
    let mut posterior = prior_scale();
    let network = weights.rounded();
    let flown: Vec<_> = watched
        .par_iter()
        .map(|Example { input, .. }| network.run(&input.context, input.wheels.iter().copied(), GRADIENT))
        .collect();
    calibrate(&flown, &watched, &mut posterior);
    (table(network, normal, posterior, &raw), curve)
}

fn table(
    network: RoverNetwork,
    normal: RoverNormalisation,
    posterior: PosteriorScale,
    raw: &[RoverInput],
) -> RoverTable {
    let RoverNormalisation { context, wheel } = normal;
    let golden = [const { RoverGolden::ZERO }; GOLDEN_PAIRS];
    let mut table = RoverTable { gradient: GRADIENT, context, wheel, network, posterior, golden };
    let pairs = raw.iter().take(GOLDEN_PAIRS).map(|input| {
        let mut pair = RoverGolden::ZERO;
        pair.count = input.wheels.len().min(ROVER_WHEELS) as f32;
        pair.context = input.context;
        pair.wheels.iter_mut().zip(&input.wheels).for_each(|(place, features)| *place = *features);
        pair.output = table.outputs(&input.context, input.wheels.iter().copied());
        pair
    });
    let pairs: Vec<RoverGolden> = pairs.collect();
    table.golden.iter_mut().zip(pairs).for_each(|(place, pair)| *place = pair);
    table
}
