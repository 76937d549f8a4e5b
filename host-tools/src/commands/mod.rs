//! The commands, one file each.

mod bench;
mod setup;
mod test;

use clap::Subcommand;

use crate::error::HostError;

/// What `kapvik` can be asked to do.
#[derive(Subcommand)]
pub enum Command {
    /// Speed, memory and instruction counts
    Bench(bench::Arguments),
    /// Find or install what the flight image is built and run with: the Arm target and QEMU
    Setup(setup::Arguments),
    /// Every test: host, firmware in QEMU, documentation
    Test(test::Arguments),
}

impl Command {
    /// Carries out the command.
    ///
    /// # Errors
    /// One that a person can act on: it names the file, line and column where there is one.
    pub fn execute(self) -> Result<(), HostError> {
        match self {
            Self::Bench(arguments) => bench::execute(&arguments),
            Self::Setup(arguments) => setup::execute(&arguments),
            Self::Test(arguments) => test::execute(&arguments),
        }
    }
}
