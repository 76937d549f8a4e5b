//! Scenes as the trainers want them: noise drawn, inputs normalised, targets standardised, order shuffled.

use kapvik_firmware::network::{Normalisation, PosteriorScale, TARGETS, WHEEL_INPUTS};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::example::{Example, RoverFeatures, RoverInput, RoverNormalisation, WheelInput, rover_features, targets};
use super::fifth_input::Candidate;
use super::observe::observe;
use super::scene::Scene;
use crate::prior::{self, Range};

/// A stream of random numbers for one purpose (`seed`) and one scene (`index`).
pub fn stream(seed: u64, index: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index as u64);
    random
}

/// Mean, standard deviation and range of the targets under the stated prior; intervals still empty.
pub fn prior_scale() -> PosteriorScale {
    let mut scale = PosteriorScale::ZERO;
    let ranges = [prior::COHESION_PA, prior::FRICTION_ANGLE_RAD, prior::SHEAR_MODULUS_M];
    for (k, Range { low, high, logarithmic }) in ranges.into_iter().enumerate() {
        let (low, high) = if logarithmic { (libm::log(low), libm::log(high)) } else { (low, high) };
        scale.mean[k] = (0.5 * (low + high)) as f32;
        scale.std[k] = ((high - low) / libm::sqrt(12.0)) as f32;
        scale.low[k] = low as f32;
        scale.high[k] = high as f32;
    }
    scale
}

fn standardised(scene: &Scene, scale: &PosteriorScale) -> [f32; TARGETS] {
    let truth = targets(scene);
    std::array::from_fn(|k| (truth[k] as f32 - scale.mean[k]) / scale.std[k])
}

/// What the rover network's inputs for one noisy observation of each scene are made of.
pub fn seen_by_rover(scenes: &[Scene], seed: u64) -> Vec<RoverFeatures> {
    let seen = scenes.par_iter().enumerate();
    seen.map(|(index, scene)| rover_features(&observe(scene, &mut stream(seed, index)))).collect()
}

/// The rover network's example of the scene at a place as a pass of training with that seed sees it, [`Scene::seen_anew`].
pub fn rover_example_anew(
    scenes: &[Scene],
    place: usize,
    seed: u64,
    normal: &RoverNormalisation,
) -> Example<RoverInput> {
    let scene = &scenes[place];
    let mut random = stream(seed, place);
    let seen = scene.seen_anew(|| random.random());
    let features = rover_features(&observe(&seen, &mut random));
    Example { input: normal.apply(&features), target: standardised(scene, &prior_scale()) }
}

/// Examples of the rover network from what its inputs are made of.
pub fn rover_examples(
    scenes: &[Scene],
    features: &[RoverFeatures],
    normal: &RoverNormalisation,
) -> Vec<Example<RoverInput>> {
    examples(scenes, features, |features| normal.apply(features))
}

/// The per-wheel network's inputs, in their own units, for the first wheel of each scene.
pub fn wheel_inputs(scenes: &[Scene], fifth: Candidate, seed: u64) -> Vec<WheelInput> {
    let seen = scenes.par_iter().enumerate();
    seen.map(|(place, scene)| wheel_input(scene, fifth, &mut stream(seed, place))).collect()
}

fn wheel_input(scene: &Scene, fifth: Candidate, random: &mut ChaCha8Rng) -> WheelInput {
    let query = observe(scene, random);
    query.wheel_inputs(&query.wheels[0], fifth.observe(scene, &query, 0, random))
}

/// The per-wheel network's example of the scene at a place, with the noise of that seed.
pub fn wheel_example(
    scenes: &[Scene],
    place: usize,
    fifth: Candidate,
    seed: u64,
    normal: &Normalisation<WHEEL_INPUTS>,
) -> Example<WheelInput> {
    let scene = &scenes[place];
    let input = wheel_input(scene, fifth, &mut stream(seed, place));
    Example { input: normal.apply(&input), target: standardised(scene, &prior_scale()) }
}

/// Examples of the per-wheel network from its inputs.
pub fn wheel_examples(
    scenes: &[Scene],
    inputs: &[WheelInput],
    normal: &Normalisation<WHEEL_INPUTS>,
) -> Vec<Example<WheelInput>> {
    examples(scenes, inputs, |input| normal.apply(input))
}

fn examples<F: Sync, I: Send>(
    scenes: &[Scene],
    features: &[F],
    normalised: impl Fn(&F) -> I + Sync,
) -> Vec<Example<I>> {
    let scale = prior_scale();
    let pairs = scenes.par_iter().zip(features);
    pairs
        .map(|(scene, features)| Example { input: normalised(features), target: standardised(scene, &scale) })
        .collect()
}

/// Shuffles (Fisher–Yates).
pub fn shuffle<T>(items: &mut [T], seed: u64) {
    let mut random = stream(seed, 0);
    for last in (1..items.len()).rev() {
        items.swap(last, random.random_range(0..=last as u64) as usize);
    }
}
