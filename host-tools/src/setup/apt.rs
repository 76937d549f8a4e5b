//! Debian's package manager.

use std::io::IsTerminal;
use std::process::{Command, Stdio};

use crate::error::HostError;
use crate::process::{command, find_on_path, output_of, run_with_spinner};

/// What a person would type to install the packages.
pub fn line_to_type(packages: &[&str]) -> String {
    format!("sudo apt-get update && sudo apt-get install --no-install-recommends {}", packages.join(" "))
}

/// Installs packages, as root or through sudo.
///
/// # Errors
/// Where this is no Debian, or the packages cannot be had.
pub fn install(packages: &[&str]) -> Result<(), HostError> {
    if find_on_path("apt-get").is_none() {
        return Err(HostError::Failed("there is no apt-get on this machine".to_owned()));
    }
    let names = packages.join(", ");
    run_with_spinner(as_root()?.args(["apt-get", "update", "--quiet"]), "update the list of packages")?;
    let mut install = as_root()?;
    install.args(["apt-get", "install", "--yes", "--quiet", "--no-install-recommends"]).args(packages);
    run_with_spinner(&mut install, &format!("install {names}"))?;
    Ok(())
}

/// `env …` or `sudo env …`; a password is asked for where there is somebody to ask.
fn as_root() -> Result<Command, HostError> {
    const QUIETLY: &str = "DEBIAN_FRONTEND=noninteractive";
    if output_of(command("id").arg("-u")).as_deref() == Some("0") {
        let mut root = command("env");
        root.arg(QUIETLY);
        return Ok(root);
    }
    if find_on_path("sudo").is_none() {
        return Err(HostError::Failed("this needs root, and there is no sudo".to_owned()));
    }
    if std::io::stdin().is_terminal() {
        // Asked here, before the spinner takes the line; sudo then remembers it.
        let _ = command("sudo").arg("--validate").stdin(Stdio::inherit()).status();
    }
    let mut root = command("sudo");
    root.args(["--non-interactive", "env", QUIETLY]);
    Ok(root)
}
