//! The report: one HTML file that needs nothing else.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::data::campaign::Campaign;
use crate::identify::{IdentifiedRun, assumed_soil};

use super::caveats::{caveats, kind_in_words};
use super::chain::chain;
use super::draw;
use super::estimates::Panel;
use super::facts;
use super::findings::{EstimateRow, Findings};
use super::legend;
use super::residual::{LeftOver, ModelCheck, ModelRow};
use super::response::{Response, SLIP_CURVES};
use super::verdict::Verdict;
use crate::parameter::Parameter;

/// How the page looks.
const PAGE_CSS: &str = include_str!("page.css");
/// How the pictures look.
pub(super) const DRAW_CSS: &str = include_str!("draw/draw.css");

/// Rows of residuals that are shown.
const ROWS_SHOWN: usize = 40;
/// Runs that are drawn; the estimates of all are in the JSON file of `identify`.
const RUNS_DRAWN: usize = 24;

/// The page.
pub fn page(findings: &Findings) -> String {
    let campaign = &findings.campaign;
    let runs = &findings.identification.runs;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(&format!("Soil from wheels: {}", campaign.name), &[]))
            body {
                header {
                    h1 { "Soil from wheels: " (campaign.name) }
                    p { span class="kind" { (campaign.provenance.to_string()) } }
                    p class="source" { (campaign.source) }
                    p {
                        "What a rolling wheel feels (load, drawbar pull, torque) and how it moves (slip, sinkage) went to the "
                        "flight computer, whose networks say what soil it rolls on, how sure they are, and what such data "
                        "cannot tell."
                    }
                }
                main {
                    @for run in runs.iter().take(RUNS_DRAWN) { (run_section(findings, run, runs.len() > 1)) }
                    @if runs.len() > RUNS_DRAWN {
                        p { (runs.len() - RUNS_DRAWN) " more runs are not drawn here; " code { "kapvik identify" } " writes all." }
                    }
                    @if let Some(check) = &findings.model { (model_section(findings, check)) }
                    section {
                        h2 { "What to keep in mind" }
                        ul class="caveats" { @for caveat in caveats(findings) { li { (caveat) } } }
                    }
                    section {
                        h2 { "From measurement to estimate" }
                        (chain(findings))
                        (facts::table(&findings.flight, &facts::of_campaign(findings)))
                    }
                }
                footer { "Written by " code { "kapvik run" } ". Answers " code { (findings.flight.fingerprint) }
                    ": any computer that prints the same gave the same bits." }
            }
        }
    };
    page.into_string()
}

/// The head of a page of its own: nothing is fetched. `styles` come after those that all pages share.
pub(super) fn head(title: &str, styles: &[&str]) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta name="viewport" content="width=device-width, initial-scale=1";
            title { (title) }
            style { (PreEscaped(PAGE_CSS)) (PreEscaped(DRAW_CSS)) @for style in styles { (PreEscaped(style)) } }
        }
    }
}

fn run_section(findings: &Findings, run: &IdentifiedRun, named: bool) -> Markup {
    let rows = Findings::rows(run);
    html! {
        section {
            @if named { h2 { "Run " (run.states.run) } }
            @match run.refused() {
                Some(reason) => p { "No estimate: " (reason) "." },
                None => {
                    (answers(&findings.campaign, &rows))
                    (panels(&findings.campaign, &rows))
                    (legend::estimates(&rows))
                    @if !run.states.rows_left_out.is_empty() {
                        p class="note" { "Rows left out: " (run.states.reasons_in_words()) "." }
                    }
                }
            }
        }
    }
}

/// The three numbers, as large as they deserve.
fn answers(campaign: &Campaign, rows: &[EstimateRow]) -> Markup {
    let Some(row) = rows.last() else { return html! {} };
    let Ok(soil) = &row.estimate else { return html! {} };
    html! {
        div class="answers" {
            @for parameter in Parameter::ALL {
                @let estimate = parameter.of(soil);
                @let verdict = Verdict::of(parameter, soil, &campaign.ground, row.is_explained);
                div class={ "answer " (verdict.class()) } {
                    h3 { (parameter.name()) " " i { (parameter.symbol()) } }
                    div class="value" { (parameter.number(estimate.value.into())) small { (parameter.spaced_unit()) } }
                    p class="verdict" { (verdict.in_words()) }
                    p { "95 % interval " (parameter.interval(estimate.interval_95)) (parameter.spaced_unit()) }
                    @if let Some(known) = parameter.known(&campaign.ground) {
                        p class="direct-tests" { "direct tests " (parameter.knowledge(known)) }
                    }
                }
            }
        }
        p class="note" { "From " (kind_in_words(row.kind)) "." }
    }
}

fn panels(campaign: &Campaign, rows: &[EstimateRow]) -> Markup {
    html! {
        div class="panels" {
            @for parameter in Parameter::ALL {
                (Panel { parameter, rows, ground: &campaign.ground, labelled: true }.svg())
            }
        }
    }
}

fn model_section(findings: &Findings, check: &ModelCheck) -> Markup {
    let campaign = &findings.campaign;
    let noise = &findings.identification.noise;
    let best = findings.identification.runs.iter().find_map(Findings::best).and_then(|row| row.estimate.ok());
    let one_run = findings.identification.runs.len() == 1;
    let estimated = best.filter(|_| one_run).map(|soil| assumed_soil(&campaign.ground, campaign, &soil));
    let response = Response { check, wheel: &campaign.wheel, estimated: estimated.as_ref() };
    let deviations = [noise.drawbar_pull.std, noise.torque.std, noise.sinkage.std];
    html! {
        section {
            h2 { "Measured, and what the equations say" }
            p { "The wheel–soil equations 1–11 with the soil that direct tests measured"
                @if estimated.is_some() { ", and with the soil that the networks found" }
                ". Close curves are no proof of the parameters behind them." }
            div class="panels" {
                @for (curve, std) in SLIP_CURVES.iter().zip(deviations) { (response.svg(curve, std)) }
            }
            (legend::response(estimated.is_some()))
            (residual_table(check, estimated.map(|soil| ModelCheck::with(campaign, soil).rms())))
        }
    }
}

fn residual_table(check: &ModelCheck, estimated: Option<LeftOver>) -> Markup {
    html! {
        div class="scroll" {
            table class="numbers" {
                caption { "Measured − computed, with the directly measured soil" }
                thead { tr { th { "Slip" } th { "Drawbar pull, N" } th { "Torque, N·m" } th { "Sinkage, mm" } } }
                tbody {
                    @for row in check.rows.iter().take(ROWS_SHOWN) { (residual_row(row)) }
                    @if check.rows.len() > ROWS_SHOWN {
                        tr { td colspan="4" { "and " (check.rows.len() - ROWS_SHOWN) " more rows, which the root mean square is over as well" } }
                    }
                    (rms_row("Root mean square", check.rms()))
                    @if let Some(rms) = estimated { (rms_row("… with c, φ and K of the networks", rms)) }
                }
            }
        }
    }
}

fn rms_row(what: &str, rms: LeftOver) -> Markup {
    html! { tr class="sum" { td { (what) } @for cell in rms.cells(false) { td { (cell) } } } }
}

fn residual_row(row: &ModelRow) -> Markup {
    html! {
        tr { td { (draw::number(row.slip, 2, false)) } @for cell in row.left_over().cells(true) { td { (cell) } } }
    }
}
