//! `kapvik run`

use std::path::PathBuf;

use clap::Args;

use crate::data::atomic_write::write_text;
use crate::data::campaign::Campaign;
use crate::error::HostError;
use crate::flight_computer::Computer;
use crate::process::workspace;
use crate::report::{self, Findings};

/// Options of `kapvik run`.
#[derive(Args)]
pub struct Arguments {
    /// A wheel campaign NAME.csv, with NAME.toml beside it; without one, the measured figures that the project carries
    #[arg(value_name = "CAMPAIGN.csv")]
    campaign: Option<PathBuf>,
    /// Where the flight library runs; both give the same bits
    #[arg(long, value_enum, default_value_t = Computer::Qemu)]
    on: Computer,
    /// Where the report goes [default: target/kapvik-run/report.html]
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
    /// Where the picture of the estimates goes, if it is wanted by itself
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
}

/// Streams wheel states to the flight computer, and shows what it makes of them.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let campaign = match &arguments.campaign {
        Some(path) => Campaign::read(path)?,
        None => Campaign::carried()?,
    };
    let findings = Findings::gather(campaign, arguments.on)?;
    println!("{}", report::terminal(&findings));
    for line in report::flight_lines(&findings.flight) {
        println!("{line}");
    }
    let path = match &arguments.report {
        Some(path) => path.clone(),
        None => default_report()?,
    };
    write_text(&path, &report::page(&findings))?;
    println!("\nreport: {}", path.display());
    if let Some(path) = &arguments.picture {
        let picture = report::picture(&findings)
            .ok_or_else(|| HostError::Failed("no run has an estimate to make a picture of".to_owned()))?;
        write_text(path, &picture)?;
        println!("picture: {}", path.display());
    }
    Ok(())
}

/// In the build folder, so that nothing appears where a person keeps files.
fn default_report() -> Result<PathBuf, HostError> {
    let folder = workspace().join("target/kapvik-run");
    std::fs::create_dir_all(&folder).map_err(HostError::file(&folder))?;
    Ok(folder.join("report.html"))
}
