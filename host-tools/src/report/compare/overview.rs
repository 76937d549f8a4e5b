//! All situations and all methods at a glance: the median error of one parameter.

use maud::{Markup, html};

use crate::compare::{CONTENDERS, Compared, Comparison, Score};
use crate::parameter::Parameter;
use crate::report::draw::number;

use super::verdict::{is_best, is_in_contest};

/// The table of one parameter. The shade of a cell says how its error compares with the least of its column.
pub fn table(comparison: &Comparison, parameter: Parameter) -> Markup {
    html! {
        div class="scroll" {
            table class="overview" {
                thead { tr {
                    th {}
                    @for compared in &comparison.situations { th title=(compared.title) { (heading(compared)) } }
                } }
                tbody {
                    @for contender in &CONTENDERS {
                        tr {
                            th scope="row" { (contender.label) }
                            @for compared in &comparison.situations { (cell(compared, contender.id, parameter)) }
                        }
                    }
                }
            }
        }
    }
}

/// The name of a situation, a line for each of its parts.
fn heading(compared: &Compared) -> Markup {
    html! { @for part in compared.id.split('-') { (part) br; } }
}

fn cell(compared: &Compared, contender: &str, parameter: Parameter) -> Markup {
    let Some(score) = compared.scores.iter().find(|score| score.contender == contender) else {
        return html! { td class="none" { "·" } };
    };
    let of = score.parameter(parameter);
    if of.assumed {
        return html! { td class="given" title="taken as given" { "given" } };
    }
    if of.median_error.is_nan() {
        return html! { td class="none" title=(score.reason.as_deref().unwrap_or("")) { "refused" } };
    }
    let digits = if parameter == Parameter::Cohesion { 0 } else { 1 };
    let best = if is_best(compared, score, parameter) { "best" } else { "" };
    html! {
        td class=(best) style={ "background:" (shade(compared, score, parameter)) } {
            (number(of.median_error, digits, false))
        }
    }
}

/// White at the least error of the situation, rust at ten times it and more.
fn shade(compared: &Compared, score: &Score, parameter: Parameter) -> String {
    let error = |score: &Score| score.parameter(parameter).median_error;
    let counts = |score: &&Score| is_in_contest(score) && !score.parameter(parameter).assumed;
    let least = compared.scores.iter().filter(counts).map(error).fold(f64::INFINITY, f64::min);
    let strength = ((error(score) / least.max(1e-9)).log10() * 0.42).clamp(0.0, 0.42);
    format!("rgba(180,80,28,{strength:.2})")
}
