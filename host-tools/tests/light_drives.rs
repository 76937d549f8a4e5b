//! A drive of little inertia changes its rate by more within a frame than its wheel turns at: the torque tells nothing of it then, and the
//! encoder all.

use kapvik_firmware::rover::Rover;
use kapvik_host::simulate::{Options, Scenario};
use kapvik_host::trial::errors::Errors;
use kapvik_host::trial::{Quantity, errors_over};

/// Seeds that development has not looked at.
const SEEDS: std::ops::Range<u64> = 8310..8316;

fn errors(scenario: Scenario, inertia_kg_m2: f64, rate_hz: f64) -> Errors {
    let mut rover = Rover::assumed();
    rover.drive.reflected_inertia_kg_m2 = inertia_kg_m2;
    let options = Options { rate_hz: Some(rate_hz), ..Options::default() };
    errors_over(scenario, SEEDS, &rover, &options).expect("drives")
}

#[test]
fn a_light_drive_is_hardly_worse_than_its_raw_sensors_and_says_how_well() {
    for (inertia_kg_m2, rate_hz) in [(0.01, 10.0), (0.05, 10.0), (0.1, 2.0), (0.01, 2.0)] {
        for scenario in [Scenario::Spread, Scenario::Hills] {
            let errors = errors(scenario, inertia_kg_m2, rate_hz);
            for quantity in [Quantity::Slip, Quantity::Torque] {
                let tally = errors.of(quantity);
                let (ratio, [one, two]) = (tally.over_naive(), tally.coverage());
                let what = format!("{inertia_kg_m2} kg m² at {rate_hz} Hz, {scenario:?}, {quantity:?}");
                println!("{what}: {ratio:.3} of the raw sensors, {one:.2} {two:.2} within");
                assert!(ratio <= 1.15 && one >= 0.6 && two >= 0.9, "{what}: {ratio}, {one} {two}");
            }
        }
    }
}
