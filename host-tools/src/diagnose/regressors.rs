//! What a residual may follow: every column of a campaign, and products of two.

use std::sync::Arc;

use kapvik_firmware::terramechanics::effects::speed_ratio;

use crate::data::campaign::{Campaign, Channel};

use super::bench::Bench;
use super::candidates::{loads_differ, rates_differ};
use super::contact_again::{is_second_sensor, says_no_more};
use super::fit::{Latent, Reading};
use super::linearised::{Linearised, Slopes, Term};
use super::loose_slip::is_clock;
use super::measurements::{KNOWN_SHARE, Measurements, column_name};
use super::rates::speed_ratio_by_slip;
use crate::statistics::{correlation, sorted};

/// A column, or a product of two, about zero and one in size. What is made of slip, load, sinkage or speed is a function of
/// the true slip and load as they were fitted, not of their readings.
#[derive(Debug, Clone)]
pub struct Regressor {
    /// Its value in each row; 0 where the row does not have it.
    pub term: Term,
    /// Of a product, what it is made of.
    pub factors: Vec<Term>,
    /// Of an angle of the wheel, its sine and its cosine.
    pub turns: Option<[Term; 2]>,
    /// Different values that it takes: a power as high or higher says nothing more than the lower ones.
    pub values: usize,
    parts: Vec<Part>,
}

/// A column that a regressor is made of.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    name: String,
    /// Other columns that say the same in these rows.
    also: Vec<String>,
    /// Whether it is slip, load or sinkage, or says no more than these do, as the rate of a wheel whose carriage keeps its speed, or measures
    /// again what the contact does, as a second sensor of the sinkage.
    is_of_contact: bool,
}

/// Values that a column must take.
const LEAST_VALUES: usize = 2;
/// Correlation beyond which two columns say the same.
const SAME: f64 = 0.999;
impl Regressor {
    /// The names of the columns that it is made of: one, or of a product two.
    pub fn columns(&self) -> Vec<String> {
        self.parts.iter().map(|part| part.name.clone()).collect()
    }

    /// Other columns that say in these rows what one of its own does.
    pub fn also(&self) -> Vec<String> {
        self.parts.iter().flat_map(|part| part.also.iter().cloned()).collect()
    }

    /// Whether it is made of what a channel reads.
    pub fn contains(&self, reading: Reading) -> bool {
        self.parts.iter().any(|part| part.name == column_name(reading))
    }

    /// Whether it is made of slip, load and sinkage alone, or of what says no more than they do or measures the contact again.
    pub fn is_of_contact(&self) -> bool {
        self.parts.iter().all(|part| part.is_of_contact)
    }

    /// Of a product, those factors that are so.
    pub fn contact_factors(&self) -> impl Iterator<Item = &Term> {
        self.factors.iter().zip(&self.parts).filter(|(_, part)| part.is_of_contact).map(|(term, _)| term)
    }
}

impl Part {
    fn of(name: &str, values: &[Option<f64>], measurements: &Measurements, latents: &[Latent]) -> Self {
        let is_contact = CONTACT.iter().any(|reading| name == column_name(*reading));
        let is_of_contact = || says_no_more(values, latents) || is_second_sensor(name, values, measurements, latents);
        Self { name: name.to_owned(), also: Vec::new(), is_of_contact: is_contact || is_of_contact() }
    }
}

/// What the contact itself is made of.
const CONTACT: [Reading; 3] = [Reading::Slip, Reading::Load, Reading::Sinkage];

/// The columns of a campaign that vary, the ones that the format names first, about a fitted model.
pub fn columns(bench: &Bench<'_>, linearised: &Linearised<'_>) -> Vec<Regressor> {
    let mut names: Vec<&str> = causes().filter(|channel| *channel != Channel::Time).map(Channel::name).collect();
    names.extend(other_causes(bench.campaign));
    // What rises steadily through a run does more than a clock.
    names.push(Channel::Time.name());
    // About one level they scatter by their errors.
    let one_level =
        [(Channel::WheelRate, !rates_differ(bench.measurements)), (Channel::Load, !loads_differ(bench.measurements))];
    names.retain(|name| one_level.iter().all(|(channel, is_one)| !is_one || *name != channel.name()));
    let at: Arc<[[f64; 2]]> = linearised.latents().iter().map(|latent| [latent.slip, latent.load_n]).collect();
    let mut found: Vec<Regressor> = Vec::new();
    for name in names {
        let column = column(bench, linearised, name);
        let is_contact = CONTACT.iter().any(|reading| name == column_name(*reading));
        if bench.measurements.loose_slip.is_some() && !is_contact && is_clock(bench.measurements, &column.values) {
            continue;
        }
        let part = Part::of(name, &column.values, bench.measurements, linearised.latents());
        let Some(regressor) = standardised(vec![part], &column, &at) else { continue };
        let says_the_same =
            |other: &&mut Regressor| correlation(&other.term.values, &regressor.term.values).abs() > SAME;
        if let Some(other) = found.iter_mut().find(says_the_same) {
            other.parts.iter_mut().for_each(|part| part.also.push(name.to_owned()));
            continue;
        }
        let turns = (name == Channel::WheelAngle.name()).then(|| turns(&column.values));
        found.push(Regressor { turns, ..regressor });
    }
    found
}

