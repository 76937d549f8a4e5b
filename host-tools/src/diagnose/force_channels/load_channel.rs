//! The load against its set levels.

use crate::data::campaign::Channel;

use super::load_levels::{LoadLevels, LoadReading};
use super::regression::{Problem, Term, without_gaps};
use super::sources::{SensorRows, Source};

/// Powers of the slip that the forces are seen through.
const POWERS: i32 = 4;

/// What the load may follow.
const SOURCES: [Source; 6] = [
    Source {
        id: "guide-friction",
        form: "load",
        parameter: "mu",
        channel: Channel::DrawbarPull,
        value: |pull_n| -pull_n.abs(),
        by_instruments: true,
    },
    Source {
        id: "crosstalk",
        form: "drawbar pull into load",
        parameter: "drawbar_pull_to_load",
        channel: Channel::DrawbarPull,
        value: |pull_n| pull_n,
        by_instruments: true,
    },
    Source {
        id: "crosstalk",
        form: "torque into load",
        parameter: "torque_to_load_per_m",
        channel: Channel::Torque,
        value: |torque_nm| torque_nm,
        by_instruments: true,
    },
    Source {
        id: "crosstalk",
        form: "side force into load",
        parameter: "side_force_to_load",
        channel: Channel::SideForce,
        value: |side_n| side_n,
        by_instruments: true,
    },
    Source {
        id: "force-drift",
        form: "load with hours",
        parameter: "load_n_per_h",
        channel: Channel::HoursSinceZero,
        value: |hours| hours,
        by_instruments: false,
    },
    Source {
        id: "force-drift",
        form: "load with temperature",
        parameter: "load_n_per_c",
        channel: Channel::Temperature,
        value: |temperature_c| temperature_c,
        by_instruments: false,
    },
];

/// The load where it comes in levels, each with an intercept of its own; none where it does not, or where nothing moves that
/// it could follow. A drift with temperature has no zero of its own here: the intercepts take it up.
pub fn load_channel(of: &SensorRows<'_>) -> Option<Problem> {
    let campaign = of.campaign();
    let sources = of.available(&SOURCES);
    let mut needed = vec![Channel::Load];
    needed.extend(sources.iter().map(|source| source.channel));
    let by_slip = sources.iter().any(|source| source.by_instruments);
    needed.extend(by_slip.then_some(Channel::Slip));
    let angled = by_slip && of.varies(Channel::SlipAngle);
    needed.extend(angled.then_some(Channel::SlipAngle));
    let rows = of.complete(&needed);
    let runs = of.run_numbers();
    let value = |row: usize, channel| campaign.value(row, channel).unwrap_or(0.0);
    let loads: Vec<_> =
        rows.iter().map(|row| LoadReading { run: runs[*row], load_n: value(*row, Channel::Load) }).collect();
    let levels = LoadLevels::of(&loads)?;
    let kept: Vec<(usize, usize)> =
        rows.iter().zip(&levels.of_reading).filter_map(|(row, level)| Some((*row, (*level)?))).collect();
    let column =
        |of: &dyn Fn(usize, usize) -> f64| kept.iter().map(|(row, level)| of(*row, *level)).collect::<Vec<_>>();
    let intercept = |number| column(&|_, level| if level == number { 1.0 } else { 0.0 });
    // Forces at a slip grow with the load: so do their stand-ins.
    let largest_n = levels.means_n.last().copied().unwrap_or(1.0);
    let scaled = |level: usize| levels.means_n[level] / largest_n;
    let mut instruments: Vec<Vec<f64>> =
        (1..=POWERS).map(|power| column(&|row, level| scaled(level) * value(row, Channel::Slip).powi(power))).collect();
    if angled {
        instruments.push(column(&|row, level| scaled(level) * value(row, Channel::SlipAngle)));
        instruments.push(column(&|row, level| scaled(level) * value(row, Channel::SlipAngle).abs()));
    }
    let term = |source: &&Source| Term {
        id: source.id,
        form: source.form,
        parameter: source.parameter,
        values: column(&|row, _| (source.value)(value(row, source.channel))),
        by_instruments: source.by_instruments,
    };
    let terms: Vec<Term> = sources.iter().map(term).collect();
    (!terms.is_empty()).then(|| Problem {
        channel: Channel::Load,
        readings_n: column(&|row, _| value(row, Channel::Load)),
        run: without_gaps(&kept.iter().map(|(row, _)| runs[*row]).collect::<Vec<_>>()),
        fixed: (0..levels.means_n.len()).map(intercept).collect(),
        instruments,
        terms,
    })
}
