//! Where cargo puts what it makes.

use std::path::PathBuf;

use crate::process::workspace;

/// The target folder of the workspace: cargo's own, or where the person has sent it.
pub fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace().join("target"), |folder| workspace().join(folder))
}
