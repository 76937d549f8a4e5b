//! QEMU for the Arm target.

use std::path::PathBuf;

use crate::error::HostError;
use crate::process::{command, find_on_path, output_of};

use super::apt;

const PROGRAM: &str = "qemu-system-arm";

/// The emulator and a line about where it came from.
pub fn find_or_install() -> Result<(PathBuf, String), HostError> {
    if let Some(path) = find_on_path(PROGRAM) {
        let line = format!("QEMU: {}, found", version(&path));
        return Ok((path, line));
    }
    let failed = |reason: String| {
        HostError::Failed(format!("QEMU for Arm is missing ({reason}); type: {}", apt::line_to_type(&[PROGRAM])))
    };
    apt::install(&[PROGRAM]).map_err(|error| failed(error.to_string()))?;
    let path = find_on_path(PROGRAM).ok_or_else(|| failed("installed, but not on the PATH".to_owned()))?;
    let line = format!("QEMU: {}, installed by apt-get", version(&path));
    Ok((path, line))
}

fn version(path: &PathBuf) -> String {
    let text = output_of(command(path).arg("--version")).unwrap_or_default();
    text.lines().next().unwrap_or(PROGRAM).to_owned()
}
