//! The commands, one file each.

mod identify;
mod train;

use clap::Subcommand;

use crate::error::HostError;

/// What `kapvik` can be asked to do.
#[derive(Subcommand)]
pub enum Command {
    /// Cohesion, friction angle and shear modulus from a wheel campaign
    Identify(identify::Arguments),
    /// Train the networks and write the frozen table.
    Train(train::TrainArgs),
}

impl Command {
    /// Carries out the command.
    ///
    /// # Errors
    /// One that a person can act on: it names the file, line and column where there is one.
    pub fn execute(self) -> Result<(), HostError> {
        match self {
            Self::Identify(arguments) => identify::execute(&arguments),
            Self::Train(args) => args.run(),
        }
    }
}
