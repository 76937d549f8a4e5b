//! The images that run on the board.

use std::path::{Path, PathBuf};

use crate::error::HostError;
use crate::process::{built_executable, run_with_spinner, workspace};
use crate::setup::Toolchain;
use crate::target_folder::target_folder;

/// A program for the board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binary {
    /// The flight image.
    Flight,
    /// Counts instructions and stack, and fingerprints the numerics.
    Bench,
    /// Counts the instructions of a whole tick.
    Tick,
    /// Counts the instructions of the methods of the literature.
    Identify,
    /// Counts the instructions of the maximum a posteriori.
    Map,
    /// The filter alone.
    Filter,
    /// The filter beside those of others: a package of its own, which only the comparison builds.
    Contenders,
    /// Panics on purpose.
    Fault,
}

impl Binary {
    fn name(self) -> &'static str {
        match self {
            Self::Flight => "kapvik_an386",
            Self::Bench => "bench_an386",
            Self::Tick => "tick_an386",
            Self::Identify => "identify_an386",
            Self::Map => "map_an386",
            Self::Filter => "filter_an386",
            Self::Contenders => "contenders_an386",
            Self::Fault => "fault_an386",
        }
    }
}

/// A program for the board, compiled and linked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    elf: PathBuf,
}

impl Image {
    /// Compiles and links an image.
    ///
    /// # Errors
    /// Where that fails; the text ends with what the compiler said.
    pub fn build(toolchain: &Toolchain, binary: Binary) -> Result<Self, HostError> {
        let mut cargo = toolchain.target.cargo_build();
        cargo.args(["--profile", "flight"]);
        if binary == Binary::Contenders {
            cargo.arg("--manifest-path").arg(workspace().join("tests/contenders/Cargo.toml"));
            cargo.env("CARGO_TARGET_DIR", target_folder().join("contenders"));
            // What suits the flight image would slow down what it is compared with.
            cargo.env("CARGO_ENCODED_RUSTFLAGS", "");
        } else {
            cargo.args(["--package", "kapvik-firmware", "--features", "board-an386"]);
        }
        cargo.args(["--bin", binary.name(), "--message-format", "json-render-diagnostics"]);
        let messages = run_with_spinner(&mut cargo, &format!("build {}", binary.name()))?;
        let elf = built_executable(&messages)
            .ok_or_else(|| HostError::Failed(format!("build {}: cargo named no executable", binary.name())))?;
        Ok(Self { elf })
    }

    /// The image's ELF file.
    pub fn path(&self) -> &Path {
        &self.elf
    }

    /// The bytes of the ELF file.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn read(&self) -> Result<Vec<u8>, HostError> {
        std::fs::read(&self.elf).map_err(HostError::file(&self.elf))
    }
}
