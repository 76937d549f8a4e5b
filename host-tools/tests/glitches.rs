//! Readings that are within their sensor's range and wrong, in one frame of twenty: minus three times what it would say. They must not make
//! estimates worse, nor stand in them for longer than they last.

mod drive_errors;
mod driven;
mod failing;
mod faulty_drives;
mod recorded;

use kapvik_host::data::sensor_channels;
use kapvik_host::simulate::Scenario;
use kapvik_host::simulate::faults::{Failure, Fault};
use kapvik_host::trial::Quantity;
use kapvik_host::trial::errors::Errors;

/// Seeds that development has not looked at.
const SEEDS: std::ops::Range<u64> = 8320..8324;
/// A glitch comes each two seconds, from when the rover rolls as it will up to the end of any drive, s.
const FROM_S: u32 = 6;
const EACH_S: usize = 2;
const UNTIL_S: u32 = 120;
/// Errors may grow by half, and so many must be within two standard deviations.
const TIMES: f64 = 1.5;
const LEAST: f64 = 0.9;
/// Minus three times the few milliradians a second at which hills tilt a rover is too little for one look at the accelerometer: the pitch
/// follows it, and pulls are stated too well until it is back.
const LEAST_BY_GYRO: f64 = 0.8;

const QUANTITIES: [Quantity; 6] = [
    Quantity::Slip,
    Quantity::Torque,
    Quantity::ContactAngle,
    Quantity::Load,
    Quantity::FrontPull,
    Quantity::BogiePull,
];

fn errors(scenario: Scenario, faults: &[Fault]) -> Errors {
    faulty_drives::errors(scenario, SEEDS, faults)
}

#[test]
fn glitches_of_any_sensor_make_no_estimate_worse() {
    let mut worse = Vec::new();
    for scenario in [Scenario::Level, Scenario::Hills] {
        let whole = errors(scenario, &[]);
        for column in sensor_channels::names() {
            let at =
                |time_s: u32| Fault::new(Failure::Glitch, &column, (time_s.into(), time_s.into())).expect("a fault");
            let with = errors(scenario, &(FROM_S..UNTIL_S).step_by(EACH_S).map(at).collect::<Vec<_>>());
            for quantity in QUANTITIES {
                let (tally, clean) = (with.of(quantity), whole.of(quantity));
                let ([one, two], [_, two_clean]) = (tally.coverage(), clean.coverage());
                let times = tally.rmse() / clean.rmse();
                let said = format!(
                    "{scenario}, {column}, {quantity:?}: {times:.2} times; {one:.3} {two:.3} within ({two_clean:.3})"
                );
                println!("{said}");
                let least = if column == "gyro_y_rad_s" { LEAST_BY_GYRO } else { LEAST };
                if times > TIMES || two < least {
                    worse.push(said);
                }
            }
        }
    }
    assert!(worse.is_empty(), "{worse:#?}");
}
