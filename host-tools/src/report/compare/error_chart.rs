//! One situation and one parameter: how far each method's answers are from the truth.

use maud::{Markup, html};

use crate::compare::{Compared, ParameterScore, Score};
use crate::parameter::Parameter;
use crate::report::draw::{Anchor, Scale, bottom_axis, dot, line, number, page_chart, text};
use crate::statistics::sorted;

use super::terminal::label;
use super::verdict::is_best;

const WIDTH: f64 = 440.0;
const LEFT: f64 = 205.0;
const RIGHT: f64 = WIDTH - 14.0;
const TOP: f64 = 26.0;
const ROW: f64 = 19.0;

/// Bias of every method, and the median size of its errors to both sides.
pub fn chart(compared: &Compared, parameter: Parameter) -> Markup {
    let shown: Vec<&Score> = compared.scores.iter().filter(|score| is_shown(score.parameter(parameter))).collect();
    let reach = |score: &&Score| {
        let of = score.parameter(parameter);
        [of.bias - of.median_error, of.bias + of.median_error]
    };
    let ends: Vec<f64> = shown.iter().flat_map(reach).collect();
    let widest = limits(&ends);
    let scale =
        Scale::around([0.0].into_iter().chain(ends.iter().map(|end| end.clamp(-widest, widest))), (LEFT, RIGHT));
    let floor = TOP + ROW * shown.len() as f64;
    let content = html! {
        (bottom_axis(&scale, (TOP - 6.0, floor)))
        (line("truth", (scale.at(0.0), TOP - 6.0), (scale.at(0.0), floor)))
        @for (score, place) in shown.iter().zip(0..) {
            (bar(compared, score, parameter, (&scale, widest), TOP + ROW * (f64::from(place) + 0.5)))
        }
        (text("tick", (0.5 * (LEFT + RIGHT), floor + 32.0), Anchor::Middle, &axis_title(parameter)))
    };
    page_chart((WIDTH, floor + 38.0), &format!("Errors of {}: {}", parameter.symbol(), compared.title), &content)
}

fn is_shown(score: &ParameterScore) -> bool {
    score.median_error.is_finite() && !score.assumed
}

/// What lies beyond eight times the typical error is drawn at the edge: it would hide the others.
fn limits(ends: &[f64]) -> f64 {
    let sizes = sorted(ends.iter().map(|end| end.abs()));
    8.0 * sizes.get(sizes.len() / 3).copied().unwrap_or(1.0)
}

fn bar(compared: &Compared, score: &Score, parameter: Parameter, (scale, widest): (&Scale, f64), y: f64) -> Markup {
    let of = score.parameter(parameter);
    let best = is_best(compared, score, parameter);
    let class = if best { "told" } else { "untold" };
    let at = |value: f64| scale.at(value.clamp(-widest, widest));
    html! {
        (text(if best { "label strong" } else { "label" }, (LEFT - 8.0, y + 4.0), Anchor::End, label(score.contender)))
        (line(&format!("thick {class}"), (at(of.bias - of.median_error), y), (at(of.bias + of.median_error), y)))
        (dot(class, (at(of.bias), y), 3.5))
    }
}

fn axis_title(parameter: Parameter) -> String {
    format!("error of {}, {}: median, and ± its median size", parameter.symbol(), parameter.unit())
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    number(100.0 * share, 0, false)
}
