//! Networks that are trained for one world and another, and scored on the same simulated rovers.

use kapvik_firmware::network::{RoverTable, WheelTable};

use crate::error::HostError;
use crate::progress::with_progress;
use crate::train::fifth_input::Candidate;
use crate::train::plan::Plan;
use crate::train::rover_training::{rover_scenes, train_rover};
use crate::train::scene::{Design, Scene, scenes_in};
use crate::train::score::{Score, score_rover};
use crate::train::wheel_training::train_wheel;
use crate::train::world::World;

/// Networks that were trained for one world.
pub struct Trained {
    /// The rover network.
    pub rover: RoverTable,
    /// Its held-out loss, nats.
    pub loss: f64,
    /// The per-wheel network, where it was wanted, with its held-out loss.
    pub wheel: Option<(WheelTable, f64)>,
}

/// Trains the rover network for a world, and where it is to fly the per-wheel network as well.
///
/// # Errors
/// Where no rover could drive with the effects of the world.
pub fn train(world: &World, plan: &Plan, with_wheel: bool) -> Result<Trained, HostError> {
    let drawn = |count, seed| scenes_in(world, Design::Training, count, seed);
    let held_out = with_progress("held-out scenes", |_| drawn(plan.held_out, !plan.seed))?;
    let per_wheel = || -> Result<(WheelTable, f64), HostError> {
        let training = with_progress("scenes", |_| drawn(plan.scenes, plan.seed))?;
        let (table, curve) =
            with_progress("per-wheel network", |bar| train_wheel(plan, Candidate::SHIPPED, &training, &held_out, bar));
        Ok((table, curve.last()))
    };
    let wheel = with_wheel.then(per_wheel).transpose()?;
    let training = with_progress("scenes", |_| rover_scenes(plan, world))?;
    let (rover, curve) = with_progress("rover network", |bar| train_rover(plan, &training, &held_out, bar));
    Ok(Trained { rover, loss: curve.last(), wheel })
}

/// Simulated six-wheel rovers that no network was trained on, of the kinds that are reported.
pub struct Rovers {
    kinds: Vec<(&'static str, Vec<Scene>)>,
    seed: u32,
}

impl Rovers {
    const KINDS: [(&'static str, Design); 3] = [
        ("one instant", Design::Kapvik { instants: 1, sinkage: true }),
        ("mean of 100", Design::Kapvik { instants: 100, sinkage: true }),
        ("mean of 100, no sinkage", Design::Kapvik { instants: 100, sinkage: false }),
    ];

    /// `count` rovers of each kind in a world.
    ///
    /// # Errors
    /// Where no rover could drive with the effects of the world.
    pub fn draw(world: &World, count: usize, seed: u32) -> Result<Self, HostError> {
        let draw = |(name, design)| Ok((name, scenes_in(world, design, count, seed)?));
        Ok(Self { kinds: Self::KINDS.into_iter().map(draw).collect::<Result<_, HostError>>()?, seed })
    }
}

/// Scores of several networks on the same rovers: for each kind its name, and a score for each network.
pub fn compare<const PAIRS: usize>(tables: &[&RoverTable<PAIRS>], rovers: &Rovers) -> Vec<(&'static str, Vec<Score>)> {
    let scores = |scenes: &[Scene]| tables.iter().map(|table| score_rover(table, scenes, rovers.seed)).collect();
    rovers.kinds.iter().map(|(name, scenes)| (*name, scores(scenes))).collect()
}
