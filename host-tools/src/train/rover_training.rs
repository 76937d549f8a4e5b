//! Training of the rover network.

use std::time::Instant;

use indicatif::ProgressBar;
use kapvik_firmware::network::{GOLDEN_PAIRS, PosteriorScale, ROVER_WHEELS, RoverGolden, RoverNetwork, RoverTable};

use super::back_propagation::{Adam, mean_loss};
use super::calibration::calibrate;
use super::curve::Curve;
use super::dataset::{prior_scale, rover_examples, shuffle, stream};
use super::example::{RoverInput, RoverNormalisation, rover_features};
use super::observe::observe;
use super::plan::{Plan, Purpose};
use super::scene::Scene;
use super::trainable::{GRADIENT, initial};

/// Trains the rover network on `scenes`, watches and calibrates it on `held_out`.
pub fn train_rover(plan: &Plan, scenes: &[Scene], held_out: &[Scene], progress: &ProgressBar) -> (RoverTable, Curve) {
    let raw = raw_inputs(held_out, plan);
    let normal = RoverNormalisation::new(&raw);
    let watched = rover_examples(held_out, &normal, plan.stream(Purpose::HeldOutNoise));
    let mut network: RoverNetwork = initial(plan.stream(Purpose::Weights));
    let mut curve = Curve::new("rover network");
    let begin = Instant::now();
    let mut adam = Adam::new(&network);
    progress.set_length(plan.rover_epochs as u64);
    for epoch in 0..plan.rover_epochs {
        let mut examples = rover_examples(scenes, &normal, plan.stream(Purpose::TrainingNoise) + epoch as u64);
        shuffle(&mut examples, plan.stream(Purpose::Order) + epoch as u64);
        adam.pass(&mut network, &examples, epoch, plan.rover_epochs);
        curve.points.push((begin.elapsed().as_secs_f64(), mean_loss(&network, &watched)));
        progress.set_message(format!("held-out loss {:.4}", curve.last()));
        progress.inc(1);
    }
    let mut posterior = prior_scale();
    calibrate(&network, &watched, &mut posterior);
    (table(network, normal, posterior, &raw), curve)
}

fn raw_inputs(scenes: &[Scene], plan: &Plan) -> Vec<RoverInput> {
    let seed = plan.stream(Purpose::HeldOutNoise);
    let seen = scenes.iter().enumerate().map(|(index, scene)| observe(scene, &mut stream(seed, index)));
    seen.map(|query| rover_features(&query)).collect()
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
