//! The bar that shows how far a piece of work has come, and the spinner of one that has no known length.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};

const TICK: Duration = Duration::from_millis(200);

/// A bar over `count` pieces of what `name` says; it goes when it is dropped.
pub fn bar(name: impl Into<String>, count: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix:20} {bar:30} {pos}/{len} {elapsed} {msg}");
    let bar = ProgressBar::new(count as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
        .with_prefix(name.into())
        .with_finish(ProgressFinish::AndClear);
    bar.enable_steady_tick(TICK);
    bar
}

/// A spinner beside what is being done; shown on a terminal only.
pub fn spinner(what: impl Into<String>) -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {wide_msg} {elapsed}");
    let spinner = ProgressBar::new_spinner()
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()))
        .with_message(what.into())
        .with_finish(ProgressFinish::AndClear);
    spinner.enable_steady_tick(TICK);
    spinner
}

/// Does a piece of work behind a bar with its name; the work sets length, position and message.
pub fn with_progress<T>(name: &'static str, work: impl FnOnce(&ProgressBar) -> T) -> T {
    let bar = bar(name, 1);
    let result = work(&bar);
    bar.finish_and_clear();
    result
}
