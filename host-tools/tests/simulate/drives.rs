//! Each scenario is what its name says.

use kapvik_firmware::rover::{Rover, Side};
use kapvik_host::data::truth_file::{Truth, WheelTruth};
use kapvik_host::simulate::effects::RoverEffects;
use kapvik_host::simulate::ground_soils::{Becomes, Change};
use kapvik_host::simulate::{Options, Scenario, SimulationError, Traverse};

use super::drive;

fn truths(scenario: Scenario, seed: u64) -> Vec<Truth> {
    drive(scenario, seed, &Options::default()).iter().map(|(_, truth)| *truth).collect()
}

/// Least and greatest of a quantity of the wheels.
fn range(truths: &[Truth], of: impl Fn(&WheelTruth) -> f64) -> (f64, f64) {
    truths
        .iter()
        .flat_map(|truth| truth.wheels.iter_wheels())
        .map(of)
        .inspect(|value| assert!(value.is_finite(), "{value}"))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), value| (least.min(value), greatest.max(value)))
}

#[test]
fn spread_slips_reach_from_small_to_large() {
    for seed in 40..44 {
        let truths = truths(Scenario::Spread, seed);
        let (least, greatest) = range(&truths[100..], |wheel| wheel.slip.expect("it moves"));
        assert!((0.0..0.12).contains(&least) && (0.5..0.7).contains(&greatest), "{seed}: {least} {greatest}");
    }
}

#[test]
fn equal_speeds_slip_alike() {
    let truths = truths(Scenario::Level, 40);
    let (least, greatest) = range(&truths[100..], |wheel| wheel.slip.expect("it moves"));
    assert!(greatest - least < 0.05, "{least} {greatest}");
}

#[test]
fn hills_and_rocks_are_as_steep_as_they_should_be() {
    for seed in 40..44 {
        let (least, greatest) = range(&truths(Scenario::Hills, seed), |wheel| wheel.contact_angle_rad.to_degrees());
        assert!(greatest - least > 8.0 && least > -16.0 && greatest < 16.0, "{seed}: {least} {greatest}");
        let (least, greatest) = range(&truths(Scenario::Rock, seed), |wheel| wheel.contact_angle_rad.to_degrees());
        assert!(least < -15.0 && greatest > 15.0, "{seed}: {least} {greatest}");
    }
    let truths = truths(Scenario::Hills, 40);
    let rolled =
        truths.iter().map(|truth| truth.roll_rad.to_degrees()).fold(0.0_f64, |most, roll| most.max(roll.abs()));
    assert!(rolled > 0.5, "the sides differ: {rolled}");
}

#[test]
fn varied_ground_is_gentle_and_steep() {
    let steepest = |seed| {
        let (least, greatest) = range(&truths(Scenario::Varied, seed), |wheel| wheel.contact_angle_rad.to_degrees());
        greatest.max(-least)
    };
    let steepest: Vec<f64> = (40..52).map(steepest).collect();
    assert!(steepest.iter().any(|angle| *angle < 4.0) && steepest.iter().any(|angle| *angle > 12.0), "{steepest:?}");
    assert!(steepest.iter().all(|angle| *angle < 45.0), "{steepest:?}");
}

#[test]
fn on_varied_ground_wheels_slip_little_and_much() {
    let mean_slip = |seed| {
        let truths = truths(Scenario::Varied, seed);
        let slips: Vec<f64> =
            truths[100..].iter().flat_map(|truth| truth.wheels.iter_wheels()).filter_map(|wheel| wheel.slip).collect();
        slips.iter().sum::<f64>() / slips.len() as f64
    };
    let slips: Vec<f64> = (40..52).map(mean_slip).collect();
    assert!(slips.iter().any(|slip| *slip < 0.1) && slips.iter().any(|slip| *slip > 0.35), "{slips:?}");
    assert!(slips.iter().all(|slip| *slip < 0.8), "nothing is stuck: {slips:?}");
}

#[test]
fn a_wheel_over_its_hole_carries_nothing_and_slips_all_the_same() {
    for seed in 40..44 {
        let truths = truths(Scenario::WheelLift, seed);
        let hanging = |truth: &&Truth| truth.wheels.iter_wheels().any(|wheel| wheel.normal_load_n == 0.0);
        let frames = truths.iter().filter(hanging).count();
        assert!(frames > 30, "{seed}: {frames} frames");
        for truth in truths.iter().filter(hanging) {
            let wheels = truth.wheels.iter_wheels().filter(|wheel| wheel.normal_load_n == 0.0);
            for wheel in wheels {
                assert_eq!((wheel.drawbar_pull_n, wheel.resistive_torque_nm, wheel.sinkage_m), (0.0, 0.0, 0.0));
                assert!(wheel.slip.is_some());
            }
        }
    }
}

#[test]
fn a_blocked_wheel_has_a_slip_of_minus_one_while_the_rover_moves() {
    let mut dragged = 0;
    for seed in 40..46 {
        for truth in truths(Scenario::WheelBlocked, seed) {
            dragged += truth.wheels.iter_wheels().filter(|wheel| wheel.slip.is_some_and(|slip| slip < -0.99)).count();
        }
    }
    assert!(dragged > 100, "{dragged}");
}

