//! `kapvik close-loop`

use std::path::{Path, PathBuf};

use clap::Args;

use crate::close_loop::{Options, close};
use crate::diagnose::document::Diagnosis;
use crate::error::HostError;
use crate::process::workspace;
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
    let campaign = diagnose::campaign(&arguments.campaign)?;
    let diagnosis = match &arguments.diagnosis {
        Some(path) => read(path)?,
        None => diagnose::with_progress(&campaign, false)?.document,
    };
    let folder = arguments.output.clone().unwrap_or_else(|| workspace().join("target/kapvik-close-loop"));
    let (plan, rovers) = match arguments.quick {
        true => (Plan::quick(arguments.seed), 1000),
        false => (Plan::medium(arguments.seed), 10_000),
    };
    // Of a seed that no plan draws its scenes from.
    let options = Options { plan, rovers, seed: arguments.seed.wrapping_add(1 << 30) };
    let closed = close(&campaign, &diagnosis, &folder, &options)?;
    println!("{}", sentence(&diagnosis));
    println!("\nRoot mean square errors on held-out runs\n\n{}", closed.forces);
    println!("\ndeclared model: {}", folder.join("declared.toml").display());
    let Some(soil) = closed.soil else {
        println!("Nothing was found that could be declared: the networks stay as they are.");
        return Ok(());
    };
    let [before, after] = &soil.effects;
    println!("\nRover network trained for\n  before  {before}\n  after   {after}");
    println!("by the same plan: {} scenes, {} epochs.", plan.scenes, plan.rover_epochs);
    println!(
        "\nErrors on {rovers} simulated rovers of each kind, on soil with the effects of after\n\n{}",
        soil.errors
    );
    println!(
        "\nEstimates on the campaign itself, whose truth is not known; medians over its runs\n\n{}",
        soil.intervals
    );
    let table = folder.join("kapvik.table");
    println!("\ntable: {}\nto fly it: kapvik run --weights {0}", table.display());
    Ok(())
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
