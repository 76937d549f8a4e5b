//! The fault catalogue: every fault of every sensor, one at a time, in the middle of simulated drives.

mod case;
mod catalogue;
mod deviations;
mod drive;

pub use case::{Case, SENSOR_FAILURES};
pub use catalogue::{Catalogue, catalogue};
pub use deviations::{Deviations, Excess};
pub use drive::{ALLOWED_FRAMES, FAULT_S, FaultDrive, Outcome, WATCHED_FRAMES};