#[test]
fn a_rover_stops_stands_and_backs_up() {
    let truths = truths(Scenario::StartStop, 40);
    let still = |from: usize, to: usize| (truths[to].x_m - truths[from].x_m).abs() < 1.0e-3;
    assert!(still(0, 9) && still(180, 230), "it stands before the start and between");
    assert!(truths[130].x_m > truths[20].x_m + 0.1 && truths[530].x_m < truths[440].x_m - 0.1);
    assert!(truths[200].wheels.iter_wheels().all(|wheel| wheel.slip.is_none()), "slip is not defined");
    // Backing up mirrors the wheels: on the whole they slip in the sense of their own driving, torques are negative.
    let slips: f64 = truths[500].wheels.iter_wheels().map(|wheel| wheel.slip.expect("it moves")).sum();
    assert!(slips > 0.0, "{slips}");
    assert!(truths[500].wheels.iter_wheels().all(|wheel| wheel.resistive_torque_nm < 0.0));
}

/// Each wheel meets the new soil where it lies, the front ones first.
#[test]
fn soil_changes_where_it_was_said_to() {
    for (becomes, stiffer, cohesion_pa) in [(Becomes::IceCemented, 3.0, 3.0e3), (Becomes::Sublimated, 0.5, 0.0)] {
        let changes = Some(vec![Change { from_m: 0.5, becomes }]);
        let rows = drive(Scenario::SoilChange, 9, &Options { changes, ..Options::default() });
        let first = rows[0].1.soil;
        for (_, truth) in rows.iter() {
            for (wheel, place) in truth.wheels.left.as_array().into_iter().zip([0.35, 0.0, -0.35]) {
                // The rover pitches by less than 3°, and its hubs lie 0.2 m below the axis: they are within 15 mm.
                let x_m = truth.x_m + place;
                let (c, k) = (wheel.soil.cohesion_pa, wheel.soil.stiffness_pa_m_n);
                if x_m < 0.485 {
                    assert_eq!((c, k), (first.cohesion_pa, first.stiffness_pa_m_n));
                } else if x_m > 0.57 {
                    assert!((c - first.cohesion_pa - cohesion_pa).abs() < 1.0e-9);
                    assert!((k / first.stiffness_pa_m_n - stiffer).abs() < 1.0e-9);
                }
            }
        }
        let last = rows[rows.len() - 1].1.wheels.left.rear.sinkage_m / rows[100].1.wheels.left.rear.sinkage_m;
        // Sinkage goes with about the power −1/(n + ½) of the stiffness, n = 0.8 … 1.3.
        assert!(if stiffer > 1.0 { last < 0.65 } else { last > 1.3 }, "{becomes:?}: {last}");
    }
}

#[test]
fn seeds_differ_and_repeat() {
    let options = Options { duration_s: Some(5.0), ..Options::default() };
    let rover = Rover::assumed();
    let run = |seed| Traverse::new(Scenario::Traverse, seed, &rover, &options).expect("a drive").run().expect("frames");
    assert_eq!(run(1), run(1));
    let [one, two] = [run(1), run(2)];
    assert!(one[0].1.soil != two[0].1.soil && one[40].0 != two[40].0);
}

/// Whichever side that is: the world prefers none.
#[test]
fn a_rock_under_one_side_lifts_that_side() {
    for (seed, under) in [(41, Side::Left), (44, Side::Right)] {
        let truths = truths(Scenario::Rock, seed);
        let climbs = |side: Side| {
            let sum: f64 = truths.iter().map(|truth| truth.wheels.of(side).front.contact_angle_rad.abs()).sum();
            sum > 1.0
        };
        assert_eq!([climbs(Side::Left), climbs(Side::Right)], [under == Side::Left, under == Side::Right], "{seed}");
        let rolls = truths
            .iter()
            .map(|truth| truth.roll_rad)
            .fold(0.0_f64, |most, roll| if roll.abs() > most.abs() { roll } else { most });
        // Left side up is a positive roll.
        assert_eq!(rolls > 0.0, under == Side::Left, "{seed}: {rolls}");
    }
}

#[test]
fn a_rover_that_cannot_do_it_says_so() {
    let soil = |phi: f64| kapvik_firmware::terramechanics::Soil {
        sinkage_exponent: 1.1,
        cohesive_modulus: 0.0,
        frictional_modulus: 1.0e6,
        cohesion_pa: 100.0,
        friction_angle_rad: phi,
        shear_modulus_m: 0.02,
        peak_stress_c1: 0.3,
        peak_stress_c2: 0.2,
        rebound_ratio: 0.0,
    };
    let weak = Options { soil: Some(soil(0.38)), ..Options::default() };
    let stuck = Traverse::new(Scenario::Slope, 1, &Rover::assumed(), &weak).and_then(Traverse::run).map(|_| ());
    let slides_back = matches!(stuck, Err(SimulationError::SlidesBack { x_m, .. }) if x_m.abs() < 0.1);
    assert!(slides_back, "10° is too steep for it: {stuck:?}");
    let heavy = Rover { mass_kg: 4.0e5, ..Rover::assumed() };
    let found = Traverse::new(Scenario::Level, 1, &heavy, &Options::default()).map(|_| ());
    assert_eq!(found, Err(SimulationError::NoSoil));
    let given = Options { soil: Some(soil(0.6)), effects: RoverEffects::default(), ..Options::default() };
    let found = Traverse::new(Scenario::Level, 1, &heavy, &given).map(|_| ());
    assert_eq!(found, Err(SimulationError::Standing));
}
