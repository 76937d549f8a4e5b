//! Drawing in SVG: scales, axes and the few shapes that the pictures are made of.

mod axis;
mod page_chart;
mod scale;
mod shapes;

pub use axis::{bottom_axis, left_axis};
pub use page_chart::page_chart;
pub use scale::{Pixels, Scale};
pub use shapes::{Anchor, band, dot, line, path, ring, text, vertical_band};

/// A number with a true minus sign, and none before zero; `signed` also shows a plus. A dash where there is none.
pub fn number(value: f64, digits: usize, signed: bool) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
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

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_a_true_minus_and_a_dash_where_there_is_none() {
        let written = [-1.26, -0.04, 1.26, f64::NAN, f64::INFINITY].map(|value| number(value, 1, true));
        assert_eq!(written, ["−1.3", "0.0", "+1.3", "–", "–"]);
    }
}
