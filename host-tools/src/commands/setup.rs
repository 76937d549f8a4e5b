//! `kapvik setup`

use clap::Args;

use crate::error::HostError;
use crate::setup::{self, TargetFrom};

/// Options of `kapvik setup`.
#[derive(Args)]
pub struct Arguments {
    /// Take the Arm target from here and from nowhere else; also: the environment variable KAPVIK_TARGET_FROM
    #[arg(long, value_enum)]
    target_from: Option<TargetFrom>,
}

/// Finds or installs what is needed.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    setup::prepare(arguments.target_from).map(|_| ())
}
