//! The report of a diagnosis: one HTML file that needs nothing else.

use maud::{DOCTYPE, Markup, html};

use super::findings::DiagnosisFindings;
use super::quantity::Quantity;
use super::{DIAGNOSIS_CSS, errors, laws, prediction, ranking, residual, soil};
use crate::diagnose::document::Diagnosis;
use crate::report::page::head;

/// What was done, in five lines.
const METHOD: [&str; 5] = [
    "The declared model is fitted to all channels at once, each weighted by its noise. The true slip and the true load of a row are \
     unknowns, too: their readings have errors. Single outliers count less; what a whole run has in common is an offset of that run.",
    "Every known effect is added in turn, in each of its forms, and everything is fitted again: soil, effect and unknown truths.",
    "A candidate is scored by how probable it makes runs that were left out of its fit, against the refitted declared model. Of a \
     left-out run only slip and load are given; its forces and its sinkage are predicted.",
    "The best candidate is kept if its gain is beyond what chance gives to the best of so many candidates; then the next is sought \
     beside it.",
    "What is left is held against every column and against products of columns. Its significance counts how many were tried, and that \
     rows of one run are not independent.",
];

/// What the section of the force channels shows.
const FORCES_ALONE: &str = "This needs no model of wheel and soil. The load is held against its set levels, the side force of a wheel \
    that runs straight against none; braking rows count as well. A true force that follows the same column looks alike.";

/// The page.
pub fn page(findings: &DiagnosisFindings) -> String {
    let diagnosis = &findings.diagnosis;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(&format!("What the model lacks: {}", diagnosis.campaign), &[DIAGNOSIS_CSS]))
            body {
                header {
                    p class="overline" { "What the model lacks · " (diagnosis.campaign) }
                    h1 class="sentence" { (diagnosis.sentence) }
                    p { span class="kind" { (findings.provenance.to_string()) } " " span class="kind verdict" { (diagnosis.verdict.to_string()) } }
                    p class="source" { (findings.source) }
                    (laws::cards(findings))
                }
                main {
                    (section("How wrong, before and after", &before_and_after(findings)))
                    (section("Measured and predicted", &prediction::charts(findings)))
                    @if let Some(guilty) = &findings.guilty { (guilty_section(findings, guilty)) }
                    @if !diagnosis.candidates.is_empty() { (section("The candidates", &ranking::charts(findings))) }
                    @if !diagnosis.force_channels.is_empty() {
                        (section("Force channels by themselves", &html! { p { (FORCES_ALONE) } (laws::by_themselves(&diagnosis.force_channels)) }))
                    }
                    (section("What is left unexplained", &laws::unexplained(&diagnosis.unexplained)))
                    (section("The soil, before and after", &soil_before_and_after(findings)))
                    (section("What to keep in mind", &caveats(diagnosis)))
                    (section("How it was done", &html! { ol class="method" { @for line in METHOD { li { (line) } } } }))
                }
                footer { "Written by " code { "kapvik diagnose" } "." }
            }
        }
    };
    page.into_string()
}

fn section(title: &str, body: &Markup) -> Markup {
    html! { section { h2 { (title) } (body) } }
}

fn before_and_after(findings: &DiagnosisFindings) -> Markup {
    html! {
        p { "Before: " (declared(findings)) ", its soil fitted again. After: the same with "
            @if findings.diagnosis.effects.is_empty() { "nothing added, for nothing earned its place" } @else { "what was found" }
            ". Every run was predicted by fits that did not know it." }
        (errors::section(findings))
    }
}

fn soil_before_and_after(findings: &DiagnosisFindings) -> Markup {
    html! {
        p { "Value ± one standard deviation of the fit; thin lines reach over two. Shaded: what was known before. "
            strong { "Good forces do not validate soil parameters: " }
            "a model that lacks an effect bends them to fit, and parameters that act alike trade places without a "
            "trace in the forces." }
        (soil::table(findings))
    }
}

fn caveats(diagnosis: &Diagnosis) -> Markup {
    html! {
        ul class="caveats" {
            @for caveat in &diagnosis.caveats { li { (caveat) } }
            @for left_out in &diagnosis.left_out {
                li { (left_out.rows) @if left_out.rows == 1 { " row was" } @else { " rows were" }
                    " not used: " (left_out.reason) "." }
            }
        }
    }
}

fn declared(findings: &DiagnosisFindings) -> String {
    match findings.diagnosis.declared.as_slice() {
        [] => "equations 1–11 as they are".to_owned(),
        effects => {
            let fitted: Vec<_> = findings.diagnosis.declared_effects.iter().map(laws::declared).collect();
            let told = if fitted.is_empty() { effects.join(", ") } else { fitted.join("; ") };
            format!("equations 1–11 with what was declared ({told})")
        }
    }
}

fn guilty_section(findings: &DiagnosisFindings, guilty: &str) -> Markup {
    html! {
        @if let Some(charts) = residual::charts(findings, guilty) {
            (section(&format!("The residual against {}", Quantity::of_column(guilty).name.to_lowercase()), &html! {
                p { "Of all columns this is the one that the residual of the declared model follows best. A model that lacks nothing "
                    "leaves dots in the grey band, without a pattern." }
                (charts)
            }))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::findings;
    use super::*;
    use crate::diagnose::document::Verdict;

    #[test]
    fn the_page_shows_everything_and_fetches_nothing() {
        let page = page(&findings());
        for expected in [
            "with slip-sinkage the error",
            "4.10",
            "1.10",
            "1.31 ± 0.07",
            "0.135 ± 0.015",
            "Side force",
            "mm/s.",
            "12 rows",
            "Force channels by themselves",
            "0.23 ± 0.05 N/h",
        ] {
            assert!(page.contains(expected), "{expected}");
        }
        // Errors, four channels predicted, four residuals, two steps of candidates.
        assert_eq!(page.matches("class=\"chart\"").count(), 11);
        for forbidden in ["http", "<script", "<link", "url(", "NaN", "inf"] {
            assert!(!page.replace("http://www.w3.org/2000/svg", "").contains(forbidden), "{forbidden}");
        }
    }

    #[test]
    fn nothing_found_is_a_page_too() {
        let mut findings = findings();
        let diagnosis = &mut findings.diagnosis;
        diagnosis.verdict = Verdict::None;
        diagnosis.effects.clear();
        diagnosis.candidates.clear();
        diagnosis.unexplained.clear();
        diagnosis.force_channels.clear();
        diagnosis.found_law = None;
        diagnosis.leave_level_out = None;
        diagnosis.ends_apart = None;
        diagnosis.soil_after.clear();
        findings.guilty = Some("no*such".to_owned());
        findings.traces[1].rows.fill(None);
        let page = page(&findings);
        assert!(page.contains("nothing earned its place"));
        assert!(page.contains("Nothing is left"));
        assert!(!page.contains("Force channels by themselves"));
        assert_eq!(page.matches("class=\"chart\"").count(), 4);
    }
}
