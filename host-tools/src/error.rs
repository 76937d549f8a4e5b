//! What can go wrong on the host, in words that a person can act on.

use std::path::{Path, PathBuf};

use thiserror::Error;

/// An error of a host command. Its text is the one line that the command prints.
#[derive(Debug, Error)]
pub enum HostError {
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A place in a file does not hold what was expected.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Input {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        /// Column, from 1: of the character in free text, of the field in a table.
        column: u64,
        /// What was found and what was expected.
        message: String,
    },
    /// A tool or the image did not do what it was asked.
    #[error("{0}")]
    Failed(String),
}

impl HostError {
    /// A file error at `path`, for `map_err`.
    pub fn file(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::File { path: path.to_path_buf(), source }
    }
}
