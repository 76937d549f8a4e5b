//! What a reader must know before believing a number.

use kapvik_firmware::soil::SoilEstimate;

use crate::data::campaign::{Campaign, Channel, Provenance};
use crate::identify::{IdentifiedRun, NoiseSource};

use super::findings::{EstimateRow, Findings, RowKind};
use super::residual::LeftOver;
use super::verdict::Verdict;
use crate::parameter::Parameter;
use crate::statistics::ends;

/// Loads closer together than this share are one load.
const ONE_LOAD: f64 = 0.1;
/// Runs that are named one by one.
const RUNS_NAMED: usize = 3;
/// A residual greater than so many standard deviations is not noise.
const BEYOND_NOISE: f64 = 3.0;

/// The caveats that hold for these findings, in plain sentences.
pub fn caveats(findings: &Findings) -> Vec<String> {
    [
        Some(provenance(&findings.campaign)),
        noise(findings),
        one_load(findings),
        widened(findings),
        explained_by_no_soil(findings),
        cannot_be_told(findings),
        doubtful(findings),
        missing_physics(findings),
        declared(findings),
    ]
    .into_iter()
    .flatten()
    .chain(findings.campaign.remarks())
    .chain(findings.campaign.notes.iter().cloned())
    .collect()
}

fn provenance(campaign: &Campaign) -> String {
    match campaign.provenance {
        Provenance::Measured => "The wheel states were measured by instruments.".to_owned(),
        Provenance::Digitised => {
            "The wheel states were measured, but are read off published curves: they are means, to \
            about two digits, and how each repeat scattered is lost."
                .to_owned()
        }
        Provenance::Simulated => "The wheel states are simulated, not measured.".to_owned(),
    }
}

fn noise(findings: &Findings) -> Option<String> {
    let noise = &findings.identification.noise;
    let channels = [
        (Channel::DrawbarPull, "drawbar pull", noise.drawbar_pull),
        (Channel::Load, "load", noise.load),
        (Channel::Torque, "torque", noise.torque),
        (Channel::Slip, "slip", noise.slip),
        (Channel::Sinkage, "sinkage", noise.sinkage),
    ];
    let measured = channels.into_iter().filter(|(channel, ..)| findings.campaign.column(channel.name()).is_some());
    let assumed: Vec<&str> =
        measured.filter(|(_, _, std)| std.source == NoiseSource::FlightSensors).map(|(_, name, _)| name).collect();
    (!assumed.is_empty()).then(|| {
        format!(
            "The campaign does not say how noisy {} is; the noise of the rover's own sensors is assumed.",
            assumed.join(", ")
        )
    })
}

fn one_load(findings: &Findings) -> Option<String> {
    let campaign = &findings.campaign;
    let (low, high) = ends(campaign.sound_rows().filter_map(|row| campaign.value(row, Channel::Load)))?;
    (high <= (1.0 + ONE_LOAD) * low).then(|| {
        "Every state has one load. Cohesion and friction can then stand in for each other: the same forces come from more \
         of one and less of the other. One wheel at one load cannot tell cohesion; where several slips together seem to, \
         they lean on equations 1–11 being exact."
            .to_owned()
    })
}

/// Where the networks are too sure of runs laid out as these.
fn widened(findings: &Findings) -> Option<String> {
    let runs = &findings.identification.runs;
    let words: Vec<String> = runs
        .iter()
        .filter_map(|run| {
            Some(format!("run {}: {}", run.states.run, run.question.as_ref()?.missing.as_ref()?.in_words("networks'")?))
        })
        .collect();
    (!words.is_empty()).then(|| {
        format!("Intervals of all states together are wider than the networks state them; {}.", words.join("; "))
    })
}

fn cannot_be_told(findings: &Findings) -> Option<String> {
    let best = findings.identification.runs.iter().filter_map(Findings::best).filter_map(|row| row.estimate.ok());
    let soils: Vec<SoilEstimate> = best.collect();
    let untold = |parameter: &Parameter| soils.iter().any(|soil| !parameter.of(soil).identifiable);
    let symbols: Vec<&str> = Parameter::ALL.into_iter().filter(untold).map(Parameter::symbol).collect();
    (!symbols.is_empty()).then(|| {
        format!(
            "\u{201c}Cannot be told\u{201d} ({} here, all states together) means that the data removed less than half of \
             the variance that there was before them. The value is then mostly the middle of what the training \
             allowed.",
            symbols.join(", ")
        )
    })
}

/// The runs that no soil explains.
fn explained_by_no_soil(findings: &Findings) -> Option<String> {
    let runs = &findings.identification.runs;
    let named = |run: &IdentifiedRun| run.misfit.as_ref().map(|why| format!("{}: {why}", run.states.run));
    let told: Vec<String> = runs.iter().filter_map(named).collect();
    (!told.is_empty()).then(|| {
        format!(
            "Run {}. `kapvik diagnose` says what the model may lack.",
            told.iter().take(RUNS_NAMED).cloned().collect::<Vec<_>>().join("; run ")
        )
    })
}

