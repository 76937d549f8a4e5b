//! What the machine needs beside cargo: the flight image's target and QEMU. Each is found, or installed.

mod apt;
mod emulator;
mod target;

use std::path::PathBuf;

use clap::ValueEnum;

use crate::error::HostError;

pub use target::{TARGET, TargetRoute};

/// Where the Arm target comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TargetFrom {
    /// `rustup target add`
    Rustup,
    /// Debian's compiler with the source of the library, which is built along with the image
    Debian,
}

/// What the flight image is built and run with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Toolchain {
    /// How the image is compiled.
    pub target: TargetRoute,
    /// The emulator.
    pub qemu: PathBuf,
}

/// The environment variable that forces a [`TargetFrom`] where no option does.
pub const TARGET_FROM: &str = "KAPVIK_TARGET_FROM";

/// Finds or installs what the flight image needs, and says in one line each what it found or did.
///
/// # Errors
/// Where something cannot be had; the text says what a person should type.
pub fn prepare(from: Option<TargetFrom>) -> Result<Toolchain, HostError> {
    let (toolchain, found) = find_or_install(from)?;
    for line in found {
        eprintln!("{line}");
    }
    Ok(toolchain)
}

/// As [`prepare`], without a word where nothing had to be done.
///
/// # Errors
/// As [`prepare`].
pub fn prepare_quietly() -> Result<Toolchain, HostError> {
    Ok(find_or_install(None)?.0)
}

fn find_or_install(from: Option<TargetFrom>) -> Result<(Toolchain, Vec<String>), HostError> {
    let from = from.map_or_else(from_environment, |from| Ok(Some(from)))?;
    let (target, target_line) = target::find_or_install(from)?;
    let (qemu, qemu_line) = emulator::find_or_install()?;
    Ok((Toolchain { target, qemu }, vec![target_line, qemu_line]))
}

fn from_environment() -> Result<Option<TargetFrom>, HostError> {
    match std::env::var(TARGET_FROM) {
        Err(_) => Ok(None),
        Ok(text) if text.is_empty() => Ok(None),
        Ok(text) => TargetFrom::from_str(&text, true)
            .map(Some)
            .map_err(|_| HostError::Failed(format!("{TARGET_FROM}={text}: expected rustup or debian"))),
    }
}
