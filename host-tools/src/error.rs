//! What can go wrong on the host, in words that a person can act on.

use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::printable::on_one_line;

/// An error of a host command. Its text is the one line that the command prints.
#[derive(Debug, Error)]
pub enum HostError {
    /// A file could not be read or written.
    #[error("{}: {source}", on_one_line(&path.to_string_lossy()))]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A place in a file does not hold what was expected.
    #[error("{}:{line}:{column}: {}", on_one_line(&path.to_string_lossy()), on_one_line(message))]
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

#[cfg(test)]
mod tests {
    use super::HostError;

    #[test]
    fn whatever_a_file_holds_its_error_is_one_line() {
        let message = "`a\nb\0\u{1b}[31mµ`: expected a finite number".to_owned();
        let error = HostError::Input { path: "a.csv".into(), line: 2, column: 3, message };
        assert_eq!(error.to_string(), r"a.csv:2:3: `a\nb\0\u{1b}[31mµ`: expected a finite number");
    }
}
