//! The report of a drive: one HTML file that needs nothing else.

use maud::{DOCTYPE, Markup, html};

use super::CHART_CSS;
use super::caveats::caveats;
use super::doubts::doubts;
use super::errors;
use super::findings::{Origin, TraverseFindings};
use super::soil_chart::SoilChart;
use super::time_axis::{Spread, spreads};
use super::wheel_chart::WheelChart;
use crate::identify::network_refusal;
use crate::parameter::Parameter;
use crate::replay::{REASONS, REPEATS, SensorTrouble, filter_lines, troubles};
use crate::report::chain::link;
use crate::report::draw::{Scale, line, path};
use crate::report::facts;
use crate::report::legend::entry;
use crate::report::page::head;
use crate::report::sentence::as_sentence;
use crate::trial::errors::Errors;
use crate::wheel_quantity::WheelQuantity;

/// The page.
pub fn page(findings: &TraverseFindings) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(&format!("Soil along {}", findings.name()), &[CHART_CSS]))
            body class="wide" {
                (header(findings))
                main {
                    (soil(findings))
                    (wheels(findings))
                    @if let Some(errors) = &findings.errors { (error_table(errors)) }
                    (sensors(findings))
                    section {
                        h2 { "What to keep in mind" }
                        ul class="caveats" {
                            @for caveat in caveats(findings).into_iter().chain(doubts(findings)) { li { (caveat) } }
                        }
                    }
                    section {
                        h2 { "From sensors to soil" }
                        (chain(findings))
                        (facts::table(&findings.flight, &of_drive(findings)))
                    }
                }
                footer { "Written by " code { "kapvik run" } ". Estimates " code { (findings.flight.fingerprint) }
                    ": any computer that prints the same gave the same bits." }
            }
        }
    };
    page.into_string()
}

fn header(findings: &TraverseFindings) -> Markup {
    let kind = match &findings.origin {
        Origin::Recorded(_) => "recorded sensor frames",
        Origin::Simulated { .. } => "simulated",
    };
    html! {
        header {
            h1 { "Soil along " (findings.name()) }
            p {
                span class="kind" { (kind) } " "
                @if findings.assumed.are_all() { span class="kind" { "rover assumed (set K0)" } }
                @else if !findings.assumed.are_none() { span class="kind" { "rover partly assumed (set K0)" } }
            }
            p {
                "Encoders, drive torques, load cells, suspension angles, accelerometer, gyro and velocimeter went to the flight "
                "computer, " (findings.outcome.frames) " frames over "
                (format!("{:.0}", findings.outcome.driven_s())) " s. Its filters say what each wheel feels, and its networks what "
                "soil that is, how sure they are, and what such a drive cannot tell."
            }
        }
    }
}

fn soil(findings: &TraverseFindings) -> Markup {
    html! {
        section {
            h2 { "Soil under the rover" }
            (answers(findings))
            @for parameter in Parameter::ALL { (SoilChart { parameter, findings }.svg()) }
            (legend(findings, true))
        }
    }
}

/// The three numbers at the end, as large as they deserve.
fn answers(findings: &TraverseFindings) -> Markup {
    let soil = match &findings.outcome.soil {
        Ok(soil) => &soil.estimate,
        Err(reason) => return html! { p { "No estimate at the end: " (network_refusal(*reason)) "." } },
    };
    let last = findings.samples.last();
    html! {
        div class="answers" {
            @for parameter in Parameter::ALL {
                @let estimate = parameter.of(soil);
                @let class = if estimate.identifiable { "told" } else { "untold" };
                div class={ "answer " (class) } {
                    h3 { (parameter.name()) " " i { (parameter.symbol()) } " at the end" }
                    div class="value" { (parameter.number(estimate.value.into())) small { (parameter.spaced_unit()) } }
                    p class="verdict" {
                        @if estimate.identifiable { "told by this drive" } @else { "cannot be told from this drive" }
                    }
                    p { "95 % interval " (parameter.interval(estimate.interval_95)) (parameter.spaced_unit()) }
                    @if let Some(truth) = last.and_then(|sample| parameter.true_value(sample)) {
                        p class="direct-tests" { "truth " (parameter.quantity(truth)) }
                    }
                }
            }
        }
    }
}

fn wheels(findings: &TraverseFindings) -> Markup {
    html! {
        section {
            h2 { "What the wheels feel" }
            @for quantity in WheelQuantity::ALL { (WheelChart(quantity).svg(&findings.samples)) }
            (legend(findings, false))
        }
    }
}