/// Where the networks are sure of what other means deny, or of the end of what they were trained for.
fn doubtful(findings: &Findings) -> Option<String> {
    let ground = &findings.campaign.ground;
    let best: Vec<EstimateRow> = findings.identification.runs.iter().filter_map(Findings::best).collect();
    let doubted = |parameter: &Parameter| {
        let verdict = |row: &EstimateRow| Some(Verdict::of(*parameter, row.estimate.as_ref().ok()?, ground, true));
        best.iter().filter_map(verdict).any(|verdict| verdict.is_doubtful() && verdict != Verdict::InDoubtfulCompany)
    };
    let symbols: Vec<&str> = Parameter::ALL.into_iter().filter(doubted).map(Parameter::symbol).collect();
    (!symbols.is_empty()).then(|| {
        format!(
            "The networks are sure of {} with all states together, and direct tests or the edge of the training speak \
             against it. Noise does not explain that: the wheel does something that the networks were not trained with.",
            symbols.join(" and ")
        )
    })
}

/// Where the equations with the directly measured soil miss the sinkage or the forces by more than what is not known explains.
fn missing_physics(findings: &Findings) -> Option<String> {
    let missed = missed_channels(findings)?;
    let ground = &findings.campaign.ground;
    let is_peak_known = ground.peak_stress_c1.is_some() && ground.peak_stress_c2.is_some();
    let is_unexplained = is_unexplained(findings);
    let or_peak = if is_peak_known || is_unexplained {
        ""
    } else {
        ", or the stress peaks elsewhere than assumed (c1 and c2 are not both stated)"
    };
    let beyond = if is_unexplained {
        "noise or any other soil explains"
    } else {
        "noise and the stated uncertainty of that soil explain"
    };
    (!missed.is_empty()).then(|| {
        format!(
            "Equations 1–11 are not the whole truth here{or_peak}: with the soil that direct tests measured they miss {} (root mean \
             square), more than {beyond}. The networks were trained {}, so they may put what is missing \
             into c, φ and K, and an interval may exclude the truth. Curves that pass through the points are no proof that \
             the parameters behind them are right.",
            missed.join(", "),
            match &findings.flight.networks {
                None => "on these equations alone".to_owned(),
                Some(networks) => format!("on these equations with effects ({})", networks.effects),
            }
        )
    })
}

/// Whether a run has been held against all soils that what is stated leaves room for, and none explains it.
fn is_unexplained(findings: &Findings) -> bool {
    findings.identification.runs.iter().any(|run| run.misfit.is_some())
}

/// The channels that the equations miss, and by how much; none where the soil is not known. What is not known of the soil explains nothing
/// where no other soil does.
fn missed_channels(findings: &Findings) -> Option<Vec<String>> {
    let model = findings.model.as_ref()?;
    let is_unexplained = is_unexplained(findings);
    let of_soil = if is_unexplained { LeftOver::default() } else { model.uncertainty(&findings.campaign) };
    let (rms, noise) = (model.rms(), &findings.identification.noise);
    let channels = [
        ("drawbar pull", rms.drawbar_pull_n, of_soil.drawbar_pull_n, noise.drawbar_pull.std, 1.0, "N"),
        ("torque", rms.torque_nm, of_soil.torque_nm, noise.torque.std, 1.0, "N·m"),
        ("sinkage", rms.sinkage_m, of_soil.sinkage_m, noise.sinkage.std, 1e3, "mm"),
    ];
    let missed = channels.into_iter().filter_map(|(name, rms, of_soil, std, factor, unit)| {
        let rms = rms?;
        let explained = std.hypot(of_soil.unwrap_or(0.0));
        (rms > BEYOND_NOISE * explained).then(|| format!("{name} by {:.1} {unit}", factor * rms))
    });
    Some(missed.collect())
}

fn declared(findings: &Findings) -> Option<String> {
    let ids = findings.campaign.declared.ids();
    (!ids.is_empty()).then(|| {
        let ids = ids.join(", ");
        match &findings.flight.networks {
            None => format!("The campaign declares effects ({ids}) that these networks were not trained with."),
            Some(networks) => {
                format!("The campaign declares effects: {ids}. These networks were trained with: {}.", networks.effects)
            }
        }
    })
}

/// What the networks make of the sinkage, for the legend of the lines.
pub fn kind_in_words(kind: RowKind) -> &'static str {
    match kind {
        RowKind::Wheel => "one wheel by itself: per-wheel network, no sinkage",
        RowKind::RoverWithoutSinkage => "all states as the wheels of one instant: rover network, no sinkage",
        RowKind::RoverWithSinkage => "all states as the wheels of one instant: rover network, with sinkage z",
    }
}
