//! The effects in numbers, what tells rivals apart, and what is left that has no name.

use std::collections::BTreeMap;

use kapvik_firmware::terramechanics::effects::effect_info;
use maud::{Markup, html};

use super::figures::{probability, significant, with_std};
use super::findings::DiagnosisFindings;
use super::quantity::Quantity;
use crate::diagnose::document::{DeclaredFit, Diagnosis, Estimate, FoundEffect, Unexplained};
use crate::diagnose::effect_in_words;
use crate::digits::spaced_unit;

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
                    p { "coefficient " (with_std(law.coefficient, 1.0)) ", gain " (significant(law.gain_per_row, 2)) " nats a row on held-out runs" }
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
            @if let Some(info) = effect_info(&effect.id) { p { (effect_in_words(info, &effect.parameters)) } }
            p class="verdict" { (parameters(effect)) }
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

/// `length_m = 0.060 ± 0.010 m, …`, with the units of the effect's parameters.
pub fn parameters(effect: &FoundEffect) -> String {
    with_units(&effect.id, &effect.parameters)
}

/// An effect that was declared: `id, form:` and the same.
pub fn declared(effect: &DeclaredFit) -> String {
    format!("{}, {}: {}", effect.id, effect.form, with_units(&effect.id, &effect.parameters))
}

fn with_units(id: &str, parameters: &BTreeMap<String, Estimate>) -> String {
    let info = effect_info(id);
    let each = parameters.iter().map(|(name, estimate)| {
        let unit = info.and_then(|info| info.parameter(name)).map_or("-", |parameter| parameter.unit);
        let unit = spaced_unit(unit);
        format!("{name} = {}{unit}", with_std(*estimate, 1.0))
    });
    each.collect::<Vec<_>>().join(", ")
}

/// What the force channels show by themselves, as a table.
pub fn by_themselves(effects: &[FoundEffect]) -> Markup {
    html! {
        div class="scroll" {
            table class="numbers" {
                thead { tr { th { "Effect" } th { "Form" } th { "Size" } th { "Gain, nats a row" } th { "p" } } }
                tbody {
                    @for effect in effects {
                        tr {
                            td { code { (effect.id) } }
                            td { (effect.form) }
                            td { (parameters(effect)) }
                            td { (significant(effect.gain_per_row, 2)) }
                            td { (probability(effect.p_value)) }
                        }
                    }
                }
            }
        }
    }
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
                                td { @if entry.is_along_runs() { "its runs, along " } code { (entry.regressor) } }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_the_units_of_their_effect() {
        let value = |name: &str, value, std| (name.to_owned(), Estimate { value, std });
        let effect = FoundEffect {
            id: "sinkage-lag".to_owned(),
            form: String::new(),
            parameters: BTreeMap::from([value("length_m", 0.06, 0.01), value("start", 0.1, 0.04)]),
            gain_per_row: 1.0,
            p_value: 0.01,
            ambiguous_with: Vec::new(),
        };
        assert_eq!(parameters(&effect), "length_m = 0.060 ± 0.010 m, start = 0.10 ± 0.04");
    }
}
