//! Other programs: how they are found, started, waited for, and what they said when they fail.

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::Deserialize;

use crate::error::HostError;
use crate::progress::spinner;

/// The folder of the workspace that this program was built from.
pub fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// A program to run in the workspace, without what a surrounding `cargo run` or `cargo test` put into the environment
/// for this process alone.
pub fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(workspace()).stdin(Stdio::null());
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        let of_package = ["CARGO_PKG_", "CARGO_MANIFEST_", "CARGO_BIN_"].iter().any(|prefix| text.starts_with(prefix));
        if of_package || ["CARGO", "CARGO_CRATE_NAME", "CARGO_PRIMARY_PACKAGE", "OUT_DIR"].contains(&text.as_ref()) {
            command.env_remove(&name);
        }
    }
    command
}

/// Where a program is on the PATH.
pub fn find_on_path(program: &str) -> Option<PathBuf> {
    let paths = std::env::var_os("PATH")?;
    std::env::split_paths(&paths).map(|folder| folder.join(program)).find(|file| file.is_file())
}

/// What a program printed on its standard output, without the space around it; `None` where it cannot be run or fails.
pub fn output_of(command: &mut Command) -> Option<String> {
    let output = command.stderr(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Runs a program to its end behind a spinner that shows its last line, and gives its standard output.
///
/// # Errors
/// Where it cannot be started or fails; the text ends with what it printed last.
pub fn run_with_spinner(command: &mut Command, what: &str) -> Result<String, HostError> {
    let spinner = spinner(what);
    let failed = |reason: String| HostError::Failed(format!("{what}: {reason}"));
    let mut child =
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().map_err(|error| {
            failed(format!("{} cannot be started: {error}", command.get_program().to_string_lossy()))
        })?;
    let mut stdout = child.stdout.take();
    let reader = std::thread::spawn(move || {
        let mut text = Vec::new();
        if let Some(stdout) = stdout.as_mut() {
            // What was read before an error is still worth having.
            let _ = stdout.read_to_end(&mut text);
        }
        String::from_utf8_lossy(&text).into_owned()
    });
    let mut said = Vec::new();
    for line in child.stderr.take().into_iter().flat_map(lines) {
        spinner.set_message(format!("{what}: {}", line.trim()));
        said.push(line);
    }
    let status = child.wait().map_err(|error| failed(error.to_string()))?;
    let output = reader.join().unwrap_or_default();
    spinner.finish_and_clear();
    if status.success() {
        return Ok(output);
    }
    let tail = said.len().saturating_sub(40);
    Err(failed(format!("{status}\n{}", said.get(tail..).unwrap_or(&[]).join("\n"))))
}

/// The lines that another program prints, up to an error. To its end: where nobody reads on, the program fails when it prints more.
pub fn lines(from: impl Read) -> impl Iterator<Item = String> {
    BufReader::new(from).split(b'\n').map_while(Result::ok).map(|line| String::from_utf8_lossy(&line).into_owned())
}

/// What cargo says of a file that it has made.
#[derive(Deserialize)]
struct Artifact {
    reason: String,
    executable: Option<PathBuf>,
}

/// The program among the messages of `cargo build --message-format json…`; none where it made none.
pub fn built_executable(messages: &str) -> Option<PathBuf> {
    let artifacts = messages.lines().filter_map(|line| serde_json::from_str::<Artifact>(line).ok());
    artifacts.filter(|artifact| artifact.reason == "compiler-artifact").find_map(|artifact| artifact.executable)
}
