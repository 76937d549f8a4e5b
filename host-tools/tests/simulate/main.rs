//! The simulator against mechanics written down a second time, and its command as a person runs it.

mod balance;
mod command;
mod digging;
mod drives;
mod faults;
mod files;
#[path = "../kapvik/mod.rs"]
mod kapvik;
#[path = "../refused/mod.rs"]
mod refused;
mod sensors;

use kapvik_firmware::rover::{Rover, SensorNoise};
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::simulate::{Options, Scenario, Traverse};

/// Kapvik with sensors that err by a ten-millionth of what they do.
fn quiet_rover() -> Rover<f64> {
    let assumed = Rover::<f64>::assumed();
    Rover { noise: SensorNoise::map(assumed.noise, |std| 1.0e-7 * std), ..assumed }
}

/// A drive of the quiet rover.
fn drive(scenario: Scenario, seed: u64, options: &Options) -> Vec<(SensorFrame, Truth)> {
    let traverse = Traverse::new(scenario, seed, &quiet_rover(), options).expect("a drive");
    traverse.run().expect("frames")
}

/// A value that a sensor gave.
fn given(value: Option<f32>) -> f64 {
    f64::from(value.expect("a reading"))
}
