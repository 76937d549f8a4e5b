//! The Arm target of the compiler: from rustup, or from Debian.

use std::path::{Path, PathBuf};

use crate::error::HostError;
use crate::process::{command, find_on_path, output_of, run_with_spinner};
use crate::target_folder::target_folder;

use super::{TargetFrom, apt};

/// The target of the flight image.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// LLVM takes functions in line up to this size, in its own measure, where it would by itself up to 225, and repeats no loop's body whose
/// turns are counted at run time, nor one that would grow beyond 294 by it, nor more than eight times: a twentieth of a tick more, and 12 KB
/// of flash less, which hold networks. Constants stand beside the functions that use them.
const IMAGE_FLAGS: &str = "-Cllvm-args=-inline-threshold=75 -unroll-runtime=false -unroll-threshold=294 -unroll-max-count=8 \
    -arm-promote-constant=true";

/// Debian's compiler, its cargo, and the source of its library.
const DEBIAN_PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";

/// How the flight image is compiled.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TargetRoute {
    /// With the toolchain that also compiles the host tools; its library came ready made.
    Rustup,
    /// With Debian's compiler, which builds the library from source, and this linker.
    Debian {
        /// `rust-lld` of the host's toolchain: Debian's has none.
        linker: PathBuf,
    },
}

impl TargetRoute {
    /// `cargo build` for the target, up to where package and profile are named.
    pub fn cargo_build(&self) -> std::process::Command {
        let mut cargo = match self {
            Self::Rustup => command("cargo"),
            Self::Debian { linker } => {
                let mut cargo = command(DEBIAN_CARGO);
                cargo.env("RUSTC", DEBIAN_RUSTC).env("RUSTC_BOOTSTRAP", "1");
                cargo.env_remove("RUSTUP_TOOLCHAIN").env_remove("LD_LIBRARY_PATH");
                cargo.env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER", linker);
                cargo
            }
        };
        cargo.args(["build", "--target", TARGET]);
        if matches!(self, Self::Debian { .. }) {
            // A folder of its own: the two compilers would throw each other's work away.
            cargo.arg("-Zbuild-std=core").arg("--target-dir").arg(target_folder().join("debian"));
        }
        // The image is the same whatever flags the person has set for the host.
        cargo.env("CARGO_ENCODED_RUSTFLAGS", IMAGE_FLAGS);
        cargo
    }
}

/// The way to the target, and a line about where it came from.
pub fn find_or_install(from: Option<TargetFrom>) -> Result<(TargetRoute, String), HostError> {
    match from {
        Some(TargetFrom::Rustup) => from_rustup(),
        Some(TargetFrom::Debian) => from_debian(),
        None => from_rustup().or_else(|rustup| {
            from_debian().map_err(|debian| HostError::Failed(format!("{rustup}\nnor otherwise: {debian}")))
        }),
    }
}

fn from_rustup() -> Result<(TargetRoute, String), HostError> {
    if toolchain_has_target() {
        return Ok((TargetRoute::Rustup, format!("target: {TARGET}, found in the toolchain")));
    }
    let failed = |reason: String| {
        HostError::Failed(format!("the target {TARGET} is missing ({reason}); type: rustup target add {TARGET}"))
    };
    if find_on_path("rustup").is_none() {
        return Err(failed("there is no rustup on this machine".to_owned()));
    }
    run_with_spinner(command("rustup").args(["target", "add", TARGET]), "rustup target add")
        .map_err(|error| failed(cause(&error.to_string())))?;
    if toolchain_has_target() {
        Ok((TargetRoute::Rustup, format!("target: {TARGET}, added by rustup")))
    } else {
        Err(failed("rustup added it to another toolchain than cargo uses".to_owned()))
    }
}

/// The line that names the cause: the first that calls itself an error, else the last that says something.
fn cause(text: &str) -> String {
    let error = text.lines().find(|line| line.starts_with("error") || line.starts_with("E: "));
    let said = error.or_else(|| text.lines().rev().find(|line| !line.trim().is_empty()));
    said.unwrap_or_default().trim().to_owned()
}

/// Whether the compiler that cargo uses here has a ready-made library for the target.
fn toolchain_has_target() -> bool {
    let folder = output_of(command("rustc").args(["--print", "target-libdir", "--target", TARGET]));
    let files = folder.and_then(|folder| std::fs::read_dir(folder).ok());
    files.is_some_and(|files| files.flatten().any(|file| file.file_name().to_string_lossy().starts_with("libcore-")))
}

fn from_debian() -> Result<(TargetRoute, String), HostError> {
    let failed = |reason: String| {
        let line = apt::line_to_type(&DEBIAN_PACKAGES);
        HostError::Failed(format!("Debian's compiler for {TARGET} cannot be had ({reason}); type: {line}"))
    };
    let found = debian_compiler();
    let compiler = match &found {
        Some(version) => version.clone(),
        None => {
            apt::install(&DEBIAN_PACKAGES).map_err(|error| failed(cause(&error.to_string())))?;
            debian_compiler()
                .ok_or_else(|| failed("its compiler is too old, or its library has no source".to_owned()))?
        }
    };
    let linker = rust_lld().ok_or_else(|| {
        HostError::Failed("the toolchain has no rust-lld; type: rustup toolchain install stable".to_owned())
    })?;
    let how = if found.is_some() { "found" } else { "installed by apt-get" };
    let line = format!("target: {TARGET}, by Debian's {compiler} with the library from source, {how}");
    Ok((TargetRoute::Debian { linker }, line))
}

/// The version of Debian's compiler, where cargo and the library's source are there too and the version will do.
fn debian_compiler() -> Option<String> {
    let version = output_of(debian(DEBIAN_RUSTC).arg("--version"))?;
    output_of(debian(DEBIAN_CARGO).arg("--version"))?;
    let sysroot = output_of(debian(DEBIAN_RUSTC).args(["--print", "sysroot"]))?;
    let source = Path::new(&sysroot).join("lib/rustlib/src/rust/library/core/Cargo.toml");
    let number = version.split_whitespace().nth(1)?;
    let new_enough = release(number)? >= release(LEAST_RELEASE)?;
    (source.is_file() && new_enough).then(|| format!("rustc {number}"))
}

/// The least release of the compiler that compiles the workspace.
const LEAST_RELEASE: &str = env!("CARGO_PKG_RUST_VERSION");

/// Major and minor number of a release such as `1.96.0`.
fn release(version: &str) -> Option<(u32, u32)> {
    let mut numbers = version.split('.').map(str::parse);
    Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
}

fn debian(program: &str) -> std::process::Command {
    let mut command = command(program);
    command.env_remove("RUSTUP_TOOLCHAIN").env_remove("LD_LIBRARY_PATH");
    command
}

/// The linker that the host's toolchain carries.
fn rust_lld() -> Option<PathBuf> {
    let sysroot = output_of(command("rustc").args(["--print", "sysroot"]))?;
    let about = output_of(command("rustc").arg("-vV"))?;
    let host = about.lines().find_map(|line| line.strip_prefix("host: "))?;
    let linker = Path::new(&sysroot).join("lib/rustlib").join(host).join("bin/rust-lld");
    linker.is_file().then_some(linker)
}
