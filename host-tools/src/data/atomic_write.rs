//! Output that is there whole or not at all.

use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::Builder;

use super::outputs::is_standard_output;
use super::unfinished::Unfinished;
use crate::error::HostError;

/// Writes a file beside its place and then renames it there, so that an error on the way leaves what was there before.
/// A path that is not a regular file (a terminal, a pipe) is written to directly.
///
/// # Errors
/// Those of `write`, and where the file system refuses.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), HostError>,
) -> Result<(), HostError> {
    let failed = |source| HostError::File { path: path.to_path_buf(), source };
    // It may lead to a file that others write to as well: that one goes on.
    if is_standard_output(path) {
        let mut out = BufWriter::new(io::stdout().lock());
        write(&mut out)?;
        return out.flush().map_err(failed);
    }
    let there = fs::metadata(path).ok();
    if there.as_ref().is_some_and(|metadata| !metadata.is_file() && !metadata.is_dir()) {
        let mut out = BufWriter::new(File::options().write(true).open(path).map_err(failed)?);
        write(&mut out)?;
        return out.flush().map_err(failed);
    }
    // A link stays a link: what it points to is replaced, or made.
    let target = match fs::read_link(path) {
        _ if there.is_some() => path.canonicalize().map_err(failed)?,
        Ok(to) => path.parent().unwrap_or(Path::new("")).join(to),
        Err(_) => path.to_path_buf(),
    };
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = Builder::new();
    if let Some(permissions) = there.map(|metadata| metadata.permissions()).or_else(of_a_new_file) {
        builder.permissions(permissions);
    }
    let mut file = builder.tempfile_in(folder).map_err(failed)?;
    let _unfinished = Unfinished::new(file.path());
    let mut out = BufWriter::new(file.as_file_mut());
    write(&mut out)?;
    out.flush().map_err(failed)?;
    drop(out);
    // Before the name leads to it: a power cut leaves what was there, or this.
    file.as_file().sync_all().map_err(failed)?;
    file.persist(&target).map_err(|error| failed(error.error))?;
    Ok(())
}

/// Writes a text the same way.
///
/// # Errors
/// Where the file system refuses.
pub fn write_text(path: &Path, text: &str) -> Result<(), HostError> {
    write_atomically(path, |out| out.write_all(text.as_bytes()).map_err(HostError::file(path)))
}

/// Writes JSON for people and programs the same way.
///
/// # Errors
/// Where the file system refuses.
pub fn write_json(path: &Path, document: &impl serde::Serialize) -> Result<(), HostError> {
    write_atomically(path, |out| {
        let written = serde_json::to_writer_pretty(&mut *out, document).map_err(std::io::Error::from);
        written.and_then(|()| out.write_all(b"\n")).map_err(HostError::file(path))
    })
}

/// What any program gives a new file; the system takes away what the user's mask says.
#[cfg(unix)]
fn of_a_new_file() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn of_a_new_file() -> Option<Permissions> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_on_the_way_leaves_what_was_there() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.csv");
        fs::write(&path, "before").expect("written");
        let result = write_atomically(&path, |out| {
            out.write_all(b"half").expect("written");
            Err(HostError::Failed("on the way".into()))
        });
        assert!(result.is_err());
        assert_eq!(fs::read_to_string(&path).expect("readable"), "before");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1, "nothing is left beside it");
    }

    #[test]
    fn a_file_is_replaced_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.csv");
        for content in ["a long first content", "second"] {
            write_atomically(&path, |out| out.write_all(content.as_bytes()).map_err(HostError::file(&path)))
                .expect("written");
            assert_eq!(fs::read_to_string(&path).expect("readable"), content);
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_one_whether_or_not_its_file_is_there() {
        let folder = tempfile::tempdir().expect("a folder");
        let link = folder.path().join("latest.csv");
        std::os::unix::fs::symlink("today.csv", &link).expect("a link");
        for content in ["made", "replaced"] {
            write_text(&link, content).expect("written");
            assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
            assert_eq!(fs::read_to_string(folder.path().join("today.csv")).expect("readable"), content);
        }
    }
}
