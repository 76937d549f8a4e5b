//! Files that are not whole yet: taken away where the program is told to end.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A file that is being written, until this is dropped.
pub(super) struct Unfinished(PathBuf);

impl Unfinished {
    /// The file at a path.
    pub(super) fn new(path: &Path) -> Self {
        unfinished().push(path.to_path_buf());
        Self(path.to_path_buf())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        unfinished().retain(|path| *path != self.0);
    }
}

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on the program takes such files away before it ends by Ctrl-C or by `kill`; where the system does not let it, they stay. Not with
/// its terminal: whoever began it with `nohup` wants it to go on.
#[cfg(unix)]
pub fn remove_at_an_early_end() {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            // Held until the end: no further file is begun.
            let paths = unfinished();
            paths.iter().for_each(|path| _ = fs::remove_file(path));
            _ = emulate_default_handler(signal);
        }
    });
}

/// Elsewhere they stay.
#[cfg(not(unix))]
pub fn remove_at_an_early_end() {}
