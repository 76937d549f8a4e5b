//! `kapvik bench`

mod target;

use clap::{Args, Subcommand};

use crate::error::HostError;

/// Options of `kapvik bench`.
#[derive(Args)]
pub struct Arguments {
    #[command(subcommand)]
    what: What,
}

/// What is measured.
#[derive(Subcommand)]
enum What {
    /// Instructions and stack of the flight functions, memory of the flight image
    Target,
}

/// Measures and prints.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    match arguments.what {
        What::Target => target::execute(),
    }
}
