//! `kapvik close-loop`

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use kapvik_firmware::terramechanics::Soil;

use crate::close_loop::{Options, close};
use crate::data::atomic_write::{write_json, write_text};
use crate::data::campaign::{Campaign, Provenance};
use crate::data::soil_file::SoilTable;
use crate::diagnose::document::Diagnosis;
use crate::error::HostError;
use crate::process::workspace;
use crate::report::diagnosis::page;
use crate::train::plan::Plan;

use super::diagnose;

/// Options of `kapvik close-loop`.
#[derive(Args)]
pub struct Arguments {
    /// The campaign NAME.csv, with NAME.toml beside it; or the name of one that the project carries, as for `diagnose`
    #[arg(value_name = "CAMPAIGN.csv")]
    campaign: PathBuf,
    /// Where declared.toml and the trained table go [default: target/kapvik-close-loop]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// A diagnosis of this campaign that `kapvik diagnose --json` has written, in place of a new one
    #[arg(long, value_name = "D.json")]
    diagnosis: Option<PathBuf>,
    /// The campaign's soil where it is known, as a file with a complete [soil] [default: NAME.truth.toml beside the campaign, if
    /// there is one]
    #[arg(long, value_name = "SOIL.toml")]
    truth: Option<PathBuf>,
    /// Seed of training and of the simulated rovers
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// A run of seconds, to see that everything works; what it trains is not worth flying
    #[arg(long)]
    quick: bool,
}

/// Diagnoses, trains, compares, and prints the tables.
///
/// # Errors
/// Where a file is not as it should be or cannot be written.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let start = Instant::now();
    let say = |what: &str| eprintln!("[{:4.0} s] {what}", start.elapsed().as_secs_f64());
    let campaign = diagnose::campaign(&arguments.campaign)?;
    let truth = truth(arguments)?;
    let folder = arguments.output.clone().unwrap_or_else(|| workspace().join("target/kapvik-close-loop"));
    let diagnosis = match &arguments.diagnosis {
        Some(path) => read(path)?,
        None => {
            say("diagnosis");
            let outcome = diagnose::with_progress(&campaign, false)?;
            std::fs::create_dir_all(&folder).map_err(HostError::file(&folder))?;
            write_text(&folder.join("diagnosis.html"), &page(&diagnose::findings(&campaign, &outcome)))?;
            write_json(&folder.join("diagnosis.json"), &outcome.document)?;
            outcome.document
        }
    };
    let (plan, rovers) = match arguments.quick {
        true => (Plan::quick(arguments.seed), 1000),
        false => (Plan::medium(arguments.seed), 10_000),
    };
    // Of a seed that no plan draws its scenes from.
    let options = Options { plan, rovers, seed: arguments.seed.wrapping_add(1 << 30) };
    let closed = close(&campaign, &diagnosis, truth.as_ref(), &folder, &options, &say)?;
    say("done");
    println!("{}", sentence(&diagnosis));
    println!("\nRoot mean square errors on held-out runs\n\n{}", closed.forces);
    println!("\ndeclared model: {}", folder.join("declared.toml").display());
    let Some(soil) = closed.soil else {
        println!("Nothing was found that could be declared: the networks stay as they are.");
        return Ok(());
    };
    let [before, after] = &soil.effects;
    println!("\nRover network trained for\n  before  {before}\n  after   {after}");
    println!("by the same plan: {} scenes, {} epochs.", plan.scenes, plan.rover.epochs);
    println!(
        "\nErrors on {rovers} simulated rovers of each kind, on soil with the effects of after\n\n{}",
        soil.errors
    );
    println!("\n{}\n\n{}", title_of_estimates(&campaign, truth.is_some()), soil.estimates);
    let table = folder.join("kapvik.table");
    println!("\ntable: {}\nto fly it: kapvik run --weights {0}", table.display());
    Ok(())
}

/// The soil that was named, or that of a file beside the campaign.
fn truth(arguments: &Arguments) -> Result<Option<Soil<f64>>, HostError> {
    let beside = arguments.campaign.with_extension("truth.toml");
    match &arguments.truth {
        Some(path) => SoilTable::read_complete(path).map(Some),
        None if beside.is_file() => SoilTable::read_complete(&beside).map(Some),
        None => Ok(None),
    }
}

fn title_of_estimates(campaign: &Campaign, is_known: bool) -> &'static str {
    match (is_known, campaign.provenance) {
        (true, _) => "Estimates on the campaign itself, beside the truth",
        (false, Provenance::Simulated) => {
            "Estimates on the campaign itself (simulated; --truth SOIL.toml would show their errors)"
        }
        (false, _) => "Estimates on the campaign itself, whose truth is not known",
    }
}

/// The diagnosis' own sentence, which begins with the campaign's name.
fn sentence(diagnosis: &Diagnosis) -> String {
    match diagnosis.sentence.as_str() {
        "" => format!("{}: {}", diagnosis.campaign, diagnosis.verdict),
        sentence => sentence.to_owned(),
    }
}

fn read(path: &Path) -> Result<Diagnosis, HostError> {
    let text = std::fs::read_to_string(path).map_err(HostError::file(path))?;
    serde_json::from_str(&text).map_err(|error| HostError::Input {
        path: path.to_path_buf(),
        line: error.line() as u64,
        column: error.column() as u64,
        message: format!("not a diagnosis: {error}"),
    })
}
