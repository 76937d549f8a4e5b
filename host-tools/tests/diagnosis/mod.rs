//! The diagnosis of a campaign.

use kapvik_host::data::campaign::Campaign;
use kapvik_host::diagnose::document::Diagnosis;
use kapvik_host::diagnose::{DiagnoseOptions, diagnose};

/// What is found where nothing is asked for but the campaign.
pub fn diagnosed(campaign: &Campaign) -> Diagnosis {
    diagnose(campaign, &DiagnoseOptions::default(), &|_| ()).expect("diagnosed").document
}
