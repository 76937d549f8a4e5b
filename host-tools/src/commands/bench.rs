//! `kapvik bench`: how fast we are, beside the alternatives.

use clap::Subcommand;

use crate::bench::forward;
use crate::error::HostError;

/// What to measure.
#[derive(Subcommand)]
pub enum Subject {
    /// Evaluations of equations 1–11 per second, beside a Simpson loop and SciPy's quad
    Forward,
}

impl Subject {
    /// Measures, and prints a table.
    ///
    /// # Errors
    /// Where an alternative that is there does not work.
    pub fn execute(self) -> Result<(), HostError> {
        match self {
            Self::Forward => forward::print(),
        }
        Ok(())
    }
}
