//! The command `kapvik`.

use std::process::Command;

/// The command as it is built for the tests, to be told what to do and where.
pub fn kapvik() -> Command {
    Command::new(env!("CARGO_BIN_EXE_kapvik"))
}
