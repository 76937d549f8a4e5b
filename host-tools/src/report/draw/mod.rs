//! Drawing in SVG: scales, axes and the few shapes that the pictures are made of.

mod axis;
mod scale;
mod shapes;

pub use axis::{bottom_axis, left_axis};
pub use scale::{Pixels, Scale};
pub use shapes::{Anchor, band, dot, line, path, ring, text, vertical_band};

/// A number with a true minus sign, and none before zero; `signed` also shows a plus.
pub fn number(value: f64, digits: usize, signed: bool) -> String {
    let text = if signed { format!("{value:+.digits$}") } else { format!("{value:.digits$}") };
    let zero = text.chars().all(|character| !('1'..='9').contains(&character));
    if zero { format!("{:.digits$}", 0.0) } else { text.replace('-', "−") }
}

/// A length in pixels, short: a tenth is finer than a screen shows.
pub fn px(length: f64) -> String {
    let rounded = (length * 10.0).round() / 10.0;
    // Minus zero reads like a mistake.
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
