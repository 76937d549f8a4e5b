//! The bar that shows how far a step has come.

use indicatif::{ProgressBar, ProgressStyle};

/// Does a piece of work behind a bar with its name; the work sets length, position and message.
pub fn with_progress<T>(name: &'static str, work: impl FnOnce(&ProgressBar) -> T) -> T {
    let bar = ProgressBar::new(1);
    let style = ProgressStyle::with_template("{prefix:20} {bar:30} {pos}/{len} {elapsed} {msg}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_prefix(name);
    bar.enable_steady_tick(std::time::Duration::from_millis(200));
    let result = work(&bar);
    bar.finish_and_clear();
    result
}