/// A column as it stands: its value in each row, and how that follows the true slip and load.
struct Column {
    values: Vec<Option<f64>>,
    by: Option<Vec<[f64; 2]>>,
}

fn column(bench: &Bench<'_>, linearised: &Linearised<'_>, name: &str) -> Column {
    let latents = linearised.latents();
    let own = values(bench, latents, name);
    let constant = |by: [f64; 2]| vec![by; latents.len()];
    match Channel::from_name(name) {
        Some(Channel::Slip) => Column { values: own, by: Some(constant([1.0, 0.0])) },
        Some(Channel::Load) => Column { values: own, by: Some(constant([0.0, 1.0])) },
        Some(Channel::Sinkage) if own.iter().any(Option::is_some) => Column {
            values: linearised.expected(Reading::Sinkage).map(Some).collect(),
            by: Some(linearised.slopes(Reading::Sinkage).collect()),
        },
        Some(Channel::Speed) => {
            let rim_speeds = bench.measurements.rim_speeds_m_s();
            let by = |(rim, latent): (Option<f64>, &Latent)| {
                [rim.map_or(0.0, |rim| rim * speed_ratio_by_slip(latent.slip)), 0.0]
            };
            Column { values: own, by: Some(rim_speeds.zip(latents).map(by).collect()) }
        }
        _ => Column { values: own, by: None },
    }
}

/// What a column says in each row; of slip, load and speed, where there is such a column, what it should say at the true slips
/// and loads.
pub(super) fn values(bench: &Bench<'_>, latents: &[Latent], name: &str) -> Vec<Option<f64>> {
    let (campaign, measurements) = (bench.campaign, bench.measurements);
    let read = || {
        let of_row = |place: &usize| {
            if name == Channel::Time.name() {
                Some(campaign.rows().get(*place)?.t_s)
            } else {
                *campaign.column(name)?.get(*place)?
            }
        };
        measurements.places.iter().map(of_row).collect::<Vec<_>>()
    };
    match Channel::from_name(name) {
        Some(_) if campaign.column(name).is_none() && name != Channel::Time.name() => vec![None; latents.len()],
        Some(Channel::Slip) => latents.iter().map(|latent| Some(latent.slip)).collect(),
        Some(Channel::Load) => latents.iter().map(|latent| Some(latent.load_n)).collect(),
        Some(Channel::Speed) => {
            let rim_speeds = measurements.rim_speeds_m_s();
            let followed = |((rim, latent), read): ((Option<f64>, &Latent), Option<f64>)| {
                rim.map(|rim| rim * speed_ratio(latent.slip)).or(read)
            };
            rim_speeds.zip(latents).zip(read()).map(followed).collect()
        }
        _ => read(),
    }
}

/// Sine and cosine of an angle; 0 where a row does not have it.
fn turns(angles_rad: &[Option<f64>]) -> [Term; 2] {
    let of = |part: fn(f64) -> f64| Term::steady(angles_rad.iter().map(|angle| angle.map_or(0.0, part)).collect());
    [of(f64::sin), of(f64::cos)]
}

/// Products of two different columns, and the squares of none: a power of one column is for the search to try.
pub fn products(columns: &[Regressor]) -> Vec<Regressor> {
    let mut found = Vec::new();
    for (place, one) in columns.iter().enumerate() {
        for other in &columns[place + 1..] {
            let product = product(&one.term, &other.term);
            let at = product.slopes.as_ref().map_or_else(|| Arc::from([]), |slopes| slopes.at.clone());
            let column = Column {
                values: product.values.into_iter().map(Some).collect(),
                by: product.slopes.map(|slopes| slopes.by),
            };
            let parts = [one.parts.clone(), other.parts.clone()].concat();
            let factors = vec![one.term.clone(), other.term.clone()];
            let product = standardised(parts, &column, &at);
            found.extend(product.map(|product| Regressor { factors, ..product }));
        }
    }
    found
}

