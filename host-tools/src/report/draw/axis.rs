//! Axes: ticks with their numbers, and faint lines across the picture.

use maud::{Markup, html};

use super::shapes::{Anchor, line, text};
use super::{Pixels, Scale};

/// The axis below a picture that reaches from `top` to `bottom`.
pub fn bottom_axis(scale: &Scale, (top, bottom): Pixels) -> Markup {
    let (left, right) = scale.pixels();
    html! {
        @for tick in scale.ticks() {
            (line("grid", (scale.at(tick), top), (scale.at(tick), bottom)))
            (text("tick", (scale.at(tick), bottom + 15.0), Anchor::Middle, &number(tick)))
        }
        (line("axis", (left, bottom), (right, bottom)))
    }
}

/// The axis left of a picture that reaches from `left` to `right`.
pub fn left_axis(scale: &Scale, (left, right): Pixels) -> Markup {
    html! {
        @for tick in scale.ticks() {
            (line(if tick == 0.0 { "axis" } else { "grid" }, (left, scale.at(tick)), (right, scale.at(tick))))
            (text("tick", (left - 6.0, scale.at(tick) + 3.5), Anchor::End, &number(tick)))
        }
    }
}

/// A tick's number with a true minus sign, without digits that say nothing.
fn number(tick: f64) -> String {
    let rounded = (tick * 1e6).round() / 1e6;
    format!("{rounded}").replace('-', "−")
}
