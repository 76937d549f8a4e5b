//! What flight functions cost on the target: runs the measuring image and reads what it prints.

use std::time::Duration;

use crate::error::HostError;
use crate::progress::spinner;
use crate::setup::Toolchain;

use super::{Binary, Clock, Image, LogView, Machine};

/// What one call of a function costs on the target.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KernelCost {
    /// The function.
    pub name: String,
    /// Instructions, the mean over its inputs.
    pub instructions: u64,
    /// Stack below the caller, bytes.
    pub stack_bytes: u32,
}

/// How a filter came through a fault.
#[derive(Debug, Clone, PartialEq)]
pub struct Survival {
    /// The filter.
    pub name: String,
    /// The fault.
    pub fault: String,
    /// Steps after the fault that gave finite numbers and did not fail, of so many.
    pub good: (u64, u64),
    /// Whether the filter said that something was wrong.
    pub told: bool,
    /// The greatest error after the fault and the root mean square error at the end, in standard deviations of the noise.
    pub errors: (f64, f64),
}

/// What a measuring image found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TargetBench {
    /// A loop of so many instructions took so many ticks of the board's 25 MHz clock.
    pub calibration: (u64, u64),
    /// The functions measured.
    pub kernels: Vec<KernelCost>,
    /// Name and checksum of each fingerprint of the arithmetic.
    pub fingerprints: Vec<(String, u32)>,
    /// Name and size of objects that are compared, bytes.
    pub objects: Vec<(String, u32)>,
    /// How filters came through faults.
    pub survivals: Vec<Survival>,
}

/// Instructions to a tick, as the image assumes: a nanosecond each, at 25 MHz.
const INSTRUCTIONS_PER_TICK: f64 = 40.0;
/// How far the calibration may be from that.
const CALIBRATION_TOLERANCE: f64 = 1e-3;

impl TargetBench {
    /// Builds the measuring images, and runs them to their ends one after the other.
    ///
    /// # Errors
    /// Where it does not build, does not end well, or prints what is not understood.
    pub fn run(toolchain: &Toolchain, patience: Duration) -> Result<Self, HostError> {
        let mut bench = Self::of(toolchain, Binary::Bench, patience)?;
        for binary in [Binary::Tick, Binary::Identify, Binary::Map] {
            let more = Self::of(toolchain, binary, patience)?;
            bench.kernels.extend(more.kernels);
            bench.fingerprints.extend(more.fingerprints);
        }
        Ok(bench)
    }

    /// Builds a measuring image and runs it to its end.
    ///
    /// # Errors
    /// As [`TargetBench::run`].
    pub fn of(toolchain: &Toolchain, binary: Binary, patience: Duration) -> Result<Self, HostError> {
        let image = Image::build(toolchain, binary)?;
        let spinner = spinner("measure in QEMU");
        let ended = Machine::start(toolchain, &image, Clock::Instructions, LogView::Warnings)?.wait(patience)?;
        spinner.finish_and_clear();
        if ended.code != Some(0) {
            return Err(HostError::Failed(format!("the measuring image ended with {:?}: {ended:?}", ended.code)));
        }
        let mut bench = Self::default();
        for line in ended.printed.lines() {
            bench.take(line).ok_or_else(|| HostError::Failed(format!("the measuring image printed: {line}")))?;
        }
        bench.check_calibration()
    }

    /// Reads one line; `None` where it is none of the image's.
    fn take(&mut self, line: &str) -> Option<()> {
        match line.split(' ').collect::<Vec<_>>().as_slice() {
            ["calibration", instructions, ticks] => {
                self.calibration = (instructions.parse().ok()?, ticks.parse().ok()?)
            }
            ["kernel", name, instructions, stack] => self.kernels.push(KernelCost {
                name: (*name).to_owned(),
                instructions: instructions.parse().ok()?,
                stack_bytes: stack.parse().ok()?,
            }),
            ["fingerprint", name, checksum] => {
                self.fingerprints.push(((*name).to_owned(), u32::from_str_radix(checksum, 16).ok()?));
            }
            ["object", name, bytes] => self.objects.push(((*name).to_owned(), bytes.parse().ok()?)),
            ["survival", name, fault, good, steps, told, peak, end] => self.survivals.push(Survival {
                name: (*name).to_owned(),
                fault: (*fault).to_owned(),
                good: (good.parse().ok()?, steps.parse().ok()?),
                told: told.parse().ok()?,
                errors: (peak.parse().ok()?, end.parse().ok()?),
            }),
            _ => return None,
        }
        Some(())
    }

    fn check_calibration(self) -> Result<Self, HostError> {
        let (instructions, ticks) = self.calibration;
        let ratio = instructions as f64 / ticks as f64 / INSTRUCTIONS_PER_TICK;
        if (ratio - 1.0).abs() < CALIBRATION_TOLERANCE {
            Ok(self)
        } else {
            Err(HostError::Failed(format!(
                "the counter does not count instructions: {instructions} took {ticks} ticks"
            )))
        }
    }
}
