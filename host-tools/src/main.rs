//! The command line, `cargo kapvik …`.

mod output;
mod usage;

use std::process::ExitCode;

use clap::Parser;
use kapvik_host::commands::Command;
use kapvik_host::data::unfinished::remove_at_an_early_end;

/// Fits make and drop many small vectors; this allocator takes half of the system's time for them.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Soil from a rover's own wheels: the host side of the Kapvik estimator.
#[derive(Parser)]
#[command(name = "kapvik", version, about)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

fn main() -> ExitCode {
    // Whoever reads only the first lines of what is printed ends the command, as with other commands, and has no panic.
    sigpipe::reset();
    output::end_where_it_cannot_be_written();
    remove_at_an_early_end();
    let command = match CommandLine::try_parse() {
        Ok(line) => line.command,
        Err(error) => return usage::explain(&error),
    };
    match command.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("kapvik: {error}");
            ExitCode::FAILURE
        }
    }
}
