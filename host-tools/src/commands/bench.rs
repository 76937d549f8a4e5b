//! `kapvik bench`: how good and how fast we are, beside the alternatives.

mod diagnose;
mod filter;
mod target;

use clap::{Args, Subcommand};

use crate::bench::closing::{self, ClosingArguments};
use crate::bench::diagnose::DiagnoseArguments;
use crate::bench::estimators::{self, EstimatorArguments};
use crate::bench::faults::{self, FaultArguments};
use crate::bench::limit::{self, LimitArguments};
use crate::bench::{forward, network, training};
use crate::error::HostError;

/// What to measure.
#[derive(Subcommand)]
pub enum Subject {
    /// Errors of the rover network on soil with slip-sinkage, trained without and with it declared
    Closing(ClosingArguments),
    /// How often a diagnosis finds what nobody declared, on campaigns drawn from a seed
    Diagnose(DiagnoseArguments),
    /// Errors, coverage and consistency of the wheel-force estimators on simulated drives
    Estimators(EstimatorArguments),
    /// How soon the estimators are back after each fault of each sensor
    Faults(FaultArguments),
    /// The sigma-point filter beside kfilter, multicalc and minikalman: instructions, stack, survival of faults
    Filter,
    /// Evaluations of equations 1–11 per second, beside a Simpson loop and SciPy's quad
    Forward,
    /// The accuracy that no estimator of the soil can beat: the mean of the exact posterior
    Limit(LimitArguments),
    /// Errors and coverage of the frozen rover network on unseen cases
    Network(Cases),
    /// Instructions and stack of the flight functions, memory of the flight image
    Target,
    /// Training time to the same validation loss, beside scikit-learn and PyTorch
    Training,
}

/// Which cases.
#[derive(Args)]
pub struct Cases {
    /// Unseen cases of each kind.
    #[arg(long, default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    cases: u32,
    /// Seed of the cases; training uses 1, and 4294967294 for its check.
    #[arg(long, default_value_t = 2026)]
    seed: u32,
}

impl Subject {
    /// Measures, and prints a table.
    ///
    /// # Errors
    /// Where an alternative that is there does not work.
    pub fn execute(self) -> Result<(), HostError> {
        match self {
            Self::Closing(arguments) => closing::run(&arguments)?,
            Self::Diagnose(arguments) => diagnose::execute(&arguments)?,
            Self::Estimators(arguments) => estimators::run(&arguments)?,
            Self::Faults(arguments) => faults::run(&arguments),
            Self::Filter => filter::execute()?,
            Self::Forward => forward::print(),
            Self::Limit(arguments) => limit::run(&arguments, &network::rover_mean)?,
            Self::Network(Cases { cases, seed }) => network::print(cases as usize, seed)?,
            Self::Target => target::execute()?,
            Self::Training => training::print()?,
        }
        Ok(())
    }
}
