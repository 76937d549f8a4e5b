//! `kapvik bench diagnose`

use crate::bench::diagnose::{Answer, DiagnoseArguments, run};
use crate::data::campaign::Campaign;
use crate::diagnose::{DiagnoseOptions, diagnose};
use crate::error::HostError;

/// Draws campaigns, diagnoses each, and prints how often that was right.
pub fn execute(arguments: &DiagnoseArguments) -> Result<(), HostError> {
    run(arguments, &diagnosis)
}

fn diagnosis(campaign: &Campaign) -> Result<Answer, HostError> {
    diagnose(campaign, &DiagnoseOptions::default(), &|_| ()).map(|outcome| Answer::from(&outcome.document))
}