fn legend(findings: &TraverseFindings, soil: bool) -> Markup {
    let scale = Scale::linear(0.0, 40.0, (0.0, 40.0));
    let height = Scale::linear(0.0, 16.0, (16.0, 0.0));
    let spread = |time_s| Spread { time_s, value: 8.0, inner: [4.0, 12.0], outer: [0.0, 16.0] };
    let mark = |class: &str| spreads(class, &scale, &height, &[spread(0.0), spread(40.0)]);
    let truth = findings.samples.kept().iter().any(|sample| sample.truth.is_some());
    let bands = if soil { "68 % and 95 % interval" } else { "one and two standard deviations" };
    html! {
        ul class="legend" {
            (entry(&format!("estimate, {bands}"), &mark("told")))
            @if soil { (entry("cannot be told from the drive so far", &mark("untold"))) }
            @if truth { (entry("truth", &path("truth", &[(0.0, 8.0), (40.0, 8.0)]))) }
            @if soil && !findings.outcome.soil_changes_us.is_empty() {
                (entry("another soil was noticed", &line("change", (20.0, 0.0), (20.0, 16.0))))
            }
        }
    }
}

fn error_table(errors: &Errors) -> Markup {
    html! {
        section {
            h2 { "Estimates against the truth" }
            p { "Root mean square over all wheels, without the first five seconds. The raw sensors are taken frame by frame or as "
                "a mean of the last second, whichever is better. Honest standard deviations cover about 68 % and 95 %." }
            div class="scroll" {
                table class="numbers" {
                    thead { tr { @for name in errors::HEAD { th { (name) } } } }
                    tbody { @for row in errors::rows(errors) { tr { @for cell in row { td { (cell) } } } } }
                }
            }
        }
    }
}

fn sensors(findings: &TraverseFindings) -> Markup {
    let troubles = troubles(&findings.outcome.estimator);
    let occurred = |reason: &&str| troubles.iter().any(|trouble| trouble.count(reason).is_some());
    let reasons: Vec<&str> = REASONS.into_iter().chain([REPEATS]).filter(occurred).collect();
    let filters: Vec<String> = filter_lines(&findings.outcome).collect();
    html! {
        section {
            h2 { "Sensors" }
            @for line in findings.remarks.iter().chain(&filters) { p { (as_sentence(line)) } }
            @if troubles.is_empty() && filters.is_empty() {
                p { "Every reading of every sensor was used." }
            } @else if !troubles.is_empty() {
                p {
                    "Readings that were not used, of " (findings.outcome.estimator.frames) " frames; all others of these were. "
                    @if reasons.contains(&REPEATS) { "Those of an encoder that are repeated over and over are used, and believed less." }
                }
                div class="scroll" {
                    table class="numbers long" {
                        thead { tr { th {} @for reason in &reasons { th { (reason) } } th {} } }
                        tbody { @for trouble in &troubles { (sensor_row(trouble, &reasons)) } }
                    }
                }
            }
        }
    }
}

fn sensor_row(trouble: &SensorTrouble, reasons: &[&str]) -> Markup {
    html! {
        tr {
            td { code { (trouble.sensor) } }
            @for reason in reasons { td { @if let Some(count) = trouble.counted(reason) { (count) } } }
            td { @if trouble.dropped { "out of use at the end" } }
        }
    }
}

fn chain(findings: &TraverseFindings) -> Markup {
    html! {
        ol class="chain" {
            (link("Sensor frames", &format!("{} of them", findings.outcome.frames), "30 readings each, some may be missing"))
            (link("Filters", "square-root sigma-point", "slip and torque; angle, load and pull"))
            (link("Networks", "frozen, in 16-bit whole numbers", "each wheel, and all together"))
            (link("Soil", "c, φ, K", "averaged over the way, until it changes"))
        }
    }
}

fn of_drive(findings: &TraverseFindings) -> [(&'static str, String); 1] {
    let rover = &findings.rover;
    let assumed = &findings.assumed;
    let source = match (assumed.are_all(), assumed.are_none()) {
        (true, _) => "assumed set K0".to_owned(),
        (_, true) => "as given".to_owned(),
        _ => format!("as given, but for what is assumed (set K0: {assumed})"),
    };
    let words = format!(
        "{source}: {:.1} kg, wheels of {:.0} mm radius and {:.0} mm width",
        rover.mass_kg,
        1e3 * rover.wheel.radius_m,
        1e3 * rover.wheel.width_m
    );
    [("Rover", words)]
}
