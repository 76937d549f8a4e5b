//! The flight image in QEMU: built, started, watched, and ended with whoever started it.

mod bench;
mod image;
mod log;
mod machine;
mod memory;

pub use bench::{KernelCost, Survival, TargetBench};
pub use image::{Binary, Image};
pub use log::{LogLine, LogView};
pub use machine::{Clock, Ended, Machine};
pub use memory::MemoryUse;
