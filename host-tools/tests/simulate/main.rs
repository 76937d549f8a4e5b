//! The simulator against mechanics written down a second time, and its command as a person runs it.

mod balance;
mod command;
mod digging;
mod drives;
mod faults;
mod files;
#[path = "../kapvik/mod.rs"]
mod kapvik;
#[path = "../recorded/mod.rs"]
mod recorded;
#[path = "../refused/mod.rs"]
mod refused;
mod sensors;
#[path = "../../../firmware/tests/support/worse.rs"]
mod worse;

use kapvik_firmware::rover::{Rover, SensorNoise};
use kapvik_host::simulate::{Options, Scenario};
use recorded::{Recording, recorded};

/// Kapvik with sensors that err by a ten-millionth of what they do.
fn quiet_rover() -> Rover<f64> {
    let assumed = Rover::<f64>::assumed();
    Rover { noise: SensorNoise::map(assumed.noise, |std| 1.0e-7 * std), ..assumed }
}

/// A drive of the quiet rover.
fn drive(scenario: Scenario, seed: u64, options: &Options) -> Recording {
    recorded(scenario, seed, &quiet_rover(), options)
}

/// A value that a sensor gave.
fn given(value: Option<f32>) -> f64 {
    f64::from(value.expect("a reading"))
}
