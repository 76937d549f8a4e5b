//! Load cells against mass and gravity, on drives of the simulator: silent where the rover file is right, and not where it is wrong.

use kapvik_firmware::rover::{Planar, Rover};
use kapvik_host::replay::{Misfit, Weighing};
use kapvik_host::simulate::effects::RoverEffects;
use kapvik_host::simulate::{Options, Scenario, Traverse};
use rayon::prelude::*;

/// What a drive of `truly` says of rover files, each of which states such a rover; none where the rover gets stuck.
fn misfits<const FILES: usize>(
    (scenario, seed): (Scenario, u64),
    truly: &Rover<f64>,
    stated: [Rover<f64>; FILES],
    options: &Options,
) -> Option<[Option<Misfit>; FILES]> {
    let mut weighings = stated.map(|stated| Weighing::of(&stated.map(|value| value as f32)));
    for step in Traverse::new(scenario, seed, truly, options).ok()? {
        let (frame, _) = step.ok()?;
        weighings.iter_mut().for_each(|weighing| weighing.take(&frame));
    }
    Some(weighings.map(|weighing| weighing.misfit()))
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

/// Kapvik with hubs at other heights, so that its rockers and bogies hang askew by 2° and 11° where it stands on the level.
fn askew() -> Rover<f64> {
    let mut rover = Rover::assumed();
    let links = &mut rover.suspension;
    (links.front_hub, links.bogie_pivot) = (Planar { x: 0.40, z: -0.25 }, Planar { x: -0.12, z: -0.08 });
    (links.middle_hub, links.rear_hub) = (Planar { x: 0.16, z: -0.12 }, Planar { x: -0.24, z: -0.20 });
    rover
}

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
        (askew(), Options::default()),
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
            let found = misfits((scenario, seed), &rover, [rover], &options)?;
            assert_eq!(found, [None], "{} kg, {scenario:?}, seed {seed}, {:?}", rover.mass_kg, options.effects);
            Some(())
        });
        through.count()
    };
    let drives: usize = right_ones().into_iter().map(of_rover).sum();
    println!("{drives} drives");
    assert!(drives > 150, "most of these rovers get through");
}

#[test]
fn a_wrong_mass_is_noticed() {
    let truly = Rover::assumed();
    let masses_kg = [40.0, 40.5];
    let stated = masses_kg.map(|mass_kg| Rover { mass_kg, ..truly });
    let drives = DRIVES.into_par_iter().flat_map_iter(|scenario| (1..4).map(move |seed| (scenario, seed)));
    drives.for_each(|(scenario, seed)| {
        let found = misfits((scenario, seed), &truly, stated, &Options::default()).expect("a drive");
        for (mass_kg, found) in masses_kg.into_iter().zip(found) {
            let Misfit { borne_n, due_n } = found.unwrap_or_else(|| panic!("{mass_kg} kg, {scenario:?}, seed {seed}"));
            let ratio = borne_n / due_n * mass_kg;
            assert!((ratio - 41.0).abs() < 0.2, "{mass_kg} kg, {scenario:?}, seed {seed}: as of {ratio} kg");
        }
    });
}

/// Cells that say nothing but zero bear nothing, which is told, too.
#[test]
fn cells_that_bear_nothing_are_noticed() {
    let rover = Rover::assumed();
    let mut weighing = Weighing::of(&rover.map(|value| value as f32));
    for step in Traverse::new(Scenario::Spread, 1, &rover, &Options::default()).expect("a drive") {
        let (mut frame, _) = step.expect("a frame");
        frame.wheels.iter_wheels_mut().for_each(|wheel| wheel.load_cell_n = Some(0.0));
        weighing.take(&frame);
    }
    let misfit = weighing.misfit().expect("nothing is borne");
    let told = misfit.to_string();
    assert!(misfit.borne_n == 0.0 && told.starts_with("the load cells together bear 0 N where"), "{told}");
}
