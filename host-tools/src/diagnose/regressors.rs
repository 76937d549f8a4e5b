//! What a residual may follow: every column of a campaign, and products of two.

use crate::data::campaign::{Campaign, Channel};

use super::fit::Reading;
use super::measurements::{COLUMNS, Measurements};

/// A column, or a product of two, about zero and one in size.
#[derive(Debug, Clone)]
pub struct Regressor {
    /// Its name; a product is written `slip*sinkage_m`.
    pub name: String,
    /// Its value in each row; 0 where the row does not have it.
    pub values: Vec<f64>,
    /// Of a product, the values of what it is made of.
    pub factors: Vec<Vec<f64>>,
    /// Of an angle of the wheel, its sine and its cosine.
    pub turns: Option<[Vec<f64>; 2]>,
    parts: Vec<String>,
}

/// Share of the rows that must have a column.
const KNOWN_SHARE: f64 = 0.8;
/// Values that a column must take.
const LEAST_VALUES: usize = 3;
/// Correlation beyond which two columns say the same.
const SAME: f64 = 0.999;

impl Regressor {
    /// Whether it is made of what a channel reads.
    pub fn contains(&self, reading: Reading) -> bool {
        self.parts.iter().any(|part| part == COLUMNS[reading.index()].name())
    }

    /// Whether it is made of slip, load and sinkage alone.
    pub fn is_of_contact(&self) -> bool {
        self.parts.iter().all(|part| is_contact(part))
    }

    /// Of a product, the values of those factors that are slip, load or sinkage.
    pub fn contact_factors(&self) -> impl Iterator<Item = &Vec<f64>> {
        self.factors.iter().zip(&self.parts).filter(|(_, part)| is_contact(part)).map(|(values, _)| values)
    }
}

fn is_contact(part: &str) -> bool {
    CONTACT.iter().any(|reading| part == COLUMNS[reading.index()].name())
}

/// What the contact itself is made of.
const CONTACT: [Reading; 3] = [Reading::Slip, Reading::Load, Reading::Sinkage];

/// The columns of a campaign that vary, the ones that the format names first.
pub fn columns(campaign: &Campaign, measurements: &Measurements) -> Vec<Regressor> {
    // Other forces are results of the same contact, not causes.
    let results = [Channel::DrawbarPull, Channel::Torque, Channel::SideForce];
    let causes = Channel::ALL.iter().filter(|channel| !results.contains(channel));
    let mut names: Vec<&str> = causes.map(|channel| channel.name()).collect();
    names.extend(campaign.columns().filter(|name| Channel::from_name(name).is_none() && !is_scatter(name)));
    let mut found: Vec<Regressor> = Vec::new();
    for name in names {
        let values: Vec<_> = measurements.places.iter().map(|place| value(campaign, name, *place)).collect();
        let new = |regressor: &Regressor| {
            !found.iter().any(|other| correlation(&other.values, &regressor.values).abs() > SAME)
        };
        if let Some(regressor) = standardised(name.to_owned(), vec![name.to_owned()], &values).filter(new) {
            let turns = (name == Channel::WheelAngle.name()).then(|| turns(&values));
            found.push(Regressor { turns, ..regressor });
        }
    }
    found
}

/// Sine and cosine of an angle; 0 where a row does not have it.
fn turns(angles_rad: &[Option<f64>]) -> [Vec<f64>; 2] {
    let of = |part: fn(f64) -> f64| angles_rad.iter().map(|angle| angle.map_or(0.0, part)).collect();
    [of(f64::sin), of(f64::cos)]
}

/// Products of two different columns, and the squares of none: a power of one column is for the search to try.
pub fn products(columns: &[Regressor]) -> Vec<Regressor> {
    let mut found = Vec::new();
    for (place, one) in columns.iter().enumerate() {
        for other in &columns[place + 1..] {
            let values: Vec<_> = one.values.iter().zip(&other.values).map(|(a, b)| Some(a * b)).collect();
            let parts = vec![one.name.clone(), other.name.clone()];
            let product = standardised(format!("{}*{}", one.name, other.name), parts, &values);
            let factors = vec![one.values.clone(), other.values.clone()];
            found.extend(product.map(|product| Regressor { factors, ..product }));
        }
    }
    found
}

/// Columns that say how a channel scattered within a window are results, not causes.
pub(super) fn is_scatter(name: &str) -> bool {
    name.contains("_sd") || name.contains("std")
}

/// What a column says in a row of the campaign.
pub(super) fn value(campaign: &Campaign, name: &str, place: usize) -> Option<f64> {
    if name == Channel::Time.name() {
        Some(campaign.rows().get(place)?.t_s)
    } else {
        *campaign.column(name)?.get(place)?
    }
}

fn standardised(name: String, parts: Vec<String>, values: &[Option<f64>]) -> Option<Regressor> {
    let known: Vec<f64> = values.iter().flatten().copied().filter(|value| value.is_finite()).collect();
    let mut distinct = known.clone();
    distinct.sort_by(f64::total_cmp);
    distinct.dedup();
    if (known.len() as f64) < KNOWN_SHARE * values.len() as f64 || distinct.len() < LEAST_VALUES {
        return None;
    }
    let count = known.len() as f64;
    let mean = known.iter().sum::<f64>() / count;
    let std = (known.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let flat = std <= 1e-9 * mean.abs();
    let scale = |value: &Option<f64>| value.map_or(0.0, |value| (value - mean) / std);
    (!flat && std > 0.0).then(|| Regressor {
        name,
        values: values.iter().map(scale).collect(),
        factors: Vec::new(),
        turns: None,
        parts,
    })
}

/// Correlation of two columns whose means are zero.
pub(super) fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let squares = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
    product / (squares(a) * squares(b)).sqrt().max(f64::MIN_POSITIVE)
}
