//! Many drives of a scenario, and what they came to.

use indicatif::ParallelProgressIterator;
use kapvik_firmware::rover::Rover;
use rayon::prelude::*;

use super::consistency::{NormalisedSquares, Sum};
use super::drive::{Drive, Quantity};
use super::errors::Errors;
use super::tally::Tally;
use super::whiteness::ljung_box;
use crate::error::HostError;
use crate::progress::bar;
use crate::simulate::{Options, Scenario};
use crate::statistics::Measured;

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
    let progress = bar(scenario.to_string(), (seeds.end - seeds.start) as usize);
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

/// Errors over drives of some seeds with these options, all of which have to succeed.
///
/// # Errors
/// That of the first drive that fails.
pub fn errors_over(
    scenario: Scenario,
    seeds: std::ops::Range<u64>,
    rover: &Rover<f64>,
    options: &Options,
) -> Result<Errors, HostError> {
    let drives = seeds.into_par_iter().map(|seed| Drive::run(scenario, seed, rover, options).map(|drive| drive.errors));
    Ok(drives.collect::<Result<Vec<Errors>, HostError>>()?.into_iter().sum())
}

impl Trial {
    /// Errors of all drives.
    pub fn errors(&self) -> Errors {
        self.drives.iter().map(|drive| drive.errors).sum()
    }

    /// Root mean square error in a quantity over that of the raw sensors, with one standard error.
    pub fn over_naive(&self, quantity: Quantity) -> Measured {
        self.with_error(|drives| tally(drives, quantity).over_naive())
    }

    /// Shares of a quantity's errors within one and within two stated standard deviations, each with one standard error.
    pub fn coverage(&self, quantity: Quantity) -> [Measured; 2] {
        [0, 1].map(|stds| self.with_error(|drives| tally(drives, quantity).coverage()[stds]))
    }

    /// Mean of normalised squares over their degrees of freedom, in the order of [`Self::squares`], with one standard error.
    pub fn mean_squares(&self) -> [Measured; 5] {
        let totals: Vec<[Sum; 5]> =
            self.drives.iter().map(|drive| parts(drive).map(NormalisedSquares::total)).collect();
        [0, 1, 2, 3, 4].map(|part| {
            jackknife(totals.len(), |left_out| {
                let others = totals.iter().enumerate().filter(|(place, _)| Some(*place) != left_out);
                let add = |(squares, degrees), total: &Sum| (squares + total.squares, degrees + total.degrees);
                let (squares, degrees) = others.fold((0.0, 0.0), |sum, (_, totals)| add(sum, &totals[part]));
                squares / degrees
            })
        })
    }

    fn with_error(&self, of: impl Fn(&mut dyn Iterator<Item = &Drive>) -> f64) -> Measured {
        jackknife(self.drives.len(), |left_out| {
            let others = self.drives.iter().enumerate().filter(|(place, _)| Some(*place) != left_out);
            of(&mut others.map(|(_, drive)| drive))
        })
    }

    /// Squares of all drives, frame by frame and wheel by wheel: errors of filters 1 and 2, then innovations of filter 1 and of both halves
    /// of filter 2.
    pub fn squares(&self) -> [NormalisedSquares; 5] {
        let mut sums: [NormalisedSquares; 5] = Default::default();
        for drive in &self.drives {
            sums.iter_mut().zip(parts(drive)).for_each(|(sum, part)| sum.add_run(part));
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

fn parts(drive: &Drive) -> [&NormalisedSquares; 5] {
    let [wheels, angles, forces] = &drive.innovations;
    [&drive.filter_1, &drive.filter_2, wheels, angles, forces]
}

fn tally(drives: &mut dyn Iterator<Item = &Drive>, quantity: Quantity) -> Tally {
    drives.fold(Tally::default(), |mut sum, drive| {
        sum.add(drive.errors.of(quantity));
        sum
    })
}

/// A figure of some drives, which `without` gives with one of them left out or with none, and one standard error of it: what other
/// drives of the same kind would change (Tukey 1958); infinite of fewer than two. Frames of a drive belong together.
fn jackknife(drives: usize, without: impl Fn(Option<usize>) -> f64) -> Measured {
    if drives < 2 {
        return Measured { value: without(None), standard_error: f64::INFINITY };
    }
    let count = drives as f64;
    let figures: Vec<f64> = (0..drives).map(|place| without(Some(place))).collect();
    let mean = figures.iter().sum::<f64>() / count;
    let squares: f64 = figures.iter().map(|figure| (figure - mean).powi(2)).sum();
    Measured { value: without(None), standard_error: (squares * (count - 1.0) / count).sqrt() }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::estimator::Estimate;

    use super::{Drive, Quantity, Trial};
    use crate::simulate::Scenario;
    use crate::statistics::Measured;

    /// Of a mean the jackknife gives the usual standard error. Here the raw sensors always err by 1 N, and the estimates of each drive
    /// by the root of 1, 2, 3, 4 N²: the squared ratio is a mean of these, 2.5 with a standard error of √(5/3)/2, and the ratio has
    /// that over twice itself, to first order.
    #[test]
    fn the_error_of_a_ratio_is_what_other_drives_would_change() {
        let drive = |square: f64| {
            let mut drive = Drive::default();
            let estimate = Estimate { value: square.sqrt() as f32, std: 1.0 };
            drive.errors.take_one(Quantity::BogiePull, estimate, [Some(1.0), Some(1.0)], 0.0);
            drive
        };
        let drives = [1.0, 2.0, 3.0, 4.0].map(drive).to_vec();
        let trial = Trial { scenario: Scenario::Slope, drives, failures: Vec::new() };
        let Measured { value: ratio, standard_error: error } = trial.over_naive(Quantity::BogiePull);
        assert!((ratio - 2.5_f64.sqrt()).abs() < 1.0e-6, "{ratio}");
        let expected = (5.0_f64 / 3.0).sqrt() / 2.0 / (2.0 * ratio);
        assert!((error / expected - 1.0).abs() < 0.1, "{error} {expected}");
    }
}
