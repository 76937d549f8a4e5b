//! All faults on many drives.

use kapvik_firmware::rover::Rover;
use rayon::prelude::*;

use super::case::Case;
use super::drive::{FaultDrive, Outcome};
use crate::error::HostError;
use crate::simulate::Scenario;

/// What became of all faults on many drives.
#[derive(Debug, Clone, Default)]
pub struct Catalogue {
    /// How many drives there were.
    pub drives: usize,
    /// The outcomes, with the scenario and seed of their drives.
    pub outcomes: Vec<(Scenario, u64, Outcome)>,
    /// Why seeds gave no drive: rovers do get stuck.
    pub failures: Vec<String>,
}

/// Drives each scenario once for each seed, and on from there with every fault.
pub fn catalogue(scenarios: &[Scenario], seeds: std::ops::Range<u64>, rover: &Rover<f64>) -> Catalogue {
    let drives: Vec<(Scenario, u64)> =
        scenarios.iter().flat_map(|scenario| seeds.clone().map(move |seed| (*scenario, seed))).collect();
    let results: Vec<Result<Vec<Outcome>, HostError>> = drives
        .par_iter()
        .map(|(scenario, seed)| {
            let drive = FaultDrive::simulate(*scenario, *seed, rover)?;
            Case::all().into_par_iter().map(|case| drive.run(case)).collect()
        })
        .collect();
    let mut catalogue = Catalogue::default();
    for ((scenario, seed), result) in drives.into_iter().zip(results) {
        match result {
            Ok(outcomes) => {
                catalogue.drives += 1;
                catalogue.outcomes.extend(outcomes.into_iter().map(|outcome| (scenario, seed, outcome)));
            }
            Err(error) => catalogue.failures.push(error.to_string()),
        }
    }
    catalogue
}
