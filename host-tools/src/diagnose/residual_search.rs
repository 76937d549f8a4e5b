//! Structure in a residual: whether a channel follows a column, known or unknown, more than chance and a refit explain.

use rayon::prelude::*;

use super::bench::Bench;
use super::chance::{beside_noise, over_all, squares_gained};
use super::fit::{Fit, Reading, Row};
use super::linearised::{AddedTerms, Linearised, Slopes, Term};
use super::regressors::{Regressor, columns, products};
use super::selection::{NOT_SURELY_BETTER, PARAMETER_COST, TELLS_APART};
use super::term_screen::Screen;
use super::trial::Trial;
use super::unseen_runs::HeldOutGain;

/// A channel's dependence on a column.
#[derive(Debug, Clone)]
pub struct Structure {
    /// The channel.
    pub channel: Reading,
    /// The column, or the two of which it follows the product.
    pub columns: Vec<String>,
    /// Other columns that say the same in these rows.
    pub also: Vec<String>,
    /// Whether the column is one of what the contact itself is made of: slip, load and sinkage.
    pub of_contact: bool,
    /// The terms by which it was fitted.
    pub added: AddedTerms,
    /// Those of them that say nothing of the column: a constant, and factors that are of the contact.
    pub common: AddedTerms,
    /// Gain in ln likelihood in units of the dispersion, less the cost of the terms' coefficients.
    pub score: f64,
    /// Share of the channel's residual that follows it.
    pub share_of_variance: f64,
    /// The chance of such a gain in as many independent rows as there are, over all channels and columns that were tried.
    pub p_value: f64,
    /// The gain on runs that the fit did not see.
    pub held_out: Option<HeldOutGain>,
}

impl Structure {
    /// What it follows, as it is written: `slip*sinkage_m` is a product.
    pub fn regressor(&self) -> String {
        self.columns.join("*")
    }

    /// Whether chance does not explain it.
    pub fn is_significant(&self) -> bool {
        let is_held = self.held_out.is_some_and(|gain| gain.chance() < BY_RUNS && gain.is_shared());
        self.p_value < SIGNIFICANT_STRUCTURE && is_held
    }

    /// Why it is none, where that is not that chance does as much.
    pub fn why_not(&self) -> Option<&'static str> {
        (self.p_value < SIGNIFICANT_STRUCTURE && !self.is_significant()).then_some(NOT_SURELY_BETTER)
    }

    /// Whether it is a single column that is no part of the contact, and likely what a misfit beyond doubt follows.
    pub fn explains_a_misfit(&self) -> bool {
        let is_held = self.held_out.is_some_and(|gain| gain.exceeds(1.0) && gain.is_shared());
        self.columns.len() == 1 && !self.of_contact && self.p_value < SIGNIFICANT_OF_A_MISFIT && is_held
    }
}

/// The same where the data show by themselves that something is missing: what is asked is then which column it follows, and not whether.
const SIGNIFICANT_OF_A_MISFIT: f64 = 0.01;
/// The chance, over all channels and columns, below which a dependence is taken for one. Less than for an effect: behind an
/// effect stands an equation that was written before the data.
const SIGNIFICANT_STRUCTURE: f64 = 0.001;
/// The chance, over runs that the fit did not see, below which they gain by it: what drifts along each run in its own way follows a column in
/// some of them.
const BY_RUNS: f64 = 0.01;
/// Fewest observations for each coefficient of a dependence.
const PER_TERM: f64 = 4.0;
/// Those of each channel that are fitted, of all that a first look is taken at.
const FITTED: usize = 16;
/// The best of each channel that are looked at again.
const OF_CHANNEL: usize = 8;
/// Powers of one column that are tried: a line, a bend that few observations can bear, and a curve that may turn twice.
const DEGREES: [usize; 3] = [1, 2, 3];

/// Standard deviations of a column beyond which its powers grow no more.
const EDGE: f64 = 4.0;

/// Every channel against every column and every product of two, refitted with the model's parameters; the best first. One
/// entry a channel and column.
pub fn search(bench: &Bench<'_>, trial: &Trial<'_>, dispersion: f64) -> Vec<Structure> {
    let (screened, tried) = screen(bench, trial, dispersion).unwrap_or_default();
    let mut found = second_look(bench, trial, dispersion, screened, tried).unwrap_or_default();
    found.sort_by(|a, b| b.score.total_cmp(&a.score));
    simpler_first(&mut found);
    found
}

/// Puts a column before products of it that do not tell themselves apart from it: a product holds its column's line, too, and
/// takes up by chance what that leaves.
fn simpler_first(found: &mut [Structure]) {
    for place in 0..found.len() {
        let single = &found[place];
        let holds = |product: &Structure| {
            product.channel == single.channel
                && product.columns.len() > 1
                && product.columns.iter().any(|column| single.columns == [column.as_str()])
                && product.score < single.score + TELLS_APART
        };
        if let Some(product) = found[..place].iter().position(holds) {
            found[product..=place].rotate_right(1);
        }
    }
}

