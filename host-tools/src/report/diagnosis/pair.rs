//! Two plots side by side on one scale: before and after.

use maud::{Markup, html};

use super::findings::Side;
use crate::report::draw::{Anchor, Scale, bottom_axis, left_axis, page_chart, px, text};
use crate::statistics::ends;

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 262.0;
const LEFT: f64 = 46.0;
const RIGHT: f64 = WIDTH - 10.0;
const GAP: f64 = 48.0;
const TOP: f64 = 50.0;
const BOTTOM: f64 = HEIGHT - 40.0;

/// A pair of plots.
pub struct Pair<'a> {
    /// What is drawn upward.
    pub title: &'a str,
    /// What is drawn to the right.
    pub along: &'a str,
    /// From where to where it goes to the right.
    pub x: (f64, f64),
    /// From where to where it goes upward.
    pub y: (f64, f64),
    /// What each side is, in a few words.
    pub captions: [String; 2],
}

impl Pair<'_> {
    /// The picture; `draw` puts the marks of a side between its scales.
    pub fn svg(&self, draw: impl Fn(Side, &Scale, &Scale) -> Markup) -> Markup {
        let middle = 0.5 * (LEFT + RIGHT);
        let halves = [(LEFT, middle - 0.5 * GAP), (middle + 0.5 * GAP, RIGHT)];
        let y = Scale::linear(self.y.0, self.y.1, (BOTTOM, TOP));
        let words = format!("{} against {}, before and after", self.title, self.along);
        let content = html! {
            text class="title" x=(px(LEFT)) y="16" { (self.title) }
            @for ((side, (left, right)), caption) in Side::BOTH.into_iter().zip(halves).zip(&self.captions) {
                @let x = Scale::linear(self.x.0, self.x.1, (left, right));
                (text(&format!("caption {}", side.class()), (left, TOP - 14.0), Anchor::Start, caption))
                (left_axis(&y, (left, right)))
                (bottom_axis(&x, (TOP, BOTTOM)))
                (text("tick", (0.5 * (left + right), HEIGHT - 8.0), Anchor::Middle, self.along))
                (draw(side, &x, &y))
            }
        };
        page_chart((WIDTH, HEIGHT), &words, &content)
    }
}

/// From the least to the greatest of the values, with some room; a little around the one where all are equal.
pub fn span(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = ends(values.filter(|value| value.is_finite()))?;
    let room = if high > low { 0.06 * (high - low) } else { 0.5_f64.max(0.05 * high.abs()) };
    Some((low - room, high + room))
}

/// At most so many marks are drawn of a side: more hide each other and fill the file.
const MARKS: usize = 600;

/// Every so-many-th row is drawn.
pub fn stride(rows: usize) -> usize {
    rows.div_ceil(MARKS).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_holds_all_values_and_has_a_width() {
        assert_eq!(span([1.0, f64::NAN, 3.0].into_iter()), Some((0.88, 3.12)));
        assert_eq!(span([24.0, 24.0].into_iter()), Some((24.0 - 1.2, 24.0 + 1.2)));
        assert_eq!(span([f64::NAN].into_iter()), None);
        assert_eq!([0, 600, 601, 5000].map(stride), [1, 1, 2, 9]);
    }
}
