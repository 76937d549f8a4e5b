//! What a residual may follow: every column of a campaign, and products of two.

use std::sync::Arc;

use kapvik_firmware::terramechanics::effects::speed_ratio;
use nalgebra::{DMatrix, DVector};

use crate::data::campaign::{Campaign, Channel};

use super::bench::Bench;
use super::candidates::{loads_differ, rates_differ};
use super::fit::{Latent, Reading};
use super::linearised::{Linearised, Slopes, Term};
use super::measurements::{KNOWN_SHARE, Measurements, column_name};
use super::noise::Noise;
use super::rates::speed_ratio_by_slip;
use crate::statistics::sorted;

/// A column, or a product of two, about zero and one in size. What is made of slip, load, sinkage or speed is a function of
/// the true slip and load as they were fitted, not of their readings.
#[derive(Debug, Clone)]
pub struct Regressor {
    /// Its name; a product is written `slip*sinkage_m`.
    pub name: String,
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
    /// Whether it is slip, load or sinkage, or says no more than these do, as the rate of a wheel whose carriage keeps its speed, or measures
    /// again what the contact does, as a second sensor of the sinkage.
    is_of_contact: bool,
}

/// Values that a column must take.
const LEAST_VALUES: usize = 2;
/// Correlation beyond which two columns say the same.
const SAME: f64 = 0.999;
/// Share of a column's variance which slip and load make, beyond which it says no more than they do.
const SAYS_NO_MORE: f64 = 0.99;
/// Least v/(rω) that counts there: a wheel may spin on the spot.
const LEAST_RATIO: f64 = 0.02;
/// What a straight line in a column leaves of a channel that it measures again, in standard deviations of the channel's noise.
const LEFT_AGAIN: f64 = 2.0;
/// Scatter of a channel by slip and load, in the same, from which such a line says anything.
const MOVED: f64 = 6.0;
/// Fewest rows with both.
const LEAST_ROWS: usize = 8;

impl Regressor {
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
        Self { name: name.to_owned(), is_of_contact: is_contact || is_of_contact() }
    }
}

/// Whether a column is a smooth function of slip and load in these rows. The share of its variance counts by degrees of freedom.
fn says_no_more(values: &[Option<f64>], latents: &[Latent]) -> bool {
    by_state(values, latents).is_some_and(|ByState { known, fitted, terms }| {
        let left = (&known - fitted).norm_squared() / (known.len() - terms) as f64;
        left < (1.0 - SAYS_NO_MORE) * known.variance()
    })
}

/// Whether a column that the format does not name measures a channel again. Those that it names are causes, whatever a channel may do beside
/// them.
fn is_second_sensor(name: &str, values: &[Option<f64>], measurements: &Measurements, latents: &[Latent]) -> bool {
    let measured = [Reading::Sinkage, Reading::DrawbarPull, Reading::Torque, Reading::Load];
    let measures_again = |reading: Reading| {
        let channel = reading.index();
        let readings: Vec<Option<f64>> = measurements.rows.iter().map(|row| row.readings[channel]).collect();
        let Noise { std, of_repeats, .. } = measurements.noise[channel];
        let noise = of_repeats.map_or(std, |of_repeats| of_repeats.min(std));
        says_again(values, &readings, noise, latents)
    };
    Channel::from_name(name).is_none() && measured.into_iter().any(measures_again)
}

/// Whether a straight line in a column is a channel's readings but for their noise. Slip and load must move the channel: what is still but for
/// what a column does to it would follow that column as well.
fn says_again(values: &[Option<f64>], readings: &[Option<f64>], noise: f64, latents: &[Latent]) -> bool {
    let is_moved =
        || by_state(readings, latents).is_some_and(|state| state.fitted.variance() > (MOVED * noise).powi(2));
    beside_line(values, readings).is_some_and(|left| left <= (LEFT_AGAIN * noise).powi(2)) && is_moved()
}

