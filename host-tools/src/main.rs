//! The command line, `cargo kapvik …`.

use std::process::ExitCode;

use clap::Parser;
use kapvik_host::commands::Command;

/// Soil from a rover's own wheels: the host side of the Kapvik estimator.
#[derive(Parser)]
#[command(name = "kapvik", version, about)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    match CommandLine::parse().command.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("kapvik: {error}");
            ExitCode::FAILURE
        }
    }
}