/// All of them at the model's own scales of noise and offsets, which is quick: the best of each channel, and how many were
/// tried.
fn screen(bench: &Bench<'_>, trial: &Trial<'_>, dispersion: f64) -> Option<(Vec<Structure>, usize)> {
    let measurements = bench.measurements;
    let held = bench.held(&trial.fit);
    let linearised = Linearised::about(&trial.model, &trial.fit, &held.rows, measurements, &held.options)?;
    let columns = columns(bench, &linearised);
    let products = products(&columns);
    let nothing = linearised.fit_with(&no_terms()).ok()?;
    let channels = Reading::JUDGED.into_iter().filter(|channel| measurements.has(*channel));
    let bends = |(column, degree): &(&Regressor, usize)| *degree < column.values;
    let singles = columns.iter().flat_map(|column| DEGREES.map(|degree| (column, degree))).filter(bends);
    let curves = singles.chain(products.iter().map(|product| (product, 1)));
    let curves = curves.map(|(regressor, degree)| (regressor, powers(regressor, degree)));
    let all: Vec<_> = curves.chain(columns.iter().filter_map(|column| Some((column, wave(column)?)))).collect();
    let mut tried = 0;
    let mut promising = Vec::new();
    for channel in channels {
        let screen = Screen::new(&linearised, &AddedTerms { channel, ..no_terms() }, &nothing, &held)?;
        let own: Vec<_> = all.iter().filter(|(regressor, _)| !regressor.contains(channel)).collect();
        tried += own.len();
        promising.extend(most_promising(&screen, dispersion, own).into_iter().map(|curve| (channel, curve)));
    }
    let examine = |&(channel, (regressor, terms)): &(Reading, &Curve<'_>)| {
        let added = AddedTerms { channel, terms: terms.clone() };
        let fit = linearised.fit_with(&added).ok()?;
        Some(Structure {
            channel,
            columns: regressor.columns(),
            also: regressor.also(),
            of_contact: regressor.is_of_contact(),
            score: gain(trial, &nothing, &fit) / dispersion - PARAMETER_COST * added.terms.len() as f64,
            share_of_variance: share(&nothing, &fit, channel),
            p_value: 1.0,
            held_out: None,
            common: AddedTerms { channel, terms: common(regressor) },
            added,
        })
    };
    let mut found: Vec<_> = promising.par_iter().filter_map(examine).collect();
    found.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut seen: Vec<(Reading, Vec<String>)> = Vec::new();
    found.retain(|structure| {
        let key = (structure.channel, structure.columns.clone());
        let in_channel = seen.iter().filter(|(channel, _)| *channel == structure.channel).count();
        let wanted = in_channel < OF_CHANNEL && !seen.contains(&key);
        seen.extend(wanted.then_some(key));
        wanted
    });
    Some((found, tried))
}

/// A column, or a product of two, and the terms by which it is fitted.
type Curve<'a> = (&'a Regressor, Vec<Term>);

/// Those that a first look finds worth a fit.
fn most_promising<'a, 'b>(screen: &Screen, dispersion: f64, curves: Vec<&'a Curve<'b>>) -> Vec<&'a Curve<'b>> {
    let worth = |terms: &[Term]| {
        let gain = screen.gain_together(terms.iter().map(|term| term.values.as_slice()));
        gain / dispersion - PARAMETER_COST * terms.len() as f64
    };
    let mut found: Vec<_> = curves.into_par_iter().map(|curve| (worth(&curve.1), curve)).collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.into_iter().take(FITTED).map(|(_, curve)| curve).collect()
}

/// The best again, with the scales of noise and offsets as they are beside them: an offset of each run that is really a
/// dependence hides it from the first look. And on runs that the fit did not see.
fn second_look(
    bench: &Bench<'_>,
    trial: &Trial<'_>,
    dispersion: f64,
    screened: Vec<Structure>,
    tried: usize,
) -> Option<Vec<Structure>> {
    let measurements = bench.measurements;
    let (rows, runs) = (&measurements.rows, measurements.runs.len());
    let linearised = Linearised::about(&trial.model, &trial.fit, rows, measurements, &bench.options)?;
    let nothing = linearised.fit_with(&no_terms()).ok()?;
    let before = linearised.held_out(&no_terms(), &nothing, runs)?;
    let look = |structure: Structure| {
        let terms = structure.added.terms.len();
        let fit = linearised.fit_with(&structure.added).ok()?;
        let gain = gain(trial, &nothing, &fit).min(gain_at_its_scales(bench, trial, &fit)?) / dispersion;
        let after = linearised.held_out(&structure.added, &fit, runs)?;
        let held_out = HeldOutGain::over(&before, &after);
        let rows_per_reading = fit.rows_per_reading();
        let count = observations(bench, &fit, structure.channel, rows_per_reading);
        Some(Structure {
            score: gain - PARAMETER_COST * terms as f64,
            p_value: chance_of(gain / rows_per_reading, terms, count, tried),
            held_out: Some(held_out),
            ..structure
        })
    };
    Some(screened.into_par_iter().filter_map(look).collect())
}

