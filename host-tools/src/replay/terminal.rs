//! What came of a replay, in lines for the terminal.

use kapvik_firmware::fusion::RoverSoil;
use kapvik_firmware::soil::ParameterEstimate;

use super::{Outcome, REASONS, REPEATS, troubles};
use crate::digits::counted;
use crate::identify::{OUTSIDE, network_refusal};

/// The outcome, line by line.
pub fn lines(outcome: &Outcome) -> Vec<String> {
    let mut lines = vec![format!(
        "{}, {:.1} s of driving, in {:.2} s: {:.0} frames/s, {:.0} times real time",
        counted(outcome.frames, "frame", "frames"),
        outcome.driven_s(),
        outcome.took.as_secs_f64(),
        outcome.frames_per_second(),
        outcome.times_real_time(),
    )];
    lines.push(match &outcome.soil {
        Ok(soil) => soil_line(soil),
        Err(reason) => format!("soil at the end: no estimate: {}", network_refusal(*reason)),
    });
    lines.extend(change_line(outcome));
    lines.extend(outcome.doubts.iter().cloned());
    lines.extend(seldom(outcome));
    lines.extend(filter_lines(outcome));
    lines.extend(sensor_lines(outcome));
    lines
}

fn soil_line(soil: &RoverSoil) -> String {
    let estimate = &soil.estimate;
    let shown = |parameter: &ParameterEstimate, factor: f32, digits: usize| {
        let mark = if parameter.identifiable { "" } else { " ?" };
        format!("{:.digits$} ± {:.digits$}{mark}", factor * parameter.value, factor * parameter.std)
    };
    let outside = match estimate.outside_training_range {
        true => format!("; {OUTSIDE}"),
        false => String::new(),
    };
    format!(
        "soil at the end: c {} Pa, φ {}°, K {} mm (± one standard deviation; ? = cannot be told from these data){outside}",
        shown(&estimate.cohesion_pa, 1.0, 0),
        shown(&estimate.friction_angle_rad, 1_f32.to_degrees(), 1),
        shown(&estimate.shear_modulus_m, 1e3, 1),
    )
}

/// When another soil was noticed; a long drive over many soils is cut short.
fn change_line(outcome: &Outcome) -> Option<String> {
    const TOLD: usize = 12;
    let changes = &outcome.soil_changes_us;
    let times: Vec<String> = changes.iter().take(TOLD).map(|time| format!("{:.1} s", 1e-6 * *time as f64)).collect();
    let more = match changes.len().saturating_sub(TOLD) {
        0 => String::new(),
        more => format!(" and {more} times more"),
    };
    (!times.is_empty()).then(|| format!("another soil noticed at {}{more}", times.join(", ")))
}

/// Said where most frames come so long after each other that the filters start anew.
fn seldom(outcome: &Outcome) -> Option<String> {
    let is_seldom = outcome.frames > 2 && 2 * u64::from(outcome.estimator.gaps) > outcome.frames;
    is_seldom.then(|| {
        let step_s = outcome.driven_s() / (outcome.frames - 1) as f64;
        format!("frames are {step_s:.0} s apart, too far to drive by: is t_s in seconds?")
    })
}

/// What the filters count and what is not zero.
pub fn filter_lines(outcome: &Outcome) -> impl Iterator<Item = String> {
    let health = &outcome.estimator;
    let counters = [
        ("frames repeated", health.repeated_frames),
        ("frames out of time", health.backward_frames),
        ("gaps, or clocks set back, after which the filters started anew", health.gaps),
        ("filters reset to their floor", health.filter_resets),
        ("filters that started anew, as readings contradicted them for long", health.relearned),
    ];
    counters.into_iter().filter(|(_, count)| *count > 0).map(|(what, count)| format!("{what}: {count}"))
}

/// For each reason the sensors whose readings were not used, with how many.
fn sensor_lines(outcome: &Outcome) -> Vec<String> {
    let troubles = troubles(&outcome.estimator);
    let of_reason = |reason: &str| -> Vec<String> {
        let counts =
            troubles.iter().filter_map(|trouble| Some(format!("{} {}", trouble.sensor, trouble.counted(reason)?)));
        counts.collect()
    };
    let unused = REASONS.into_iter().map(|reason| (format!("readings not used, {reason}"), of_reason(reason)));
    let repeated = ("readings that say the same over and over, believed less".to_owned(), of_reason(REPEATS));
    let dropped: Vec<String> =
        troubles.iter().filter(|trouble| trouble.dropped).map(|trouble| trouble.sensor.clone()).collect();
    unused
        .chain([repeated, ("sensors out of use at the end".to_owned(), dropped)])
        .filter(|(_, sensors)| !sensors.is_empty())
        .map(|(what, sensors)| format!("{what}: {}", sensors.join(", ")))
        .collect()
}
