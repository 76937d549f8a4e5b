//! The shapes of the pictures.

use maud::{Markup, html};

use super::px;

/// Which end of a text lies at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// A line; `class` gives it colour and width.
pub fn line(class: &str, (x1, y1): (f64, f64), (x2, y2): (f64, f64)) -> Markup {
    html! { line class=(class) x1=(px(x1)) y1=(px(y1)) x2=(px(x2)) y2=(px(y2)) {} }
}

/// A full dot.
pub fn dot(class: &str, (x, y): (f64, f64), radius: f64) -> Markup {
    html! { circle class=(class) cx=(px(x)) cy=(px(y)) r=(px(radius)) {} }
}

/// A ring, filled with the paper.
pub fn ring(class: &str, (x, y): (f64, f64), radius: f64) -> Markup {
    html! { circle class={ (class) " ring" } cx=(px(x)) cy=(px(y)) r=(px(radius)) {} }
}

/// A band from left to right over the whole height.
pub fn vertical_band(class: &str, (left, right): (f64, f64), (top, bottom): (f64, f64)) -> Markup {
    html! {
        rect class=(class) x=(px(left)) y=(px(top)) width=(px((right - left).max(0.0)))
            height=(px((bottom - top).max(0.0))) {}
    }
}

/// A broken line through points.
pub fn path(class: &str, points: &[(f64, f64)]) -> Markup {
    let list: Vec<String> = points.iter().map(|(x, y)| format!("{},{}", px(*x), px(*y))).collect();
    html! { polyline class=(class) points=(list.join(" ")) {} }
}

/// A band between two broken lines over the same places.
pub fn band(class: &str, upper: &[(f64, f64)], lower: &[(f64, f64)]) -> Markup {
    let around = upper.iter().chain(lower.iter().rev());
    let list: Vec<String> = around.map(|(x, y)| format!("{},{}", px(*x), px(*y))).collect();
    html! { polygon class=(class) points=(list.join(" ")) {} }
}

/// A text.
pub fn text(class: &str, (x, y): (f64, f64), anchor: Anchor, content: &str) -> Markup {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    html! { text class=(class) x=(px(x)) y=(px(y)) text-anchor=(anchor) { (content) } }
}
