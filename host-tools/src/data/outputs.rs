//! Where a command writes: looked at before its work begins, which may take an hour; and where what it tells people goes.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::HostError;

/// Refuses outputs that could not be written, or that would take the place of an input or of one another. What is no regular
/// file (a terminal, a pipe) holds nothing that could be lost.
///
/// # Errors
/// At the first of them.
pub fn check(outputs: &[Option<&Path>], inputs: &[Option<&Path>]) -> Result<(), HostError> {
    let inputs: Vec<PathBuf> = inputs.iter().flatten().filter_map(|input| place(input)).collect();
    let mut taken: Vec<PathBuf> = Vec::new();
    for output in outputs.iter().copied().flatten() {
        can_be_written(output)?;
        let Some(place) = place(output) else { continue };
        let refuse =
            |what: &str| Err(HostError::Failed(format!("{}: {what}: expected another file", output.display())));
        if inputs.contains(&place) {
            return refuse("the output is the input");
        }
        if taken.contains(&place) {
            return refuse("two outputs go to this file");
        }
        taken.push(place);
    }
    Ok(())
}

/// Whether something is there that is neither file nor folder, as a pipe: what has been read of it is gone, and nothing stands beside it.
pub fn is_pipe(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir())
}

/// Whether a file is standard output by another name.
pub fn is_standard_output(path: &Path) -> bool {
    ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"].iter().any(|name| path == Path::new(name))
}

/// Tells people what came of a command, on standard output; on standard error where one of the outputs is standard output itself, which a
/// program reads then.
pub fn tell(summary: &str, outputs: &[Option<&Path>]) {
    if outputs.iter().flatten().any(|output| is_standard_output(output)) {
        eprintln!("{summary}")
    } else {
        println!("{summary}")
    }
}

/// Where a regular file stands, or one that is yet to be written would; none of anything else.
fn place(path: &Path) -> Option<PathBuf> {
    match fs::metadata(path) {
        Ok(there) => there.is_file().then(|| path.canonicalize().ok()).flatten(),
        Err(_) => Some(folder(path).canonicalize().ok()?.join(path.file_name()?)),
    }
}

/// Whether a file could be put there, by putting one there that is gone at once.
fn can_be_written(path: &Path) -> Result<(), HostError> {
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => {
            Err(HostError::Failed(format!("{}: this is a folder: expected a file", path.display())))
        }
        Ok(there) if !there.is_file() => Ok(()),
        _ => {
            let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
            tempfile::tempfile_in(folder(&target)).map(drop).map_err(HostError::file(path))
        }
    }
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(outputs: &[&Path], inputs: &[&Path], words: &str) {
        let [outputs, inputs] = [outputs, inputs].map(|paths| paths.iter().copied().map(Some).collect::<Vec<_>>());
        let error = check(&outputs, &inputs).expect_err("refused").to_string();
        assert!(error.contains(words), "{error}");
    }

    #[test]
    fn what_would_be_lost_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        fs::write(path("in.csv"), "1").expect("written");
        let roundabout = path(".").join("in.csv");
        refused(&[&roundabout], &[&path("in.csv")], "in.csv: the output is the input");
        refused(&[&path("new"), &path(".").join("new")], &[&path("in.csv")], "new: two outputs go to this file");
        refused(&[folder.path()], &[], "this is a folder");
        refused(&[&path("no").join("new")], &[], "new: ");
        check(&[Some(&path("a")), None, Some(&path("b"))], &[Some(&path("in.csv")), None]).expect("all apart");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1, "nothing is left there");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_hold_nothing() {
        let null = Some(Path::new("/dev/null"));
        check(&[null, null], &[null]).expect("nothing is lost");
    }
}
