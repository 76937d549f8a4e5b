//! `kapvik test`
use clap::Args;

use crate::error::HostError;

/// Options of `kapvik test`.
#[derive(Args)]
pub struct Arguments {}

/// Runs every test.
pub fn execute(_: &Arguments) -> Result<(), HostError> {
    let mut c = crate::flight_computer::FlightComputer::start(
        crate::flight_computer::Computer::Qemu,
        crate::qemu::LogView::Everything,
    )?;
    println!("{:?}", c.boot_report()?);
    println!("{:?}", c.health()?);
    Ok(())
}
