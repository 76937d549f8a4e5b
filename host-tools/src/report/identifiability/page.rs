//! The advice as a page: one HTML file that needs nothing else.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::terminal::{loads, named, slips};
use super::{Observability, assumptions, picture};
use crate::identifiability::advice::{order, percent};
use crate::identifiability::search::Finding;
use crate::parameter::Parameter;
use crate::report::page::head;
use crate::report::sentence::as_sentence;

/// Orders are sentences: they wrap.
const STYLE: &str = "table.numbers td.manoeuvre { white-space: normal; min-width: 17rem; }";

/// The page.
pub fn page(told: &Observability) -> String {
    let title = "How to drive so that the soil shows";
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(title, &[STYLE]))
            body class="wide" {
                header {
                    h1 { (title) }
                    p { span class="kind" { "computed" } " " span class="kind" { (told.rover) } }
                    p class="source" { (told.soil) }
                }
                main {
                    section {
                        h2 { "Advice" }
                        p { strong { (as_sentence(&told.advice.sentence(&told.question))) } }
                        (manoeuvres(told))
                    }
                    section {
                        h2 { "What spread and patience buy" }
                        div class="scroll" { (PreEscaped(picture(told))) }
                    }
                    section {
                        h2 { "What it rests on" }
                        ul class="caveats" { @for assumption in assumptions(told) { li { (assumption) } } }
                    }
                }
                footer { "Written by " code { "kapvik observe" } "." }
            }
        }
    };
    page.into_string()
}

fn manoeuvres(told: &Observability) -> Markup {
    html! {
        div class="scroll" {
            table class="numbers" {
                caption { "The cheapest manoeuvre of each kind. c, φ, K: one standard deviation, of the value. Cost in seconds of driving." }
                thead { tr {
                    th { "Manoeuvre" } th { "cost" } th { "time, s" } th { "energy, J" } th { "deeper, mm" }
                    th { "c" } th { "φ" } th { "K" } th { "slips" } th { "loads, N" }
                } }
                tbody {
                    @for (name, finding) in named(told) { (row(told, &format!("{name}: {}", order(finding)), finding)) }
                    @if let Some(before) = &told.advice.before {
                        tr {
                            td { "Before any drive" } td {} td {} td {} td {}
                            @for target in Parameter::ALL { td { (percent(before.relative(target, &told.question.soil))) } }
                            td {} td {}
                        }
                    }
                }
            }
        }
    }
}

fn row(told: &Observability, what: &str, finding: &Finding) -> Markup {
    let expense = &finding.expense;
    html! {
        tr {
            td class="manoeuvre" { (what) }
            td { (format!("{:.0}", finding.cost)) }
            td { (format!("{:.0}", expense.time_s)) }
            td { (format!("{:.0}", expense.energy_j)) }
            td { (format!("{:.1}", 1e3 * expense.sinkage_m)) }
            @for target in Parameter::ALL { td { (percent(finding.bound.relative(target, &told.question.soil))) } }
            td { (slips(finding)) }
            td { (loads(finding)) }
        }
    }
}
