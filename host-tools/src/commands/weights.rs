//! `--weights`: another table than the one in the source tree flies.
//!
//! Tables are frozen in when a program is built. So the flight image is built with the table, and where the flight library
//! runs in this process, this program is; either in a folder of its own. Then this process becomes that program.

use std::ffi::OsString;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use kapvik_firmware::frozen;
use kapvik_table_file::{TableFile, checksum};

use crate::error::HostError;
use crate::flight_computer::Computer;
use crate::process::{built_executable, command, run_with_spinner};
use crate::target_folder::target_folder;
use crate::train::emit::EFFECTS_NOTE;
use crate::train::world::World;

/// What the build script takes a table from.
const TABLE: &str = "KAPVIK_WEIGHTS";
/// Set in a process that another one has become, so that none waits for itself: the target folder of that one.
const HANDED_OVER: &str = "KAPVIK_HANDED_OVER";

/// A table that was asked for, and that flies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Weights {
    path: PathBuf,
    effects: String,
}

impl Weights {
    /// Which effects its networks were trained with.
    pub fn effects(&self) -> &str {
        &self.effects
    }

    /// Whether they were trained with any.
    pub fn know_effects(&self) -> bool {
        self.effects != World::seed().to_string()
    }

    /// The table and its effects, in words.
    pub fn in_words(&self) -> String {
        format!("{}, trained with {}", self.path.display(), self.effects)
    }

    /// Makes the table at `path` the one that flies. Where it is not, this process becomes one that flies it, and this
    /// function does not return.
    ///
    /// # Errors
    /// Where the file is not a whole table, or no program can be built with it.
    pub fn fly(path: &Path, on: Computer) -> Result<Self, HostError> {
        let bytes = std::fs::read(path).map_err(HostError::file(path))?;
        let not_a_table = |error| HostError::Failed(format!("{}: {error}", path.display()));
        let file = TableFile::parse(&bytes).map_err(not_a_table)?;
        let path = path.canonicalize().map_err(HostError::file(path))?;
        let ready = match on {
            Computer::Host => frozen::FILE_CRC == Some(checksum(&bytes)),
            Computer::Qemu => std::env::var_os(TABLE).is_some_and(|table| Path::new(&table) == path),
        };
        if ready {
            let effects = file.note(EFFECTS_NOTE).unwrap_or("effects that it does not name").to_owned();
            return Ok(Self { path, effects });
        }
        if std::env::var_os(HANDED_OVER).is_some() {
            return Err(HostError::Failed(format!("{}: another table than this was frozen in", path.display())));
        }
        Err(hand_over(&path, on))
    }
}

/// The target folder that a person knows of, whatever folder of its own a table is built in.
pub fn known_target_folder() -> PathBuf {
    std::env::var_os(HANDED_OVER).map_or_else(target_folder, PathBuf::from)
}

/// Becomes the program that flies the table; comes back with an error only.
fn hand_over(table: &Path, on: Computer) -> HostError {
    let folder = build_folder();
    let program = match on {
        Computer::Host => build(table, &folder),
        Computer::Qemu => std::env::current_exe().map_err(|error| HostError::Failed(format!("this program: {error}"))),
    };
    let program = match program {
        Ok(program) => program,
        Err(error) => return error,
    };
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    let mut next = Command::new(&program);
    next.args(arguments).env(TABLE, table).env("CARGO_TARGET_DIR", folder).env(HANDED_OVER, target_folder());
    HostError::file(&program)(next.exec())
}

/// This program with the table frozen in.
fn build(table: &Path, folder: &Path) -> Result<PathBuf, HostError> {
    let mut cargo = command("cargo");
    cargo.args(["build", "--release", "--package", "kapvik-host-tools", "--bin", "kapvik"]);
    cargo.args(["--message-format", "json-render-diagnostics"]).env(TABLE, table).env("CARGO_TARGET_DIR", folder);
    let what = format!("build kapvik with {}", table.display());
    let messages = run_with_spinner(&mut cargo, &what)?;
    built_executable(&messages).ok_or_else(|| HostError::Failed(format!("{what}: cargo named no executable")))
}

/// A folder of its own, so that what was built with the table of the source tree stays.
fn build_folder() -> PathBuf {
    target_folder().join("weights")
}
