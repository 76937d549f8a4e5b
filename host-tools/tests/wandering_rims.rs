//! Wheels that depart from their commands, each in its own way, by several percent: the rover goes on as it went, and their slips and
//! torques change with their own speeds.

use kapvik_firmware::rover::Rover;
use kapvik_host::simulate::effects::RoverEffects;
use kapvik_host::simulate::{Options, Scenario};
use kapvik_host::trial::errors::Errors;
use kapvik_host::trial::{Quantity, errors_over};

/// Seeds that development has not looked at.
const SEEDS: std::ops::Range<u64> = 8320..8326;

fn errors(scenario: Scenario, rim_wander: f64) -> Errors {
    let effects = RoverEffects { rim_wander: Some(rim_wander), ..RoverEffects::default() };
    let options = Options { effects, ..Options::default() };
    errors_over(scenario, SEEDS, &Rover::assumed(), &options).expect("drives")
}

#[test]
fn slips_and_torques_are_better_than_those_of_the_raw_sensors_and_say_how_well() {
    let drives = [Scenario::Level, Scenario::Spread]
        .into_iter()
        .flat_map(|scenario| [0.03, 0.06].map(|share| (scenario, share)));
    for (scenario, rim_wander) in drives {
        let errors = errors(scenario, rim_wander);
        for quantity in [Quantity::Slip, Quantity::Torque] {
            let tally = errors.of(quantity);
            let (ratio, [one, two]) = (tally.over_naive(), tally.coverage());
            let what = format!("{scenario:?}, {rim_wander}, {quantity:?}");
            println!("{what}: {ratio:.3} of the raw sensors, {one:.2} {two:.2} within");
            assert!(ratio <= 1.0 && one >= 0.55 && two >= 0.88, "{what}: {ratio}, {one} {two}");
        }
    }
}
