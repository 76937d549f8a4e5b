//! `kapvik run`

use std::path::{Path, PathBuf};

use clap::Args;

use crate::data::atomic_write::write_text;
use crate::data::campaign::Campaign;
use crate::data::frame_file;
use crate::data::outputs;
use crate::data::truth_file::truth_path;
use crate::error::HostError;
use crate::flight_computer::Computer;
use crate::report::traverse::{self, Source, TraverseFindings};
use crate::report::{self, Findings, FlownNetworks};

use super::weights::{Weights, known_target_folder};

/// Options of `kapvik run`.
#[derive(Args)]
pub struct Arguments {
    /// Sensor frames (with the truth where NAME.truth.csv is beside), or a wheel campaign NAME.csv with NAME.toml beside;
    /// without, the simulated traverse that the project carries
    #[arg(value_name = "FRAMES.csv", conflicts_with = "measured")]
    input: Option<PathBuf>,
    /// The measured wheel states that the project carries, in place of a traverse
    #[arg(long)]
    measured: bool,
    /// The rover that recorded the frames [default: the assumed set K0]
    #[arg(long, value_name = "R.toml", requires = "input", conflicts_with = "measured")]
    rover: Option<PathBuf>,
    /// Where the flight library runs; both give the same bits
    #[arg(long, value_enum, default_value_t = Computer::Qemu)]
    on: Computer,
    /// The table of networks that flies, as `kapvik train` writes it [default: that of the source tree]
    #[arg(long, value_name = "WEIGHTS")]
    weights: Option<PathBuf>,
    /// Where the report goes [default: kapvik-run/report.html in the build folder of this checkout, `target`]
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
    /// Where the picture of the estimates goes, if it is wanted by itself
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
}

/// What is to be said and written of a run.
struct Told {
    terminal: String,
    flight: Vec<String>,
    page: String,
    /// None where there is nothing to make a picture of.
    picture: Option<String>,
}

/// Streams sensor frames or wheel states to the flight computer, and shows what it makes of them.
///
/// # Errors
/// Where a file is not as it should be, or the flight computer does not answer; nothing is written then.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let Arguments { input, rover, weights, picture, .. } = arguments;
    let report = arguments.report.clone().map_or_else(default_report, Ok)?;
    let [about, truth] = [input.as_ref().map(|input| input.with_extension("toml")), input.as_deref().map(truth_path)];
    let inputs = [input, rover, weights, &about, &truth].map(|path| path.as_deref());
    let outputs = [Some(report.as_path()), picture.as_deref()];
    outputs::check(&outputs, &inputs)?;
    // Which kind of file it is the header tells, and then it is read again.
    if let Some(pipe) = input.as_deref().filter(|input| outputs::is_pipe(input)) {
        return Err(HostError::Failed(format!("{}: expected a file on disk, which can be read twice", pipe.display())));
    }
    let weights = arguments.weights.as_deref().map(|path| Weights::fly(path, arguments.on)).transpose()?;
    let (on, weights) = (arguments.on, weights.as_ref());
    let told = match &arguments.input {
        None if arguments.measured => campaign(Campaign::carried()?, on, weights)?,
        None => traverse(Source::carried()?, on, weights)?,
        Some(path) if frame_file::is_one(path)? => {
            traverse(Source::recorded(path, arguments.rover.as_deref())?, on, weights)?
        }
        Some(path) => match &arguments.rover {
            None => campaign(Campaign::read(path)?, on, weights)?,
            Some(rover) => return Err(no_place_for_a_rover(path, rover)),
        },
    };
    let picture = match (picture, told.picture) {
        (Some(path), Some(picture)) => Some((path, picture)),
        (Some(_), None) => return Err(HostError::Failed("no run has an estimate to make a picture of".to_owned())),
        (None, _) => None,
    };
    outputs::tell(&[&[told.terminal], told.flight.as_slice()].concat().join("\n"), &outputs);
    write_text(&report, &told.page)?;
    outputs::tell(&format!("\nreport: {}", report.display()), &outputs);
    if let Some((path, picture)) = picture {
        write_text(path, &picture)?;
        outputs::tell(&format!("picture: {}", path.display()), &outputs);
    }
    Ok(())
}

fn traverse(source: Source, on: Computer, weights: Option<&Weights>) -> Result<Told, HostError> {
    let mut findings = TraverseFindings::gather(source, on)?;
    findings.flight.networks = weights.map(networks);
    Ok(Told {
        terminal: traverse::terminal(&findings),
        flight: report::flight_lines(&findings.flight),
        page: traverse::page(&findings),
        picture: Some(traverse::picture(&findings)),
    })
}

fn campaign(campaign: Campaign, on: Computer, weights: Option<&Weights>) -> Result<Told, HostError> {
    let mut findings = Findings::gather(campaign, weights.is_some_and(Weights::know_effects), on)?;
    findings.flight.networks = weights.map(networks);
    Ok(Told {
        terminal: report::terminal(&findings),
        flight: report::flight_lines(&findings.flight),
        page: report::page(&findings),
        picture: report::picture(&findings),
    })
}

fn networks(weights: &Weights) -> FlownNetworks {
    FlownNetworks { in_words: weights.in_words(), effects: weights.effects().to_owned() }
}

fn no_place_for_a_rover(campaign: &Path, rover: &Path) -> HostError {
    let (campaign, rover) = (campaign.display(), rover.display());
    HostError::Failed(format!(
        "{campaign} is a wheel campaign, which describes its wheel itself: --rover {rover} is for frames"
    ))
}

/// In the build folder, so that nothing appears where a person keeps files.
fn default_report() -> Result<PathBuf, HostError> {
    let folder = known_target_folder().join("kapvik-run");
    std::fs::create_dir_all(&folder).map_err(HostError::file(&folder))?;
    Ok(folder.join("report.html"))
}