fn no_terms() -> AddedTerms {
    AddedTerms { channel: Reading::Sinkage, terms: Vec::new() }
}

/// Gain in ln likelihood and Gaussian priors.
fn gain(trial: &Trial<'_>, before: &Fit, after: &Fit) -> f64 {
    after.log_likelihood - before.log_likelihood + trial.log_prior(&after.parameters)
        - trial.log_prior(&before.parameters)
}

/// The same over the model without the terms at the scales of noise and offsets that the fit with them came to: those of the
/// model without may be at a lesser optimum, which is no merit of the terms.
fn gain_at_its_scales(bench: &Bench<'_>, trial: &Trial<'_>, after: &Fit) -> Option<f64> {
    let held = bench.held(after);
    let linearised = Linearised::about(&trial.model, &trial.fit, &held.rows, bench.measurements, &held.options)?;
    Some(gain(trial, &linearised.fit_with(&no_terms()).ok()?, after))
}

/// What a channel's scale is estimated from beside a dependence: its rows, of which several tell as much as an independent one where noise
/// remembers, or where runs have offsets of their own that the dependence does not explain. Of these the design effect of rows that are drawn
/// by runs tells how many: 1 + (m − 1) ρ, m being the mean over all rows of how many are in a row's run, pairs of which correlate by ρ (Kish
/// 1965, Survey Sampling).
fn observations(bench: &Bench<'_>, with: &Fit, channel: Reading, rows_per_reading: f64) -> f64 {
    let c = channel.index();
    let rows: Vec<&Row> = bench.measurements.rows.iter().filter(|row| row.readings[c].is_some()).collect();
    let runs = rows.chunk_by(|one, other| one.run == other.run).map(<[&Row]>::len);
    let count = rows.len() as f64;
    let beside_each = runs.map(|run| (run * run) as f64).sum::<f64>() / count - 1.0;
    let noise_variance = rows.iter().map(|row| (row.noise[c] * with.noise_scale[c]).powi(2)).sum::<f64>() / count;
    let offset_variance = with.offset_std[c].powi(2);
    let correlation = offset_variance / (offset_variance + noise_variance);
    let design_effect = 1.0 + beside_each * correlation;
    count / design_effect.max(rows_per_reading)
}

/// The chance, over all that were tried, of a gain where the scale is estimated beside it: the likelihood ratio as the F
/// ratio that it is for a linear model.
fn chance_of(gain: f64, terms: usize, count: f64, tried: usize) -> f64 {
    let terms = terms as f64;
    if count < PER_TERM * terms {
        return 1.0;
    }
    let left = count - terms - 1.0;
    let squares = squares_gained(2.0 * gain.max(0.0) / count, left);
    over_all(beside_noise(squares, terms, left), tried)
}

/// A constant, what a product is made of, and the powers: a column's effect seldom vanishes at the column's mean.
fn powers(regressor: &Regressor, degree: usize) -> Vec<Term> {
    let powers = (1..=degree as i32).map(|degree| power(&regressor.term, degree));
    std::iter::once(constant(regressor)).chain(regressor.factors.iter().cloned()).chain(powers).collect()
}

fn constant(regressor: &Regressor) -> Term {
    Term::steady(vec![1.0; regressor.term.values.len()])
}

/// A power of a term; what lies far out counts as on the edge.
fn power(term: &Term, degree: i32) -> Term {
    let held = |value: f64| value.clamp(-EDGE, EDGE);
    let slope = |(value, by): (&f64, &[f64; 2])| {
        let inside = if value.abs() < EDGE { 1.0 } else { 0.0 };
        by.map(|by| inside * f64::from(degree) * held(*value).powi(degree - 1) * by)
    };
    let slopes =
        |slopes: &Slopes| Slopes { by: term.values.iter().zip(&slopes.by).map(slope).collect(), at: slopes.at.clone() };
    Term {
        values: term.values.iter().map(|value| held(*value).powi(degree)).collect(),
        slopes: term.slopes.as_ref().map(slopes),
    }
}

/// Those of the terms that a product, or a column, shares with what the contact alone may do.
fn common(regressor: &Regressor) -> Vec<Term> {
    std::iter::once(constant(regressor)).chain(regressor.contact_factors().cloned()).collect()
}

/// A constant and a swing once a turn, of an angle of the wheel.
fn wave(regressor: &Regressor) -> Option<Vec<Term>> {
    let [sine, cosine] = regressor.turns.clone()?;
    Some(vec![constant(regressor), sine, cosine])
}

/// Share of the squares of a channel's residual, in units of its noise, that is gone. What the rows of a run have in common
/// belongs to it: an offset of the run takes up what the run's column does.
pub fn share(before: &Fit, after: &Fit, channel: Reading) -> f64 {
    let squares = |fit: &Fit| -> f64 { fit.whole_standardised(channel).map(|value| value.powi(2)).sum() };
    (1.0 - squares(after) / squares(before).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}
