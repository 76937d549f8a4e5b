//! The effects in numbers, what tells rivals apart, and what is left that has no name.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::figures::{probability, significant, with_std};
use super::findings::DiagnosisFindings;
use super::quantity::Quantity;
use crate::diagnose::document::{Diagnosis, Estimate, FoundEffect, Unexplained};

/// Below the verdict: each effect found, rivals, a law without a name.
pub fn cards(findings: &DiagnosisFindings) -> Markup {
    let diagnosis = &findings.diagnosis;
    html! {
        div class="answers" {
            @for effect in &diagnosis.effects { (effect_card(effect)) }
            @if !diagnosis.ambiguous_with.is_empty() { (rivals(diagnosis)) }
            @if let Some(law) = &diagnosis.found_law {
                div class="answer untold" {
                    h3 { "A formula, found and not understood" }
                    div class="value formula" { (law.formula) }
                    p class="verdict" { "for " (Quantity::of_column(&law.channel).name.to_lowercase()) }
                    p { "coefficient " (with_std(law.coefficient, 1.0)) ", gain " (significant(law.gain_per_row, 2)) " nats a row" }
                }
            }
        }
    }
}

fn effect_card(effect: &FoundEffect) -> Markup {
    html! {
        div class="answer told" {
            h3 { "Effect" @if !effect.form.is_empty() && effect.form != effect.id { ", form " (effect.form) } }
            div class="value" { (effect.id) }
            p class="verdict" { (parameters(&effect.parameters)) }
            p { "gains " (significant(effect.gain_per_row, 2)) " nats a row on held-out runs, p = " (probability(effect.p_value)) }
        }
    }
}

fn rivals(diagnosis: &Diagnosis) -> Markup {
    html! {
        div class="answer doubtful" {
            h3 { "Not to be told apart from" }
            div class="value" { (diagnosis.ambiguous_with.join(", ")) }
            @if let Some(measurement) = &diagnosis.deciding_measurement {
                p class="verdict" { "What would decide" }
                p { (measurement) }
            }
        }
    }
}

/// `n1 = 0.30 ± 0.03, …`
pub fn parameters(parameters: &BTreeMap<String, Estimate>) -> String {
    let each = parameters.iter().map(|(name, estimate)| format!("{name} = {}", with_std(*estimate, 1.0)));
    each.collect::<Vec<_>>().join(", ")
}

/// What is left, as a table.
pub fn unexplained(unexplained: &[Unexplained]) -> Markup {
    html! {
        @if unexplained.is_empty() {
            p { "Nothing is left that follows any column beyond chance." }
        } @else {
            div class="scroll" {
                table class="numbers" {
                    thead { tr { th { "Channel" } th { "Follows" } th { "Share of its variance" } th { "p" } } }
                    tbody {
                        @for entry in unexplained {
                            tr {
                                td { (Quantity::of_column(&entry.channel).name) }
                                td { code { (entry.regressor) } }
                                td { (significant(100.0 * entry.share_of_variance, 2)) " %" }
                                td { (probability(entry.p_value)) }
                            }
                        }
                    }
                }
            }
        }
    }
}
