//! The side force of a wheel that runs straight: a symmetric wheel has none.

use crate::data::campaign::Channel;

use super::regression::{Problem, Term, without_gaps};
use super::sources::{SensorRows, Source};

/// Temperature of no offset, °C: the neutral one of the effect's catalogue entry.
const REFERENCE_C: f64 = 20.0;

/// What the side force may follow, besides a constant.
const SOURCES: [Source; 4] = [
    Source {
        id: "force-drift",
        form: "side force with hours",
        parameter: "side_force_n_per_h",
        channel: Channel::HoursSinceZero,
        value: |hours| hours,
        by_instruments: false,
    },
    Source {
        id: "force-drift",
        form: "side force with temperature",
        parameter: "side_force_n_per_c",
        channel: Channel::Temperature,
        value: |temperature_c| temperature_c - REFERENCE_C,
        by_instruments: false,
    },
    Source {
        id: "crosstalk",
        form: "drawbar pull into side force",
        parameter: "drawbar_pull_to_side_force",
        channel: Channel::DrawbarPull,
        value: |pull_n| pull_n,
        by_instruments: false,
    },
    Source {
        id: "crosstalk",
        form: "load into side force",
        parameter: "load_to_side_force",
        channel: Channel::Load,
        value: |load_n| load_n,
        by_instruments: false,
    },
];

/// The side force; none where it is not measured, or the wheel runs at an angle.
pub fn side_channel(of: &SensorRows<'_>) -> Option<Problem> {
    let campaign = of.campaign();
    let angles = campaign.column(Channel::SlipAngle.name());
    let angled = angles.is_some_and(|column| column.iter().flatten().any(|angle| *angle != 0.0));
    if angled || !of.varies(Channel::SideForce) {
        return None;
    }
    let sources = of.available(&SOURCES);
    let mut needed = vec![Channel::SideForce];
    needed.extend(sources.iter().map(|source| source.channel));
    let rows = of.complete(&needed);
    let runs = of.run_numbers();
    let column = |channel: Channel, of: fn(f64) -> f64| {
        rows.iter().map(|row| campaign.value(*row, channel).map_or(0.0, of)).collect::<Vec<f64>>()
    };
    let constant = Term {
        id: "force-bias",
        form: "side force",
        parameter: "side_force_n",
        values: vec![1.0; rows.len()],
        by_instruments: false,
    };
    let term = |source: &&Source| Term {
        id: source.id,
        form: source.form,
        parameter: source.parameter,
        values: column(source.channel, source.value),
        by_instruments: source.by_instruments,
    };
    Some(Problem {
        channel: Channel::SideForce,
        readings_n: column(Channel::SideForce, |side_n| side_n),
        run: without_gaps(&rows.iter().map(|row| runs[*row]).collect::<Vec<_>>()),
        fixed: Vec::new(),
        instruments: Vec::new(),
        terms: std::iter::once(constant).chain(sources.iter().map(term)).collect(),
    })
}
