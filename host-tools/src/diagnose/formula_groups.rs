//! The dimensionless groups of a campaign's rows, and the scale that makes a channel of one.

use kapvik_firmware::terramechanics::Soil;

use crate::data::campaign::Channel;

use super::bench::Bench;
use super::fit::Reading;
use super::formula::{Group, figure, rounded};
use super::linearised::Linearised;
use super::measurements::{KNOWN_SHARE, median};
use super::regressors::{causes, other_causes, values};
use super::trial::Trial;
use crate::statistics::{centred, correlation};

/// Spread over size below which a column does not vary.
const FLAT: f64 = 1e-3;
/// Correlation beyond which two groups say the same.
const SAME: f64 = 0.999;
/// Degrees of temperature that count as one.
const DEGREES: f64 = 10.0;

/// What makes a channel of a dimensionless number.
#[derive(Debug, Clone)]
pub struct Scale {
    /// How it is written.
    pub symbol: &'static str,
    /// Its value in each row, in the channel's unit.
    pub values: Vec<f64>,
}

/// The scale of a channel: the load for forces, with the radius for a torque, the radius for a sinkage. The load is the one at which the model was
/// linearised: that which was fitted follows the residuals that a law is to explain.
pub fn scale(bench: &Bench<'_>, linearised: &Linearised<'_>, channel: Reading) -> Scale {
    let radius_m = bench.campaign.wheel.radius_m;
    let loads: Vec<f64> = linearised.latents().iter().map(|latent| latent.load_n).collect();
    match channel {
        Reading::Torque => Scale { symbol: "r W", values: loads.iter().map(|load| radius_m * load).collect() },
        Reading::Sinkage => Scale { symbol: "r", values: vec![radius_m; loads.len()] },
        _ => Scale { symbol: "W", values: loads },
    }
}

/// Every group that the campaign's columns allow, those of the columns in `first` before all others.
pub fn groups(bench: &Bench<'_>, trial: &Trial<'_>, linearised: &Linearised<'_>, first: &[&str]) -> Vec<Group> {
    let mut all = of_contact(bench, trial, linearised);
    let contact = [Channel::Slip, Channel::Load, Channel::Sinkage];
    let beside = causes().filter(|channel| !contact.contains(channel));
    all.extend(beside.flat_map(|channel| of_channel(bench, linearised, channel)));
    let others = other_causes(bench.campaign);
    all.extend(others.filter_map(|name| of_unknown(name, &column(bench, linearised, name)?)));
    all.sort_by_key(|group| !first.contains(&group.column.as_str()));
    let mut found: Vec<Group> = Vec::new();
    for group in all.into_iter().filter(varies) {
        if !found.iter().any(|other| correlation(&centred(&other.values), &centred(&group.values)).abs() > SAME) {
            found.push(group);
        }
    }
    found
}

/// Slip, sinkage and load where the model was linearised: errors of measured ones would be common to both sides of a law.
fn of_contact(bench: &Bench<'_>, trial: &Trial<'_>, linearised: &Linearised<'_>) -> Vec<Group> {
    let wheel = &bench.campaign.wheel;
    let Soil { sinkage_exponent, frictional_modulus, .. } = trial.model.soil(&trial.fit.parameters);
    let reference_n = frictional_modulus * wheel.width_m * wheel.radius_m.powf(1.0 + sinkage_exponent);
    let slips = linearised.latents().iter().map(|latent| latent.slip).collect();
    let sinkages = linearised.expected(Reading::Sinkage).map(|sinkage_m| sinkage_m / wheel.radius_m).collect();
    let loads = linearised.latents().iter().map(|latent| latent.load_n / reference_n).collect();
    vec![
        group("slip".to_owned(), Channel::Slip.name(), slips),
        group("(z/r)".to_owned(), Channel::Sinkage.name(), sinkages),
        group("(W/(k b r^(1+n)))".to_owned(), Channel::Load.name(), loads),
    ]
}

/// The groups of a column that the format names.
fn of_channel(bench: &Bench<'_>, linearised: &Linearised<'_>, channel: Channel) -> Vec<Group> {
    let name = channel.name();
    let Some(values) = column(bench, linearised, name) else { return Vec::new() };
    let of = |symbol: String, law: &dyn Fn(f64) -> f64| {
        group(symbol, name, values.iter().map(|value| law(*value)).collect())
    };
    let middle = rounded(median(values.clone()).unwrap_or(0.0));
    let typical = rounded(median(values.iter().map(|value| value.abs()).collect()).unwrap_or(0.0));
    let radius_m = bench.campaign.wheel.radius_m;
    match channel {
        Channel::Temperature => {
            let symbol = format!("({}/{DEGREES})", less(name, middle));
            vec![of(symbol, &|value| (value - middle) / DEGREES)]
        }
        Channel::Pass => vec![of(format!("({name} - 1)"), &|value| value - 1.0)],
        Channel::HoursSinceZero => vec![of(format!("({name}/1 h)"), &|value| value)],
        Channel::Travel => vec![of(format!("({name}/r)"), &|value| value / radius_m)],
        Channel::Pitch | Channel::SlipAngle => vec![of(name.to_owned(), &|value| value)],
        Channel::WheelAngle => {
            let wave = |symbol: &str, law: &dyn Fn(f64) -> f64| Group {
                has_shapes: false,
                ..of(format!("{symbol}({name})"), law)
            };
            vec![wave("sin", &f64::sin), wave("cos", &f64::cos)]
        }
        _ if typical > 0.0 => vec![of(format!("({name}/{})", figure(typical)), &|value| value / typical)],
        _ => Vec::new(),
    }
}

/// The group of a column that the format does not name: over its middle size, or about its mean where it changes sign.
fn of_unknown(name: &str, values: &[f64]) -> Option<Group> {
    let both = values.iter().any(|value| *value < 0.0) && values.iter().any(|value| *value > 0.0);
    let (from, over) = if both {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        (rounded(mean), rounded((values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()))
    } else {
        (0.0, rounded(median(values.iter().map(|value| value.abs()).collect())?))
    };
    let symbol = format!("({}/{})", less(name, from), figure(over));
    (over > 0.0).then(|| group(symbol, name, values.iter().map(|value| (value - from) / over).collect()))
}

/// A column less a number, as it is written.
fn less(name: &str, from: f64) -> String {
    match from {
        0.0 => name.to_owned(),
        below if below < 0.0 => format!("({name} + {})", figure(-below)),
        _ => format!("({name} - {})", figure(from)),
    }
}

/// A column's value in each row, its middle one where it is not known; none where that is often.
fn column(bench: &Bench<'_>, linearised: &Linearised<'_>, name: &str) -> Option<Vec<f64>> {
    let known: Vec<_> =
        values(bench, linearised.latents(), name).into_iter().map(|value| value.filter(|v| v.is_finite())).collect();
    let middle = median(known.iter().flatten().copied().collect())?;
    let share = known.iter().flatten().count() as f64 / known.len() as f64;
    (share >= KNOWN_SHARE).then(|| known.into_iter().map(|value| value.unwrap_or(middle)).collect())
}

fn group(symbol: String, column: &str, values: Vec<f64>) -> Group {
    Group { symbol, column: column.to_owned(), values, has_shapes: true }
}

fn varies(group: &Group) -> bool {
    let size = group.values.iter().map(|value| value.abs()).fold(0.0, f64::max);
    centred(&group.values).iter().any(|value| value.abs() > FLAT * size)
}
