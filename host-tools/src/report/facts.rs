//! What is told of the flight computer.

use kapvik_firmware::link::{BootReport, HealthReport};
use kapvik_firmware::network::GOLDEN_PAIRS;
use kapvik_firmware::self_test::SelfTestReport;
use maud::{Markup, html};

use crate::flight_computer::Computer;
use crate::identify::NoiseSource;
use crate::qemu::{LogLine, MemoryUse};

use super::findings::Findings;

/// What is told of the flight computer.
#[derive(Debug, Clone)]
pub struct FlightFacts {
    /// Where the flight library ran.
    pub computer: Computer,
    /// Who answered.
    pub boot: BootReport,
    /// How link and memory did, after the last answer.
    pub health: HealthReport,
    /// What the image takes; none where there is no image.
    pub memory: Option<MemoryUse>,
    /// What it logged.
    pub log: Vec<LogLine>,
    /// See [`super::fingerprint`].
    pub fingerprint: String,
}

/// The facts, as a table.
pub fn table(findings: &Findings) -> Markup {
    let flight = &findings.flight;
    let [major, minor, patch] = flight.boot.firmware_version;
    html! {
        table class="facts" {
            tbody {
                (fact("Flight library", &format!("version {major}.{minor}.{patch}, {}", place(flight.computer))))
                (fact("Self-test at boot", &self_test(&flight.boot.self_test)))
                @if let Some(memory) = &flight.memory {
                    (fact("Image", &format!("{} of flash, {} of static memory", kib(memory.flash_bytes),
                        kib(memory.static_ram_bytes))))
                }
                @if let Some(stack) = flight.health.stack_high_water_bytes { (fact("Deepest stack", &kib(stack))) }
                (fact("Link", &link(&flight.health)))
                (fact("Answers", &format!("{} queries, fingerprint {}", flight.health.queries_answered, flight.fingerprint)))
                (fact("Wheel", &wheel(findings)))
                (fact("Noise of one row", &noise(findings)))
                (fact("Data", &findings.campaign.source))
            }
        }
        @if !flight.log.is_empty() {
            h3 { "Log of the image" }
            pre { @for line in &flight.log { (line.level.to_uppercase()) " " (line.text) "\n" } }
        }
    }
}

/// The facts, line by line, for the terminal.
pub fn lines(findings: &Findings) -> Vec<String> {
    let flight = &findings.flight;
    let [major, minor, patch] = flight.boot.firmware_version;
    let memory = flight.memory.map(|memory| {
        format!("image: {} of flash, {} of static memory", kib(memory.flash_bytes), kib(memory.static_ram_bytes))
    });
    let stack = flight.health.stack_high_water_bytes.map(|stack| format!("deepest stack: {}", kib(stack)));
    [
        Some(format!("flight library: version {major}.{minor}.{patch}, {}", place(flight.computer))),
        Some(format!("self-test at boot: {}", self_test(&flight.boot.self_test))),
        memory,
        stack,
        Some(format!("link: {}", link(&flight.health))),
        Some(format!("answers: {} queries, fingerprint {}", flight.health.queries_answered, flight.fingerprint)),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn fact(name: &str, what: &str) -> Markup {
    html! { tr { th scope="row" { (name) } td { (what) } } }
}

fn place(computer: Computer) -> &'static str {
    match computer {
        Computer::Qemu => "as the flight image on a Cortex-M4F (mps2-an386) in QEMU",
        Computer::Host => "in this process",
    }
}

fn self_test(report: &SelfTestReport) -> String {
    format!(
        "{}: tables {}, golden pairs {} and {} of {}",
        if report.passed() { "passed" } else { "FAILED" },
        if report.tables_intact { "intact" } else { "ALTERED" },
        report.wheel_pairs,
        report.rover_pairs,
        GOLDEN_PAIRS
    )
}

fn link(health: &HealthReport) -> String {
    let link = &health.link;
    format!(
        "{} frames taken, {} refused, {} gaps, {} replies lost",
        link.frames_ok,
        link.refused(),
        link.sequence_gaps,
        link.replies_lost
    )
}

fn kib(bytes: u32) -> String {
    format!("{:.1} KiB", f64::from(bytes) / 1024.0)
}

/// A number rounded to two significant digits.
fn two_digits(value: f64) -> String {
    let text: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    text.to_string()
}

fn wheel(findings: &Findings) -> String {
    let (wheel, grousers) = (&findings.campaign.wheel, &findings.campaign.grousers);
    let rim = match grousers.count {
        0 => "smooth".to_owned(),
        count => format!("{count} grousers of {:.1} mm", 1e3 * grousers.height_m),
    };
    format!("radius {:.1} mm, width {:.1} mm, {rim}", 1e3 * wheel.radius_m, 1e3 * wheel.width_m)
}

fn noise(findings: &Findings) -> String {
    let noise = &findings.identification.noise;
    let channels = [
        (noise.drawbar_pull, 1.0, "N of drawbar pull"),
        (noise.load, 1.0, "N of load"),
        (noise.torque, 1.0, "N·m of torque"),
        (noise.slip, 1.0, "of slip"),
        (noise.sinkage, 1e3, "mm of sinkage"),
    ];
    let words = channels.map(|(std, factor, what)| {
        let source = match std.source {
            NoiseSource::Campaign => "stated",
            NoiseSource::Repeats => "from repeats",
            NoiseSource::FlightSensors => "assumed, as the flight sensors",
        };
        format!("{} {what} ({source})", two_digits(factor * std.std))
    });
    words.join(", ")
}
