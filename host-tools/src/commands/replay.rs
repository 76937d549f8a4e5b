//! `kapvik replay`

use std::path::PathBuf;

use clap::Args;

use crate::data::atomic_write::write_atomically;
use crate::data::outputs;
use crate::error::HostError;
use crate::flight_computer::{Computer, FlightComputer};
use crate::qemu::LogView;
use crate::replay::{EstimateWriter, Recording, lines, replay};
use crate::report::link_in_words;

use super::weights::Weights;

/// Options of `kapvik replay`.
#[derive(Args)]
pub struct Arguments {
    /// Sensor frames, in the order of time
    #[arg(value_name = "FRAMES.csv")]
    frames: PathBuf,
    /// Where the estimates go
    #[arg(short, long, value_name = "EST.csv")]
    output: PathBuf,
    /// The rover's dimensions and noise [default: the assumed set K0]
    #[arg(long, value_name = "R.toml")]
    rover: Option<PathBuf>,
    /// Where the flight library runs; both give the same bits
    #[arg(long, value_enum, default_value_t = Computer::Host)]
    on: Computer,
    /// The table of networks that flies, as `kapvik train` writes it [default: that of the source tree]
    #[arg(long, value_name = "WEIGHTS")]
    weights: Option<PathBuf>,
}

/// Replays a recording.
///
/// # Errors
/// Where a file is not as it should be, or the flight computer does not answer; nothing is written then.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let Arguments { frames, output, rover, weights, .. } = arguments;
    let outputs = [Some(output.as_path())];
    outputs::check(&outputs, &[Some(frames), rover.as_deref(), weights.as_deref()])?;
    let weights = arguments.weights.as_deref().map(|path| Weights::fly(path, arguments.on)).transpose()?;
    let recording = Recording::open(&arguments.frames, arguments.rover.as_deref())?;
    let rover = recording.rover.map(|value| value as f32);
    let remarks = recording.remarks();
    let mut computer = FlightComputer::start(arguments.on, LogView::Nothing)?;
    let mut outcome = None;
    write_atomically(&arguments.output, |out| {
        let file = |error| HostError::file(&arguments.output)(error);
        let mut writer = EstimateWriter::new(out).map_err(file)?;
        let take = |estimate: &_| writer.write(estimate).map_err(file);
        outcome = Some(replay(&mut computer, &rover, recording.frames, take)?);
        Ok(())
    })?;
    if let Some(outcome) = &outcome {
        let networks = weights.map(|weights| format!("networks: {}", weights.in_words()));
        let link = (arguments.on == Computer::Qemu).then(|| format!("link: {}", link_in_words(&outcome.health)));
        let told = networks.into_iter().chain(remarks.lines()).chain(lines(outcome)).chain(link);
        outputs::tell(&told.collect::<Vec<_>>().join("\n"), &outputs);
    }
    Ok(())
}
