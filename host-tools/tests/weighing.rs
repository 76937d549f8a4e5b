//! Load cells against mass and gravity, on drives of the simulator: silent where the rover file is right, and not where it is wrong.

use kapvik_firmware::rover::Rover;
use kapvik_host::replay::{Misfit, Weighing};
use kapvik_host::simulate::effects::RoverEffects;
use kapvik_host::simulate::{Options, Scenario, Traverse};
use rayon::prelude::*;

/// What a drive of `truly` says of a rover file that states `stated`; none where the rover gets stuck.
fn misfit(
    scenario: Scenario,
    seed: u64,
    truly: &Rover<f64>,
    stated: &Rover<f64>,
    options: &Options,
) -> Option<Option<Misfit>> {
    let mut weighing = Weighing::of(&stated.map(|value| value as f32));
    for step in Traverse::new(scenario, seed, truly, options).ok()? {
        weighing.take(&step.ok()?.0);
    }
    Some(weighing.misfit())
}

const DRIVES: [Scenario; 11] = [
    Scenario::Traverse,
    Scenario::Level,
    Scenario::Spread,
    Scenario::Hills,
    Scenario::Slope,
    Scenario::Rock,
    Scenario::Dropout,
    Scenario::StartStop,
    Scenario::WheelLift,
    Scenario::WheelBlocked,
    Scenario::SoilChange,
];

/// Rovers of 41 to 400 kg, with what acts beside equations 1–11 left free.
fn right_ones() -> Vec<(Rover<f64>, Options)> {
    let kapvik = Rover::assumed();
    let heavy = |mass_kg, radius_m| {
        let mut rover = Rover { mass_kg, ..kapvik };
        (rover.wheel.radius_m, rover.wheel.width_m) = (radius_m, radius_m);
        rover
    };
    let with = |name: &str, value: f64| {
        let effects = RoverEffects::only(name, value).expect("an effect of rovers");
        Options { effects, ..Options::default() }
    };
    vec![
        (kapvik, Options::default()),
        (heavy(200.0, 0.15), Options::default()),
        (heavy(400.0, 0.15), Options::default()),
        (heavy(200.0, 0.15), with("slip-sinkage", 0.3)),
        (heavy(200.0, 0.15), with("grouser-ripple", 0.1)),
    ]
}

#[test]
fn a_right_rover_file_is_not_doubted() {
    let of_rover = |(rover, options): (Rover<f64>, Options)| {
        let drives = DRIVES.into_par_iter().flat_map_iter(|scenario| (1..5).map(move |seed| (scenario, seed)));
        let through = drives.filter_map(|(scenario, seed)| {
            let found = misfit(scenario, seed, &rover, &rover, &options)?;
            assert_eq!(found, None, "{} kg, {scenario:?}, seed {seed}, {:?}", rover.mass_kg, options.effects);
            Some(())
        });
        through.count()
    };
    let drives: usize = right_ones().into_iter().map(of_rover).sum();
    println!("{drives} drives");
    assert!(drives > 150, "most of these rovers get through");
}

/// On rocks the forces along the links, which no cell feels, leave half a per cent to chance.
#[test]
fn a_wrong_mass_is_noticed() {
    let truly = Rover::assumed();
    for (mass_kg, but) in [(40.0, &[Scenario::Rock][..]), (40.5, &[Scenario::Rock, Scenario::Traverse])] {
        let stated = Rover { mass_kg, ..truly };
        for scenario in DRIVES.into_iter().filter(|scenario| !but.contains(scenario)) {
            for seed in 1..4 {
                let found = misfit(scenario, seed, &truly, &stated, &Options::default()).expect("a drive");
                let Misfit { borne_n, due_n } =
                    found.unwrap_or_else(|| panic!("{mass_kg} kg, {scenario:?}, seed {seed}"));
                let ratio = borne_n / due_n * mass_kg;
                assert!((ratio - 41.0).abs() < 0.2, "{mass_kg} kg, {scenario:?}, seed {seed}: as of {ratio} kg");
            }
        }
    }
}