/// The variance of some readings about a straight line in a column, by degrees of freedom; none of few rows, or of a column that does not vary.
fn beside_line(values: &[Option<f64>], readings: &[Option<f64>]) -> Option<f64> {
    let both = values.iter().zip(readings).filter_map(|(value, reading)| Some(((*value)?, (*reading)?)));
    let (values, readings): (Vec<f64>, Vec<f64>) =
        both.filter(|(value, reading)| value.is_finite() && reading.is_finite()).unzip();
    if values.len() < LEAST_ROWS {
        return None;
    }
    let about_mean = |numbers: Vec<f64>| {
        let numbers = DVector::from(numbers);
        numbers.add_scalar(-numbers.mean())
    };
    let (values, readings) = (about_mean(values), about_mean(readings));
    let slope = values.dot(&readings) / values.norm_squared();
    slope.is_finite().then(|| (&readings - values * slope).norm_squared() / (readings.len() - 2) as f64)
}

/// A column in the rows that have it, and what slip and load make of it.
struct ByState {
    known: DVector<f64>,
    fitted: DVector<f64>,
    /// Coefficients of that.
    terms: usize,
}

/// By least squares: a straight line in the load, and in the slip a parabola and what rates and speeds go with, 1/(1 − i). None of few rows.
fn by_state(values: &[Option<f64>], latents: &[Latent]) -> Option<ByState> {
    let of_state = |Latent { slip, load_n, .. }: &Latent| {
        [1.0, *slip, slip * slip, speed_ratio(*slip).max(LEAST_RATIO).recip(), *load_n]
    };
    let known = values.iter().zip(latents).filter_map(|(value, latent)| Some(((*value)?, of_state(latent))));
    let (known, states): (Vec<f64>, Vec<[f64; 5]>) = known.filter(|(value, _)| value.is_finite()).unzip();
    let terms = states.first().map_or(0, |state| state.len());
    if known.len() < 2 * terms || terms == 0 {
        return None;
    }
    let states = DMatrix::from_fn(known.len(), terms, |row, term| states[row][term]);
    let known = DVector::from(known);
    let singular = 1e-9 * states.amax();
    let factors = states.clone().svd(true, true).solve(&known, singular).ok()?;
    Some(ByState { fitted: states * factors, known, terms })
}

/// What the contact itself is made of.
const CONTACT: [Reading; 3] = [Reading::Slip, Reading::Load, Reading::Sinkage];

/// The columns of a campaign that vary, the ones that the format names first, about a fitted model.
pub fn columns(bench: &Bench<'_>, linearised: &Linearised<'_>) -> Vec<Regressor> {
    let mut names: Vec<&str> = causes().map(Channel::name).collect();
    names.extend(other_causes(bench.campaign));
    // About one level they scatter by their errors.
    let one_level =
        [(Channel::WheelRate, !rates_differ(bench.measurements)), (Channel::Load, !loads_differ(bench.measurements))];
    names.retain(|name| one_level.iter().all(|(channel, is_one)| !is_one || *name != channel.name()));
    let at: Arc<[[f64; 2]]> = linearised.latents().iter().map(|latent| [latent.slip, latent.load_n]).collect();
    let mut found: Vec<Regressor> = Vec::new();
    for name in names {
        let column = column(bench, linearised, name);
        let new = |regressor: &Regressor| {
            !found.iter().any(|other| correlation(&other.term.values, &regressor.term.values).abs() > SAME)
        };
        let part = Part::of(name, &column.values, bench.measurements, linearised.latents());
        if let Some(regressor) = standardised(name.to_owned(), vec![part], &column, &at).filter(new) {
            let turns = (name == Channel::WheelAngle.name()).then(|| turns(&column.values));
            found.push(Regressor { turns, ..regressor });
        }
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
            let product = standardised(format!("{}*{}", one.name, other.name), parts, &column, &at);
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

fn standardised(name: String, parts: Vec<Part>, column: &Column, at: &Arc<[[f64; 2]]>) -> Option<Regressor> {
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
        name,
        term: Term { values: values.iter().map(scale).collect(), slopes: slopes() },
        factors: Vec::new(),
        turns: None,
        values: distinct.len(),
        parts,
    })
}

