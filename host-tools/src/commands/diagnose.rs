//! `kapvik diagnose`

use std::path::{Path, PathBuf};

use clap::Args;

use crate::data::atomic_write::{write_json, write_text};
use crate::data::campaign::{Campaign, Carried};
use crate::data::outputs;
use crate::diagnose::{DiagnoseOptions, Outcome, declared_file, diagnose};
use crate::error::HostError;
use crate::progress::spinner;
use crate::report::diagnosis::{DiagnosisFindings, page, terminal};

/// Options of `kapvik diagnose`.
#[derive(Args)]
pub struct Arguments {
    /// The campaign NAME.csv, with NAME.toml beside it; or the name of one that the project carries (ding2011-smooth,
    /// cmu-smooth-straight, cmu-smooth-transients)
    campaign: PathBuf,
    /// Where the diagnosis goes
    #[arg(long, value_name = "OUT.json")]
    json: Option<PathBuf>,
    /// Where the report goes, to open in a browser
    #[arg(long, value_name = "OUT.html")]
    html: Option<PathBuf>,
    /// Where the model with the effects found goes, for `kapvik train --declared`
    #[arg(long, value_name = "D.toml")]
    declared: Option<PathBuf>,
    /// Use the rows of braking wheels as well
    #[arg(long)]
    braking: bool,
}

/// Diagnoses a campaign, and says what it lacks.
///
/// # Errors
/// Where a file is not as it should be, or cannot be written.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let Arguments { campaign: table, json, html, declared, .. } = arguments;
    let outputs = [json.as_deref(), html.as_deref(), declared.as_deref()];
    outputs::check(&outputs, &[Some(table), Some(&table.with_extension("toml"))])?;
    let campaign = campaign(table)?;
    let outcome = with_progress(&campaign, arguments.braking)?;
    let findings = findings(&campaign, &outcome);
    outputs::tell(&terminal(&findings), &outputs);
    if let Some(path) = json {
        write_json(path, &outcome.document)?;
    }
    if let Some(path) = html {
        write_text(path, &page(&findings))?;
    }
    if let Some(path) = declared {
        write_text(path, &declared_file(&campaign, &outcome.document))?;
    }
    Ok(())
}

/// The campaign of a path, or of a name that the project carries.
///
/// # Errors
/// As [`Campaign::read`].
pub fn campaign(path: &Path) -> Result<Campaign, HostError> {
    match path.to_str().and_then(Carried::from_name) {
        Some(carried) => carried.campaign(),
        None => Campaign::read(path),
    }
}

/// [`diagnose`] behind a line that says what is being done.
///
/// # Errors
/// As [`diagnose`].
pub fn with_progress(campaign: &Campaign, braking: bool) -> Result<Outcome, HostError> {
    let spinner = spinner("");
    let outcome = diagnose(campaign, &DiagnoseOptions { braking }, &|what| spinner.set_message(what.to_owned()));
    spinner.finish_and_clear();
    outcome
}

/// What the report shows.
pub fn findings(campaign: &Campaign, outcome: &Outcome) -> DiagnosisFindings {
    let traces = outcome.traces(campaign.rows().len());
    DiagnosisFindings::new(campaign, outcome.document.clone(), traces, outcome.guilty.clone())
}
