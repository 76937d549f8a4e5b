//! The page: who is to be trusted where.

use kapvik_firmware::identification::SoilPrior;
use maud::{DOCTYPE, Markup, html};

use crate::compare::{Compared, Comparison, SLIPS, Score};
use crate::identify::method::REDRAWS;
use crate::parameter::Parameter;
use crate::prior;
use crate::report::draw::number;
use crate::report::page::head;

use super::error_chart::{chart, percent};
use super::terminal::{DIRECT_TESTS, cramer_rao, duration, label, measured_rows};
use super::verdict::{to_limit, verdicts};
use super::{COMPARE_CSS, overview};

/// What the reader has to know of how it was done.
fn method() -> [String; 4] {
    let noise = &prior::KAPVIK_INSTANT_NOISE;
    let [least_slip, greatest_slip] = SLIPS;
    let usual = SoilPrior::<f64>::usual();
    [
        format!(
            "Six wheels of Kapvik's assumed size at slips {least_slip:.2}–{greatest_slip:.2}; noise of one instant {} N (drawbar pull), {} N (load), {} N·m, \
             {} of slip, {} mm of sinkage. All methods see the same numbers.",
            noise.drawbar_pull_n,
            noise.load_n,
            noise.torque_nm,
            noise.slip,
            1e3 * noise.sinkage_m
        ),
        format!(
            "Every method that takes a prior is told the one that the networks were trained with, whatever is true; map stands in the \
             tables once more with the usual one: c about {}, φ about {:.0} ± {:.0}°, K about {}.",
            Parameter::Cohesion.quantity(usual.ln_cohesion.mean.exp()),
            usual.friction_angle_rad.mean.to_degrees(),
            usual.friction_angle_rad.spread().to_degrees(),
            Parameter::ShearModulus.quantity(usual.ln_shear_modulus.mean.exp()),
        ),
        format!(
            "Methods that take part of the soil as given have the middle of the prior for it; some stand in the tables once more with \
             the truth, and are named so. Standard deviations are the method's own; where it gives none, by redrawing the noise \
             {REDRAWS} times."
        ),
        "The limit is the mean of the exact posterior, by sampling. Nothing beats its root mean square error where its prior is true."
            .to_owned(),
    ]
}

/// The page.
pub fn page(comparison: &Comparison) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head("Every method on the same data", &[COMPARE_CSS]))
            body class="wide" {
                header {
                    p class="overline" { (comparison.cases) " cases of each situation · seed " (comparison.seed) }
                    h1 { "Which method to trust where" }
                    ul class="caveats" { @for verdict in verdicts(comparison) { li { (verdict) } } }
                }
                main {
                    @for parameter in [Parameter::FrictionAngle, Parameter::ShearModulus, Parameter::Cohesion] {
                        section {
                            h2 { "Median error of " (parameter.symbol()) ", " (parameter.unit()) }
                            (overview::table(comparison, parameter))
                        }
                    }
                    p class="note" { "The darker, the further from the least error of the column (rust: tenfold). Bold: least of the methods \
                        that are told no more than the others." }
                    (limit_section(comparison))
                    section { h2 { "How it was done" } ul class="caveats" { @for line in method() { li { (line) } } } }
                    @for compared in &comparison.situations { (situation(compared)) }
                    @if !comparison.measured.is_empty() { (measured_section(comparison)) }
                }
            }
        }
    };
    page.into_string()
}

fn limit_section(comparison: &Comparison) -> Markup {
    let rows = to_limit(comparison);
    html! {
        @if !rows.is_empty() {
            section {
                h2 { "How near to the limit" }
                div class="scroll" { table class="numbers" {
                    caption { "Root mean square error over that of the limit, on the same cases." }
                    thead { tr { th {} th {} th { "c" } th { "φ" } th { "K" } } }
                    tbody { @for cells in rows { tr { @for cell in cells { td { (cell) } } } } }
                } }
            }
        }
    }
}

fn situation(compared: &Compared) -> Markup {
    html! {
        section {
            h2 { (compared.title) }
            @if let Some(bound) = compared.cramer_rao { p class="note" { (cramer_rao(bound)) "." } }
            div class="three" { @for parameter in Parameter::ALL { (chart(compared, parameter)) } }
            div class="scroll" { table class="numbers" {
                caption { "Medians [quartiles] of the estimates; share of the 68 % and 95 % intervals that hold the truth, in %." }
                thead { tr {
                    th {}
                    @for parameter in Parameter::ALL { th { (parameter.symbol()) ", " (parameter.unit()) } th { "68, 95" } th { "told" } }
                    th { "refused" } th { "time" }
                } }
                tbody { @for score in &compared.scores { (row(score)) } }
            } }
        }
    }
}

fn row(score: &Score) -> Markup {
    html! {
        tr {
            td title=(score.reason.as_deref().unwrap_or("")) { (label(score.contender)) }
            @for parameter in Parameter::ALL {
                @let of = score.parameter(parameter);
                @let digits = parameter.decimals();
                @if of.assumed || of.median.is_nan() {
                    td class="untold" { @if of.assumed { "given" } @else { "–" } } td {} td {}
                } @else {
                    td { (number(of.median, digits, false)) " [" (number(of.low_quartile, digits, false)) ", "
                        (number(of.high_quartile, digits, false)) "]" }
                    td { (percent(of.within_68)) ", " (percent(of.within_95)) }
                    td { (percent(of.identifiable)) " %" }
                }
            }
            td { (percent(score.refused)) " %" }
            td { (duration(score.seconds)) }
        }
    }
}

fn measured_section(comparison: &Comparison) -> Markup {
    html! {
        section {
            h2 { "One wheel at six slips, measured" }
            p { "Ding et al. 2011, a smooth wheel on a planetary simulant at one load; plate tests tell n and the stiffness. Direct tests: "
                (DIRECT_TESTS) ". Equations 1–11 lack effects that this wheel shows, and one load cannot tell c from φ." }
            div class="scroll" { table class="numbers" {
                thead { tr { th {} @for parameter in Parameter::ALL { th { (parameter.titled()) } } th {} } }
                tbody { @for cells in measured_rows(&comparison.measured) { tr { @for cell in cells { td { (cell) } } } } }
            } }
        }
    }
}
