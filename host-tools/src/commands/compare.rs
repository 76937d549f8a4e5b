//! `kapvik compare`

use std::path::PathBuf;

use clap::Args;

use crate::compare::{CompareOptions, compare};
use crate::data::atomic_write::{write_json, write_text};
use crate::data::outputs;
use crate::error::HostError;
use crate::progress::bar;
use crate::report::compare::{page, terminal};

/// Options of `kapvik compare`.
#[derive(Args)]
pub struct Arguments {
    /// Cases of each situation
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    cases: u32,
    /// Cases of each situation that the exact posterior is sampled for, which takes a second each
    #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    limit_cases: u32,
    /// Seed of soils, loads and noise
    #[arg(long, default_value_t = 2026)]
    seed: u64,
    /// A situation by name, in place of all; may be given again
    #[arg(long, value_name = "SITUATION")]
    only: Vec<String>,
    /// Where the table goes
    #[arg(long, value_name = "OUT.json")]
    json: Option<PathBuf>,
    /// Where the report goes, to open in a browser
    #[arg(long, value_name = "OUT.html")]
    html: Option<PathBuf>,
}

/// Compares the methods, and prints the table.
///
/// # Errors
/// Where there is no such situation, or a file cannot be written.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let outputs = [arguments.json.as_deref(), arguments.html.as_deref()];
    outputs::check(&outputs, &[])?;
    let options = CompareOptions {
        cases: arguments.cases as usize,
        limit_cases: arguments.limit_cases as usize,
        seed: arguments.seed,
        only: arguments.only.clone(),
        contenders: Vec::new(),
    };
    let bar = bar("answers", options.answers()?);
    let comparison = compare(&options, &|| bar.inc(1))?;
    bar.finish_and_clear();
    outputs::tell(&terminal(&comparison), &outputs);
    if let Some(path) = &arguments.json {
        write_json(path, &comparison)?;
    }
    if let Some(path) = &arguments.html {
        write_text(path, &page(&comparison))?;
    }
    Ok(())
}