/// The product of two terms.
fn product(one: &Term, other: &Term) -> Term {
    let rows = one.values.len();
    let slope = |term: &Term, row: usize| term.slopes.as_ref().map_or([0.0; 2], |slopes| slopes.by[row]);
    let by = |row: usize| {
        let (a, b) = (slope(one, row), slope(other, row));
        std::array::from_fn(|k| a[k] * other.values[row] + one.values[row] * b[k])
    };
    let at = one.slopes.as_ref().or(other.slopes.as_ref()).map(|slopes| slopes.at.clone());
    Term {
        values: one.values.iter().zip(&other.values).map(|(a, b)| a * b).collect(),
        slopes: at.map(|at| Slopes { by: (0..rows).map(by).collect(), at }),
    }
}

/// The channels on which others may depend: forces are results of the same contact.
pub(super) fn causes() -> impl Iterator<Item = Channel> {
    let results = [Channel::DrawbarPull, Channel::Torque, Channel::SideForce];
    Channel::ALL.into_iter().filter(move |channel| !results.contains(channel))
}

/// The columns that the format does not know on which channels may depend.
pub(super) fn other_causes(campaign: &Campaign) -> impl Iterator<Item = &str> {
    campaign.columns().filter(|name| Channel::from_name(name).is_none() && !is_scatter(name))
}

/// Columns that say how a channel scattered within a window are results, too.
fn is_scatter(name: &str) -> bool {
    name.split('_').any(|part| matches!(part, "sd" | "std" | "stdev" | "sigma"))
}

fn standardised(parts: Vec<Part>, column: &Column, at: &Arc<[[f64; 2]]>) -> Option<Regressor> {
    let values = &column.values;
    let known: Vec<f64> = values.iter().flatten().copied().filter(|value| value.is_finite()).collect();
    let mut distinct = sorted(known.iter().copied());
    distinct.dedup();
    if (known.len() as f64) < KNOWN_SHARE * values.len() as f64 || distinct.len() < LEAST_VALUES {
        return None;
    }
    let count = known.len() as f64;
    let mean = known.iter().sum::<f64>() / count;
    let std = (known.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let flat = std <= 1e-9 * mean.abs();
    let scale = |value: &Option<f64>| value.map_or(0.0, |value| (value - mean) / std);
    let slopes =
        || Some(Slopes { by: column.by.as_ref()?.iter().map(|by| by.map(|by| by / std)).collect(), at: at.clone() });
    (!flat && std > 0.0).then(|| Regressor {
        term: Term { values: values.iter().map(scale).collect(), slopes: slopes() },
        factors: Vec::new(),
        turns: None,
        values: distinct.len(),
        parts,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First and second pass are two values, which a residual may follow; one value is none.
    #[test]
    fn a_column_of_two_values_counts() {
        let regressor = |values: [f64; 4]| {
            let column = Column { values: values.map(Some).into(), by: None };
            standardised(Vec::new(), &column, &Arc::from([]))
        };
        let two = regressor([1.0, 2.0, 1.0, 2.0]).expect("a column that varies");
        assert_eq!((two.values, two.term.values), (2, vec![-1.0, 1.0, -1.0, 1.0]));
        assert!(regressor([1.0; 4]).is_none());
    }

    #[test]
    fn a_column_is_scatter_by_a_word_of_its_name_and_not_by_letters_within_one() {
        assert!(["side_force_sd_n", "sinkage_std_m", "std"].into_iter().all(is_scatter));
        assert!(!["westdrift_m", "dustdepth_m", "x_sdepth", "standing_s"].into_iter().any(is_scatter));
    }

    /// d(ab) = a db + b da, for a of slip and b of slip and load.
    #[test]
    fn a_product_follows_both_of_its_factors() {
        let at: Arc<[[f64; 2]]> = Arc::from([[0.2, 50.0]]);
        let term = |value: f64, by: [f64; 2]| Term {
            values: vec![value],
            slopes: Some(Slopes { by: vec![by], at: at.clone() }),
        };
        let found = product(&term(2.0, [3.0, 0.0]), &term(5.0, [7.0, 0.5]));
        assert_eq!(found.values, [10.0]);
        assert_eq!(found.slopes.expect("slopes").by, [[29.0, 1.0]]);
        let steady = product(&Term::steady(vec![2.0]), &Term::steady(vec![3.0]));
        assert!(steady.slopes.is_none() && steady.values == [6.0]);
    }
}
