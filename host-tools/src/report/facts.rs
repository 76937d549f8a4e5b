//! What is told of the flight computer.

use kapvik_firmware::link::{BootReport, HealthReport};
use kapvik_firmware::network::FLOWN_PAIRS;
use kapvik_firmware::self_test::SelfTestReport;
use maud::{Markup, html};

use crate::digits::significant;
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
    /// The networks that flew, where they are not those of the source tree.
    pub networks: Option<FlownNetworks>,
}

/// Networks that flew in place of those of the source tree.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FlownNetworks {
    /// Their file, and what they were trained with.
    pub in_words: String,
    /// The effects that they were trained with.
    pub effects: String,
}

/// The facts, as a table with what else is to be told.
pub fn table(flight: &FlightFacts, more: &[(&str, String)]) -> Markup {
    html! {
        table class="facts" {
            tbody {
                @for (name, what) in facts(flight).iter().chain(more) { tr { th scope="row" { (name) } td { (what) } } }
            }
        }
        @if !flight.log.is_empty() {
            h3 { "Log of the image" }
            pre { @for line in &flight.log { (line.level.to_uppercase()) " " (line.text) "\n" } }
        }
    }
}

/// The facts, line by line, for the terminal.
pub fn lines(flight: &FlightFacts) -> Vec<String> {
    facts(flight).into_iter().map(|(name, what)| format!("{}: {what}", name.to_lowercase())).collect()
}

fn facts(flight: &FlightFacts) -> Vec<(&'static str, String)> {
    let [major, minor, patch] = flight.boot.firmware_version;
    let image = flight.memory.map(|memory| {
        format!("{} of flash, {} of static memory", kib(memory.flash_bytes), kib(memory.static_ram_bytes))
    });
    [
        Some(("Flight library", format!("version {major}.{minor}.{patch}, {}", place(flight.computer)))),
        Some(("Self-test at boot", self_test(&flight.boot.self_test))),
        flight.networks.as_ref().map(|networks| ("Networks", networks.in_words.clone())),
        image.map(|image| ("Image", image)),
        flight.health.stack_high_water_bytes.map(|stack| ("Deepest stack", kib(stack))),
        Some(("Link", link(&flight.health))),
        Some(("Answers", answers(flight))),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// What only a campaign has to tell.
pub fn of_campaign(findings: &Findings) -> [(&'static str, String); 3] {
    [("Wheel", wheel(findings)), ("Noise of one row", noise(findings)), ("Data", findings.campaign.source.clone())]
}

fn answers(flight: &FlightFacts) -> String {
    let HealthReport { queries_answered, frames_taken, .. } = flight.health;
    let counts = [(frames_taken, "sensor frames"), (queries_answered, "queries")];
    let counts = counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}, "));
    format!("{}fingerprint {}", counts.collect::<String>(), flight.fingerprint)
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
        FLOWN_PAIRS
    )
}

/// How the link did, in words.
pub fn link(health: &HealthReport) -> String {
    let link = &health.link;
    format!(
        "{} messages taken, {} refused, {} gaps, {} repeated, {} replies lost, {} receive errors",
        link.frames_ok,
        link.refused(),
        link.sequence_gaps,
        link.duplicates,
        link.replies_lost,
        link.receive_errors
    )
}

fn kib(bytes: u32) -> String {
    format!("{:.1} KiB", f64::from(bytes) / 1024.0)
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
        format!("{} {what} ({source})", significant(factor * std.std, 2))
    });
    words.join(", ")
}
