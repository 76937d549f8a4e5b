//! The candidates that the document lists, in the order in which they are preferred, with error bars.

use maud::{Markup, html};

use super::bars::interval;
use super::figures::{probability, significant};
use super::findings::DiagnosisFindings;
use crate::diagnose::document::Candidate;
use crate::report::draw::{Anchor, Scale, bottom_axis, line, page_chart, px, text};

const WIDTH: f64 = 900.0;
const LEFT: f64 = 290.0;
const RIGHT: f64 = WIDTH - 175.0;
const TOP: f64 = 40.0;
const ROW: f64 = 24.0;

/// What a candidate is to the verdict.
fn standing(findings: &DiagnosisFindings, candidate: &Candidate) -> &'static str {
    let diagnosis = &findings.diagnosis;
    let found = diagnosis
        .effects
        .get(candidate.step.saturating_sub(1))
        .is_some_and(|effect| effect.id == candidate.id && (effect.form.is_empty() || effect.form == candidate.form));
    let rival = candidate.step == 1 && diagnosis.ambiguous_with.contains(&candidate.id);
    match (found, rival) {
        (true, _) => "told",
        (false, true) => "doubtful",
        (false, false) => "untold",
    }
}

/// A picture for each step of the forward selection.
pub fn charts(findings: &DiagnosisFindings) -> Markup {
    let candidates = &findings.diagnosis.candidates;
    let last = candidates.iter().map(|candidate| candidate.step).max().unwrap_or(0);
    html! {
        @for step in 1..=last {
            @let of_step: Vec<&Candidate> = candidates.iter().filter(|candidate| candidate.step == step).collect();
            @if !of_step.is_empty() {
                @if last > 1 { h3 { (title(findings, step)) } }
                (chart(findings, &of_step))
            }
        }
    }
}

fn title(findings: &DiagnosisFindings, step: usize) -> String {
    let before: Vec<&str> = findings.diagnosis.effects.iter().take(step - 1).map(|effect| effect.id.as_str()).collect();
    if before.is_empty() { "As the first effect".to_owned() } else { format!("Beside {}", before.join(" and ")) }
}

fn chart(findings: &DiagnosisFindings, candidates: &[&Candidate]) -> Markup {
    let gains = candidates.iter().map(|candidate| (candidate.gain_per_row, candidate.gain_std));
    let top = gains.clone().map(|(gain, std)| gain + 2.0 * std);
    // What does far worse than nothing is at the end of the scale: it would hide the others.
    let best = top.clone().fold(0.0, f64::max);
    let bottom = gains.map(|(gain, std)| (gain - 2.0 * std).max(-0.5 * best));
    let scale = Scale::around(top.chain(bottom), (LEFT, RIGHT));
    let floor = TOP + ROW * candidates.len() as f64;
    let height = floor + 40.0;
    let content = html! {
        (bottom_axis(&scale, (TOP - 8.0, floor)))
        (line("axis", (scale.at(0.0), TOP - 8.0), (scale.at(0.0), floor)))
        (text("tick", (WIDTH - 110.0, TOP - 16.0), Anchor::End, "gain"))
        (text("tick", (WIDTH - 10.0, TOP - 16.0), Anchor::End, "p"))
        @for (candidate, place) in candidates.iter().zip(0..) {
            (bar(candidate, standing(findings, candidate), &scale, TOP + ROW * (f64::from(place) + 0.5)))
        }
        (text("tick", (0.5 * (LEFT + RIGHT), height - 8.0), Anchor::Middle,
            "gain in log predictive density on held-out runs, nats a row, ± one and two standard deviations"))
    };
    page_chart((WIDTH, height), "Gain of every candidate on held-out runs", &content)
}

fn bar(candidate: &Candidate, class: &str, scale: &Scale, y: f64) -> Markup {
    let strong = if class == "untold" { "label" } else { "label strong" };
    let p_value = candidate.p_value.map_or_else(|| "–".to_owned(), probability);
    let gain = (candidate.gain_per_row, candidate.gain_std);
    html! {
        text class=(strong) x=(px(LEFT - 14.0)) y=(px(y + 4.0)) text-anchor="end" {
            (candidate.id)
            @if !candidate.form.is_empty() && candidate.form != candidate.id { tspan class="form" { " " (candidate.form) } }
        }
        (interval(class, scale, gain, y))
        (text("tick", (WIDTH - 110.0, y + 4.0), Anchor::End, &significant(candidate.gain_per_row, 2)))
        (text("tick", (WIDTH - 10.0, y + 4.0), Anchor::End, &p_value))
    }
}
