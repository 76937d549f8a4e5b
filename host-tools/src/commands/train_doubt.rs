//! `kapvik train-doubt`: trains the network that tells how far the estimators err, and writes it as Rust source.

use std::path::PathBuf;

use clap::{Args, value_parser};

use crate::data::atomic_write::write_text;
use crate::data::outputs;
use crate::doubt::drives::{Plan, drive_all};
use crate::doubt::emit::{Provenance, source};
use crate::doubt::held_out::{BeforeAfter, tables};
use crate::doubt::training::train;
use crate::error::HostError;
use crate::progress::with_progress;

/// Options of `kapvik train-doubt`.
#[derive(Args)]
pub struct Arguments {
    /// The source; `firmware/src/estimator/doubt/frozen.rs` is the one that the next build freezes in
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Seed of the first drive, from which all others follow; the same seed gives the same bytes
    #[arg(long, default_value_t = 20_000)]
    seed: u32,
    /// Drives of each scenario on uneven ground; there are twice as many of each on plane ground, some more have other noise, sensors that
    /// fail or effects of the soil, and some are held out
    #[arg(long, default_value_t = 200, value_parser = value_parser!(u32).range(1..=10_000))]
    drives: u32,
}

/// Drives, trains, prints how the network does on what was held out, writes it.
///
/// # Errors
/// Where no drive gave anything, the network cannot fly, or the file cannot be written.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let outputs = [Some(arguments.output.as_path())];
    outputs::check(&outputs, &[])?;
    let plan = Plan { seed: arguments.seed, drives: arguments.drives };
    let mut training = with_progress("drives", |bar| drive_all(&plan.training(), bar));
    let held_out = plan.held_out().map(|journeys| with_progress("held-out drives", |bar| drive_all(&journeys, bar)));
    let rows = training.known();
    if rows == 0 {
        return Err(HostError::Failed("no drive gave anything to learn from: expected another seed".to_owned()));
    }
    let driven = format!("{} drives, {rows} rows; {} drives failed", training.drives, training.failed);
    outputs::tell(&driven, &outputs);
    let network = with_progress("training", |bar| train(&mut training.sides, plan.seed, bar));
    if !network.cannot_overflow() {
        return Err(HostError::Failed("the network has diverged: its sums can overflow 32 bits".to_owned()));
    }
    let sets = held_out.each_ref().map(|driven| BeforeAfter::of(&driven.sides, &network));
    outputs::tell(&format!("\n{}", tables(&held_out, &sets)), &outputs);
    let provenance = Provenance { plan: &plan, held_out: &BeforeAfter::total(&sets) };
    write_text(&arguments.output, &source(&network, &provenance))?;
    Ok(())
}
