//! Errors over drives of the assumed rover on which sensors fail.

use std::ops::Range;

use kapvik_firmware::rover::Rover;
use kapvik_host::simulate::faults::Fault;
use kapvik_host::simulate::{Options, Scenario};
use kapvik_host::trial::errors::Errors;
use rayon::prelude::*;

use crate::drive_errors::drive_errors;
use crate::failing::failing;
use crate::recorded::recorded;

/// Of the drives of these seeds together.
pub fn errors(scenario: Scenario, seeds: Range<u64>, faults: &[Fault]) -> Errors {
    let of_drive = |seed| {
        let rover = Rover::assumed();
        let drive = recorded(scenario, seed, &rover, &Options::default());
        drive_errors(&rover, &failing(&drive, faults.to_vec()).collect::<Vec<_>>())
    };
    seeds.into_par_iter().map(of_drive).collect::<Vec<Errors>>().into_iter().sum()
}
