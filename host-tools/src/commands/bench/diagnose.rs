//! `kapvik bench diagnose`

use crate::bench::diagnose::{DiagnoseArguments, run};
use crate::error::HostError;

/// Draws campaigns, and prints what was drawn.
pub fn execute(arguments: &DiagnoseArguments) -> Result<(), HostError> {
    run(arguments, None)
}
