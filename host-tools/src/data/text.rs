//! Text files, and where in them something stands.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::HostError;

/// What is said of a byte that is none.
pub(super) const NOT_UTF_8: &str = "this byte is not UTF-8; expected text in UTF-8";

/// A text file in UTF-8, whole.
#[derive(Debug, Clone)]
pub struct TextFile {
    path: PathBuf,
    text: String,
}

impl TextFile {
    /// Text that is already in memory, under the name of a file.
    pub fn new(path: &Path, text: &str) -> Self {
        Self { path: path.to_path_buf(), text: text.trim_start_matches('\u{feff}').to_owned() }
    }

    /// Reads a file; a byte-order mark in front is passed over.
    ///
    /// # Errors
    /// Where the file cannot be read, or holds a byte that is not UTF-8.
    pub fn read(path: &Path) -> Result<Self, HostError> {
        let bytes = fs::read(path).map_err(HostError::file(path))?;
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self { path: path.to_path_buf(), text: text.trim_start_matches('\u{feff}').to_owned() }),
            Err(error) => {
                let valid = String::from_utf8_lossy(&error.as_bytes()[..error.utf8_error().valid_up_to()]);
                let file = Self { path: path.to_path_buf(), text: valid.into_owned() };
                Err(file.error_at(file.text.len(), NOT_UTF_8))
            }
        }
    }

    /// Where the file is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is in it.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// An error at the character that starts `offset` bytes into the text.
    pub fn error_at(&self, offset: usize, message: impl Into<String>) -> HostError {
        let before = self.text.get(..offset).unwrap_or(&self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        HostError::Input {
            path: self.path.clone(),
            line: 1 + before.matches('\n').count() as u64,
            column: 1 + before[line_start..].chars().count() as u64,
            message: message.into(),
        }
    }
}
