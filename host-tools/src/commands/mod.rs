//! The commands, one file each.

mod bench;
mod train;

use clap::Subcommand;

use crate::error::HostError;

/// What `kapvik` can be asked to do.
#[derive(Subcommand)]
pub enum Command {
    /// Speed and quality, side by side with the alternatives, in one run
    #[command(subcommand)]
    Bench(bench::Subject),
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
            Self::Bench(subject) => subject.execute(),
            Self::Train(args) => args.run(),
        }
    }
}
