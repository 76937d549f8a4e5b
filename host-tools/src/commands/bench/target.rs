//! `kapvik bench target`

use std::time::Duration;

use crate::error::HostError;
use crate::flight_computer::FlightComputer;
use crate::qemu::{Binary, Image, LogView, MemoryUse, TargetBench};
use crate::setup;

/// How long the measuring image may take: far longer than it does.
const PATIENCE: Duration = Duration::from_secs(300);

/// Prints what the flight functions and the flight image cost on the target.
pub fn execute() -> Result<(), HostError> {
    let toolchain = setup::prepare(None)?;
    let bench = TargetBench::run(&toolchain, PATIENCE)?;
    let (instructions, ticks) = bench.calibration;
    println!("counter: a loop of {instructions} instructions took {ticks} ticks of 40");
    println!("\n{:<20} {:>14} {:>12}", "function", "instructions", "stack, bytes");
    for kernel in &bench.kernels {
        println!("{:<20} {:>14} {:>12}", kernel.name, kernel.instructions, kernel.stack_bytes);
    }
    let image = Image::build(&toolchain, Binary::Flight)?;
    let memory = MemoryUse::of(&image)?;
    let stack = FlightComputer::in_qemu(&toolchain, &image, LogView::Warnings)?.health()?.stack_high_water_bytes;
    println!("\n{:<20} {:>14}", "flight image", "bytes");
    println!("{:<20} {:>14}", "flash", memory.flash_bytes);
    println!("{:<20} {:>14}", "static RAM", memory.static_ram_bytes);
    let stack = stack.map_or_else(|| "unknown".to_owned(), |bytes| bytes.to_string());
    println!("{:<20} {stack:>14}", "stack, before a query");
    Ok(())
}