/// Correlation of two columns whose means are zero.
pub(super) fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let squares = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
    product / (squares(a) * squares(b)).sqrt().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First and second pass are two values, which a residual may follow; one value is none.
    #[test]
    fn a_column_of_two_values_counts() {
        let regressor = |values: [f64; 4]| {
            let column = Column { values: values.map(Some).into(), by: None };
            standardised("pass".to_owned(), Vec::new(), &column, &Arc::from([]))
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

    #[test]
    fn the_rate_of_a_wheel_says_no_more_than_its_slip_where_its_carriage_keeps_its_speed() {
        let slips = (0..15).map(|row| 0.1 + 0.2 * f64::from(row % 5));
        let latents: Vec<Latent> = slips.map(|slip| Latent { slip, load_n: 25.0, sinkage_m: 0.01 }).collect();
        let values = |of: &dyn Fn(usize, f64) -> f64| -> Vec<Option<f64>> {
            latents.iter().enumerate().map(|(row, latent)| Some(of(row, latent.slip))).collect()
        };
        let at_one_speed = values(&|row, slip| (0.16 + 0.001 * (row % 2) as f64) / (1.0 - slip));
        let at_two_speeds = values(&|row, slip| if row < 7 { 0.16 } else { 0.32 } / (1.0 - slip));
        let with_the_hours = values(&|row, _| row as f64);
        let of = |values: &[Option<f64>]| says_no_more(values, &latents);
        assert_eq!([at_one_speed, at_two_speeds, with_the_hours].map(|values| of(&values)), [true, false, false]);
        assert!(!says_no_more(&[Some(1.0); 3], &latents[..3]), "of three rows nobody knows");
    }

    /// A laser beside the sensor of the sinkage, in millimetres from its own zero. Hours, and sand that is wet by turns, are no second sensor,
    /// though the sinkage goes with them where nothing else moves it.
    #[test]
    fn a_second_sensor_is_told_from_a_cause() {
        const NOISE_M: f64 = 3e-4;
        let scatter = |row: usize| ((4 * row) % 7) as f64 / 3.0 - 1.0;
        let wet = |row: usize| (row / 2 % 2) as f64;
        let latents = |moves: bool| -> Vec<Latent> {
            let place = |row: usize| if moves { ((row % 5) as f64, (row / 5) as f64) } else { (2.0, 1.0) };
            let at = |(slip, load): (f64, f64)| Latent {
                slip: 0.1 + 0.2 * slip,
                load_n: 25.0 + 25.0 * load,
                sinkage_m: 0.01,
            };
            (0..15).map(|row| at(place(row))).collect()
        };
        let column = |of: &dyn Fn(usize) -> f64| -> Vec<Option<f64>> { (0..15).map(|row| Some(of(row))).collect() };
        let moved = latents(true);
        let true_m = |row: usize| 0.001 + 0.01 * moved[row].slip + 2e-4 * moved[row].load_n;
        let sinkage_m = column(&|row| true_m(row) + NOISE_M * scatter(row));
        let laser_mm = column(&|row| 2.0 + 1e3 * (true_m(row) + 0.1 * NOISE_M * scatter(row + 3)));
        let [hours, wet_sand] = [column(&|row| row as f64), column(&wet)];
        let again = |values: &[Option<f64>]| says_again(values, &sinkage_m, NOISE_M, &moved);
        assert_eq!([&laser_mm, &hours, &wet_sand].map(|values| again(values)), [true, false, false]);
        let of_wet_sand = column(&|row| 0.01 + 0.01 * wet(row) + NOISE_M * scatter(row));
        assert!(!says_again(&wet_sand, &of_wet_sand, NOISE_M, &latents(false)), "nothing but the water moves it");
        assert!(!says_again(&laser_mm[..7], &sinkage_m[..7], NOISE_M, &moved[..7]), "of seven rows nobody knows");
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
