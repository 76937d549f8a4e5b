//! What the host does around the flight library: data files, training, identification, the image in QEMU, reports.

pub mod bench;
pub mod close_loop;
pub mod commands;
pub mod compare;
pub mod data;
pub mod diagnose;
mod digits;
pub mod doubt;
pub mod error;
pub mod flight_computer;
pub mod identifiability;
pub mod identify;
pub mod limit;
pub mod parameter;
pub mod prior;
pub mod process;
pub mod progress;
pub mod qemu;
pub mod reference;
pub mod replay;
pub mod report;
pub mod setup;
pub mod simulate;
pub mod soil_catalogue;
pub mod statistics;
pub mod train;
pub mod trial;
