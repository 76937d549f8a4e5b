//! A value with its intervals, lying.

use maud::{Markup, html};

use crate::report::draw::{Scale, dot, line};

/// A dot, a thick line over one standard deviation to each side and a thin one over two.
pub fn interval(class: &str, scale: &Scale, (value, std): (f64, f64), height: f64) -> Markup {
    let reach =
        |deviations: f64| ((scale.at(value - deviations * std), height), (scale.at(value + deviations * std), height));
    let (thin, thick) = (reach(2.0), reach(1.0));
    html! {
        @if std.is_finite() && std > 0.0 {
            (line(&format!("thin {class}"), thin.0, thin.1))
            (line(&format!("thick {class}"), thick.0, thick.1))
        }
        (dot(class, (scale.at(value), height), 4.0))
    }
}
