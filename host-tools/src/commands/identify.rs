//! `kapvik identify`

use std::path::PathBuf;

use clap::Args;

use crate::data::atomic_write::write_json;
use crate::data::outputs;
use crate::error::HostError;
use crate::flight_computer::FlightComputer;
use crate::identify::{Document, Method, identify_beside, identify_rehearsed};
use crate::progress::{spinner, with_progress};
use crate::report::identified;

use super::diagnose::campaign;

/// Options of `kapvik identify`.
#[derive(Args)]
pub struct Arguments {
    /// The campaign NAME.csv, with NAME.toml beside it; or the name of one that the project carries (ding2011-smooth,
    /// cmu-smooth-straight, cmu-smooth-transients)
    campaign: PathBuf,
    /// How the soil is identified
    #[arg(long, value_enum)]
    method: Method,
    /// Where the estimates go
    #[arg(long, value_name = "OUT.json")]
    json: PathBuf,
}

/// Identifies the soil of each run.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let table = &arguments.campaign;
    let outputs = [Some(arguments.json.as_path())];
    outputs::check(&outputs, &[Some(table), Some(&table.with_extension("toml"))])?;
    let campaign = campaign(table)?;
    let document = match arguments.method {
        Method::Network => {
            let mut computer = FlightComputer::in_process()?;
            let _spinner = spinner("networks");
            Document::of(&campaign, &identify_rehearsed(&campaign, false, &mut |query| computer.query(query))?)
        }
        method => with_progress("runs", |bar| identify_beside(method, &campaign, bar))?,
    };
    write_json(&arguments.json, &document)?;
    outputs::tell(&identified(&document), &outputs);
    Ok(())
}
