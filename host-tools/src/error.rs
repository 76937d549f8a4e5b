//! What can go wrong on the host, in words that a person can act on.

use std::fmt;
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
    #[error("{}:{line}:{column}: {}", path.display(), on_one_line(message))]
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

/// Text of a file, safe to print: what would break the line or command a terminal is escaped.
fn on_one_line(text: &str) -> impl fmt::Display + '_ {
    fmt::from_fn(move |line| {
        text.chars().try_for_each(|character| {
            if character.is_control() {
                write!(line, "{}", character.escape_debug())
            } else {
                write!(line, "{character}")
            }
        })
    })
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
