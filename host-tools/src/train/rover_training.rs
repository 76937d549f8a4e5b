//! Training of the rover network.

use indicatif::ProgressBar;
use kapvik_firmware::network::{GOLDEN_PAIRS, PosteriorScale, ROVER_WHEELS, RoverGolden, RoverNetwork, RoverTable};

use crate::error::HostError;

use super::calibration::calibrated;
use super::curve::Curve;
use super::dataset::{rover_example_anew, rover_examples, seen_by_rover};
use super::epochs::train_by_epochs;
use super::example::{RoverFeatures, RoverNormalisation};
use super::plan::{Plan, Purpose};
use super::rover_weights::RoverWeights;
use super::scene::{Design, Scene, scenes_in};
use super::world::World;
use crate::prior::{MANOEUVRE_SHARE, PATCHY_SHARE};

/// The scenes that the rover network is trained on: a part of all kinds, the rest of the manoeuvre that makes a soil observable;
/// of either a share on patchy ground.
///
/// # Errors
/// Where no rover could drive with the effects of the world.
pub fn rover_scenes(plan: &Plan, world: &World) -> Result<Vec<Scene>, HostError> {
    let patchy = world.with_patches(PATCHY_SHARE);
    let of_manoeuvre = (MANOEUVRE_SHARE * plan.scenes as f64) as usize;
    let mut scenes = scenes_in(&patchy, Design::Training, plan.scenes - of_manoeuvre, plan.seed)?;
    scenes.extend(scenes_in(&patchy, Design::Manoeuvre, of_manoeuvre, plan.seed)?);
    Ok(scenes)
}

/// Trains the rover network on `scenes`, watches and calibrates it on `held_out`.
pub fn train_rover(plan: &Plan, scenes: &[Scene], held_out: &[Scene], progress: &ProgressBar) -> (RoverTable, Curve) {
    let raw = seen_by_rover(held_out, plan.stream(Purpose::HeldOutNoise));
    let normal = RoverNormalisation::new(&raw);
    let watched = rover_examples(held_out, &raw, &normal);
    let curve = Curve::new("rover network");
    let (weights, curve): (RoverWeights, Curve) =
        train_by_epochs(plan, plan.rover, &watched, curve, progress, scenes.len(), |seed| {
            let normal = &normal;
            move |place| rover_example_anew(scenes, place, seed, normal)
        });
    let network = weights.rounded();
    let posterior = calibrated(&watched, |input| network.run(input));
    (table(network, normal, posterior, &raw), curve)
}

fn table(
    network: RoverNetwork,
    normal: RoverNormalisation,
    posterior: PosteriorScale,
    raw: &[RoverFeatures],
) -> RoverTable {
    let RoverNormalisation { context, wheel } = normal;
    let golden = [const { RoverGolden::ZERO }; GOLDEN_PAIRS];
    let mut table = RoverTable { context, wheel, network, posterior, golden };
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
