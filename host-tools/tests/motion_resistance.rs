//! What of its load the soil takes from front wheels and from bogies, on drives of the simulator: silent where the rover file is right, and not where it
//! states another centre of mass.

use clap::ValueEnum;
use kapvik_firmware::rover::Rover;
use kapvik_host::replay::MotionResistance;
use kapvik_host::simulate::effects::RoverEffects;
use kapvik_host::simulate::{Options, Scenario, Traverse};
use kapvik_host::trial::flight_pipeline;
use rayon::prelude::*;

/// What is told of a drive of `truly` by one who takes it for the rover that is assumed; none where the rover gets stuck.
fn told(scenario: Scenario, seed: u64, truly: &Rover<f64>, options: &Options) -> Option<Option<String>> {
    let stated = Rover::assumed();
    let mut pipeline = flight_pipeline(&stated).expect("a rover that can be");
    let mut resistance = MotionResistance::of(&stated.map(|value| value as f32));
    for step in Traverse::new(scenario, seed, truly, options).ok()? {
        resistance.take(pipeline.tick(&step.ok()?.0));
    }
    Some(resistance.told())
}

/// Slips, slopes, effects of the soil and friction in the drives make less of a difference, on ground of any kind.
#[test]
fn a_right_rover_file_is_not_doubted() {
    let with = |id: &str, value: f64| {
        let effects = RoverEffects::only(id, value).expect("an effect of rovers");
        Options { effects, ..Options::default() }
    };
    let worlds = [
        Options::default(),
        with("slip-sinkage", 0.4),
        with("multi-pass", 1.0),
        with("grouser-ripple", 0.2),
        with("drive-friction", 0.2),
    ];
    let drives =
        worlds.iter().flat_map(|world| Scenario::value_variants().iter().map(move |scenario| (*scenario, world)));
    let driven = drives.zip(8530..).par_bridge().filter_map(|((scenario, world), seed)| {
        let told = told(scenario, seed, &Rover::assumed(), world)?;
        assert_eq!(told, None, "{scenario:?}, seed {seed}");
        Some(())
    });
    let driven = driven.count();
    assert!(driven >= 50, "{driven} of 60 rovers did not get stuck");
}

#[test]
fn another_centre_of_mass_is_told() {
    for ahead_m in [-0.05, -0.02, 0.02, 0.05] {
        let mut truly = Rover::assumed();
        truly.suspension.centre_of_mass.x += ahead_m;
        for (scenario, seed) in
            [Scenario::Level, Scenario::Spread, Scenario::Hills, Scenario::Slope].into_iter().zip(8595..)
        {
            let told = told(scenario, seed, &truly, &Options::default()).expect("a drive");
            let begins = told.as_ref().is_some_and(|said| said.starts_with("of its load the soil takes"));
            assert!(begins, "{ahead_m} m, {scenario:?}, seed {seed}: {told:?}");
        }
    }
}
