//! Many drives of a scenario, and what they came to.

use indicatif::{ParallelProgressIterator, ProgressBar};
use kapvik_firmware::rover::Rover;
use rayon::prelude::*;

use super::consistency::NormalisedSquares;
use super::drive::Drive;
use super::errors::Errors;
use super::whiteness::ljung_box;
use crate::error::HostError;
use crate::simulate::{Options, Scenario};

/// Drives of one scenario.
#[derive(Debug, Clone)]
pub struct Trial {
    /// What was driven.
    pub scenario: Scenario,
    /// The drives.
    pub drives: Vec<Drive>,
    /// Why seeds gave no drive: rovers do get stuck.
    pub failures: Vec<String>,
}

/// Drives a scenario once for each seed.
pub fn trial(scenario: Scenario, seeds: std::ops::Range<u64>, rover: &Rover<f64>) -> Trial {
    let options = Options::default();
    let progress = ProgressBar::new(seeds.end - seeds.start).with_message(format!("{scenario:?}"));
    let results: Vec<Result<Drive, HostError>> =
        seeds.into_par_iter().progress_with(progress).map(|seed| Drive::run(scenario, seed, rover, &options)).collect();
    let mut trial = Trial { scenario, drives: Vec::new(), failures: Vec::new() };
    for result in results {
        match result {
            Ok(drive) => trial.drives.push(drive),
            Err(error) => trial.failures.push(error.to_string()),
        }
    }
    trial
}

impl Trial {
    /// Errors of all drives.
    pub fn errors(&self) -> Errors {
        self.drives.iter().fold(Errors::default(), |mut sum, drive| {
            sum.add(&drive.errors);
            sum
        })
    }

    /// Squares of all drives, frame by frame: errors of filters 1 and 2, then innovations of filter 1 and of both halves
    /// of filter 2.
    pub fn squares(&self) -> [NormalisedSquares; 5] {
        let mut sums: [NormalisedSquares; 5] = Default::default();
        for drive in &self.drives {
            let [first, second, third] = &drive.innovations;
            let parts = [&drive.filter_1, &drive.filter_2, first, second, third];
            sums.iter_mut().zip(parts).for_each(|(sum, part)| sum.add_run(part));
        }
        sums
    }

    /// For each series of innovations the share of the drives in which it passes as white at 5 %.
    pub fn share_white(&self) -> [f64; 12] {
        let mut shares = [0.0; 12];
        for (place, share) in shares.iter_mut().enumerate() {
            let chances: Vec<f64> = self.drives.iter().filter_map(|drive| ljung_box(&drive.series[place])).collect();
            *share = chances.iter().filter(|chance| **chance > 0.05).count() as f64 / chances.len().max(1) as f64;
        }
        shares
    }
}
