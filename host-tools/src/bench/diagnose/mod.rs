//! How well a diagnosis finds what nobody declared: campaigns drawn from a seed, with one undeclared effect, two, one that
//! is in no list, or none.

mod answer;
mod campaign_draw;
mod chance;
mod instruments;
mod knowledge;
mod layout;
mod oracle;
mod overlay;
mod refit;
mod score;
mod share;
mod shared_errors;
mod site;
mod state;
mod stress;
#[cfg(test)]
mod tests;
mod trial;
mod undeclared;
mod unlisted;
mod variants;
mod wants;
mod world;
mod write;

use std::path::PathBuf;

use clap::Args;

pub use answer::{Answer, Named, Structure};
pub use trial::Diagnoser;

use crate::error::HostError;
pub use shared_errors::SharedErrors;
use trial::{Counts, Plan, diagnose_all, draw_all, plan, save_all};

/// Most campaigns of a kind.
const MOST: u64 = 100_000;

/// Options of `kapvik bench diagnose`.
#[derive(Debug, Clone, Args)]
pub struct DiagnoseArguments {
    /// Seed of the campaigns; development has used those below 1000, and 4100, 4200 and 4300
    #[arg(long, default_value_t = 2026)]
    pub seed: u64,
    /// Campaigns with each undeclared effect
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u64).range(..=MOST))]
    pub per_effect: u64,
    /// Campaigns with nothing undeclared
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u64).range(..=MOST))]
    pub clean: u64,
    /// Campaigns with two undeclared effects
    #[arg(long, default_value_t = 30, value_parser = clap::value_parser!(u64).range(..=MOST))]
    pub pairs: u64,
    /// Campaigns with an effect that is in no list
    #[arg(long, default_value_t = 40, value_parser = clap::value_parser!(u64).range(..=MOST))]
    pub unlisted: u64,
    /// What the errors of a run's rows have in common
    #[arg(long, value_enum, default_value_t)]
    pub errors: SharedErrors,
    /// Only campaigns in which this effect is
    #[arg(long, value_name = "ID", value_parser = clap::builder::PossibleValuesParser::new(undeclared::effect_ids()))]
    pub only: Option<String>,
    /// Also tell of each pair of effects whether one who is told of both could see them
    #[arg(long)]
    pub oracle: bool,
    /// Also write the campaigns here, each with NAME.truth.txt
    #[arg(long, value_name = "DIR")]
    pub write: Option<PathBuf>,
}

/// Draws the campaigns, has each diagnosed, and prints how often that was right.
///
/// # Errors
/// Where the campaigns cannot be written.
pub fn run(arguments: &DiagnoseArguments, diagnose: &Diagnoser<'_>) -> Result<(), HostError> {
    let counts = Counts {
        per_effect: arguments.per_effect,
        clean: arguments.clean,
        pairs: arguments.pairs,
        unlisted: arguments.unlisted,
    };
    let plan: Plan = plan(&counts, arguments.seed, arguments.only.as_deref());
    let (mut drawn, mut undrawn) = (Vec::new(), Vec::new());
    for draw in draw_all(&plan, arguments.errors, arguments.seed) {
        match draw {
            Ok(campaign) => drawn.push(campaign),
            Err(subject) => undrawn.push(format!("{subject}")),
        }
    }
    println!("seed {}", arguments.seed);
    if !undrawn.is_empty() {
        println!("no campaign found in which these show: {}", undrawn.join("; "));
    }
    if let Some(folder) = &arguments.write {
        save_all(&drawn, folder)?;
    }
    let trials = diagnose_all(&drawn, diagnose);
    score::print(&trials);
    if arguments.oracle {
        oracle::print(&drawn, &trials);
    }
    Ok(())
}
