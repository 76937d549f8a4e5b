//! A fit and what it says.

use nalgebra::{DMatrix, DVector};

use super::levenberg_marquardt::{Optimum, optimise};
use super::leverage::leverages;
use super::likelihood::{log_likelihood, log_prior};
use super::model::{Coordinate, Latent, Model};
use super::normal_equations::{NormalEquations, bounded_covariance};
use super::observation::{CHANNELS, Channels, Reading, Row};
use super::options::{FitError, Options};
use super::problem::{Problem, RunRows};
use super::run_terms::RunTerms;
use super::start::Start;
use super::state::{Scales, State, Step};
use super::variance_share::VarianceShares;
use super::variances::shares_by_run;

/// Points on the way from a start to the middle of the prior at which a fit may begin.
const RETREATS: [f64; 5] = [1.0, 0.75, 0.5, 0.25, 0.0];
/// Share of the readings that may be gross errors.
const GROSS_SHARE: f64 = 0.05;
/// Share of the bounds' width within which a value is on a bound.
const ON_BOUND: f64 = 1e-9;

/// The offset of a run, by channel, in the channels' units; 0 where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunOffset {
    /// The run's number.
    pub run: usize,
    /// Its offsets.
    pub offset: [f64; CHANNELS],
}

/// A model fitted to rows. Numbers by row are of all rows that the fit was given, none or the start for those left out.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The mode, one value per coordinate.
    pub parameters: Vec<f64>,
    /// Their covariance. No variance exceeds that of the bounds' flat distribution (width² / 12).
    pub covariance: DMatrix<f64>,
    /// Coordinates that the data push against a bound.
    pub on_bound: Vec<bool>,
    /// True slip and load by row.
    pub latents: Vec<Latent>,
    /// Offsets by run.
    pub offsets: Vec<RunOffset>,
    /// τ: standard deviation of the run offsets in the channel's unit; 0 where there are none.
    pub offset_std: [f64; CHANNELS],
    /// Factor on the rows' noise, 1 where the noise is stated.
    pub noise_scale: [f64; CHANNELS],
    /// ln density of the readings at the mode, latents and offsets integrated out.
    pub log_likelihood: f64,
    /// The same plus the ln density of the prior: what the best of many starts is chosen by.
    pub log_posterior: f64,
    /// Residuals at the mode, offsets taken off, in units of noise.
    pub standardised: Vec<[Option<f64>; CHANNELS]>,
    /// Share of each reading in its own prediction, 0 to 1; 1 − this is the expected square of its standardised residual.
    pub leverages: Vec<[f64; CHANNELS]>,
    /// Readings less what was fitted of them (parameters, latents, offsets).
    pub degrees_of_freedom: f64,
    /// Twice the loss per degree of freedom, a few gross errors set aside: about 1 where model and noise are right.
    pub dispersion: f64,
    /// Trial steps taken.
    pub iterations: usize,
    /// Whether the last step was small enough.
    pub converged: bool,
    pub(super) shares: Vec<RunShare>,
    pub(super) information: DMatrix<f64>,
    pub(super) pull: DVector<f64>,
    pub(super) rows: Vec<Row>,
    pub(super) options: Options,
}

/// What a run contributes to the normal equations at the mode.
#[derive(Debug, Clone)]
pub(super) struct RunShare {
    pub run: usize,
    pub information: DMatrix<f64>,
    pub pull: DVector<f64>,
    pub variances: VarianceShares,
}

impl Fit {
    /// Its latents with other parameters, as a start for another model. Of the standard deviations nothing: what the other
    /// model explains is no offset any more.
    pub fn place(&self, parameters: Vec<f64>) -> Start {
        Start { parameters, latents: self.latents.clone(), scales: None }
    }

    /// Where it ended, as a start for the same model on other rows.
    pub fn onward(&self) -> Start {
        Start { scales: Some(self.scales()), ..self.place(self.parameters.clone()) }
    }

    /// Standard deviations by which the data would carry a coordinate beyond the bound that holds it, to first order; 0 where
    /// none does.
    pub fn beyond_bound(&self, place: usize) -> f64 {
        if !self.on_bound[place] {
            return 0.0;
        }
        let variance = self.covariance[(place, place)].max(0.0);
        self.pull[place].abs() * (variance / self.dispersion.max(1.0)).sqrt()
    }

    /// Residuals of a channel at the mode in units of noise, the offsets of the runs left in.
    pub fn whole_standardised(&self, channel: Reading) -> impl Iterator<Item = f64> {
        let (c, scales) = (channel.index(), self.scales());
        let offsets = &self.offsets;
        let offset_of = move |run: usize| offsets.iter().find(|offset| offset.run == run).map_or(0.0, |o| o.offset[c]);
        let rows = self.rows.iter().zip(&self.standardised);
        rows.filter_map(move |(row, standardised)| Some(standardised[c]? + offset_of(row.run) / scales.noise(row, c)))
    }

    /// Its standard deviations.
    pub(super) fn scales(&self) -> Scales {
        Scales { noise: self.noise_scale, offset: self.offset_std }
    }
}

/// Fits a model to rows.
///
/// # Errors
/// See [`FitError`].
pub fn fit(model: &dyn Model, rows: &[Row], start: &Start, options: &Options) -> Result<Fit, FitError> {
    fit_without(model, rows, &[], start, options)
}

/// Fits a model to all rows but those of some runs.
///
/// # Errors
/// See [`FitError`].
pub fn fit_without(
    model: &dyn Model,
    rows: &[Row],
    without: &[usize],
    start: &Start,
    options: &Options,
) -> Result<Fit, FitError> {
    let problem = Problem::new(model, rows, without, start, options)?;
    Ok(describe(&problem, optimum(&problem, start)?))
}

/// Where a problem's way from a start leads.
pub(super) fn optimum(problem: &Problem<'_>, start: &Start) -> Result<Optimum, FitError> {
    let state = first_state(problem, &start.parameters).ok_or(FitError::NoPrediction)?;
    Ok(optimise(problem, state))
}

/// The start, or the first place on the way from there to the middle of the prior where the model predicts something.
fn first_state(problem: &Problem<'_>, parameters: &[f64]) -> Option<State> {
    RETREATS.iter().find_map(|share| {
        let towards = |(&value, coordinate): (&f64, &Coordinate)| {
            let start = value.clamp(coordinate.low, coordinate.high);
            coordinate.middle() + share * (start - coordinate.middle())
        };
        let place = parameters.iter().zip(problem.coordinates()).map(towards);
        State::at(problem, DVector::from_iterator(parameters.len(), place))
    })
}

fn describe(problem: &Problem<'_>, optimum: Optimum) -> Fit {
    let Optimum { state, scales, objective, iterations, converged } = optimum;
    let equations = NormalEquations::new(problem, &state, &scales, 0.0);
    let count = state.parameters.len();
    let covariance = covariance(problem, &equations);
    let free = free_covariance(problem, &state.parameters, &equations).unwrap_or_else(|| DMatrix::zeros(count, count));
    let leverages = leverages(problem, &state, &equations, &free);
    let likelihood = log_likelihood(problem, &state, &scales, objective, &equations);
    let posterior = likelihood + log_prior(problem, &state);
    let by_row = ByRow::new(problem, &state, &scales, &leverages);
    Fit {
        on_bound: held_on_bound(problem, &state.parameters, &equations.pull),
        covariance,
        offsets: run_offsets(problem, &state),
        offset_std: used_offsets(&equations, &scales),
        noise_scale: scales.noise,
        log_likelihood: likelihood,
        log_posterior: posterior,
        degrees_of_freedom: by_row.freedom,
        dispersion: 2.0 * by_row.bulk_loss(problem) / by_row.freedom.max(f64::MIN_POSITIVE),
        latents: by_row.latents,
        standardised: by_row.standardised,
        leverages: by_row.leverages,
        iterations,
        converged,
        shares: shares(problem, &state, &scales, &equations),
        information: equations.information,
        pull: equations.pull,
        parameters: state.parameters.as_slice().to_vec(),
        rows: problem.rows.to_vec(),
        options: problem.options.clone(),
    }
}

/// Covariance of the parameters; infinite where the equations have none.
pub(super) fn covariance(problem: &Problem<'_>, equations: &NormalEquations) -> DMatrix<f64> {
    let count = equations.pull.len();
    let unknown = || DMatrix::from_diagonal_element(count, count, f64::INFINITY);
    bounded_covariance(problem, &equations.information).unwrap_or_else(unknown)
}

fn shares(problem: &Problem<'_>, state: &State, scales: &Scales, equations: &NormalEquations) -> Vec<RunShare> {
    let variances = shares_by_run(problem, state, scales, equations, &Step::none(state));
    let variances = variances.unwrap_or_else(|| vec![VarianceShares::default(); problem.runs.len()]);
    let share = |((run, terms), variances): ((&RunRows, &RunTerms), VarianceShares)| RunShare {
        run: run.id,
        information: terms.information.clone(),
        pull: terms.pull.clone(),
        variances,
    };
    problem.runs.iter().zip(&equations.runs).zip(variances).map(share).collect()
}

fn run_offsets(problem: &Problem<'_>, state: &State) -> Vec<RunOffset> {
    let offsets = problem.runs.iter().zip(&state.offsets);
    offsets.map(|(run, offset)| RunOffset { run: run.id, offset: (*offset).into() }).collect()
}

/// τ of the channels in which some run has an offset.
pub(super) fn used_offsets(equations: &NormalEquations, scales: &Scales) -> [f64; CHANNELS] {
    std::array::from_fn(|c| if equations.runs.iter().any(|run| run.active[c]) { scales.offset[c] } else { 0.0 })
}

/// What a fit says of each row, and its sums.
struct ByRow {
    latents: Vec<Latent>,
    standardised: Vec<[Option<f64>; CHANNELS]>,
    leverages: Vec<[f64; CHANNELS]>,
    losses: Vec<f64>,
    freedom: f64,
}

impl ByRow {
    fn new(problem: &Problem<'_>, state: &State, scales: &Scales, leverages: &[Vec<Channels>]) -> Self {
        let count = problem.rows.len();
        let mut all = Self {
            latents: problem.latent_start.clone(),
            standardised: vec![[None; CHANNELS]; count],
            leverages: vec![[0.0; CHANNELS]; count],
            losses: Vec::new(),
            freedom: 0.0,
        };
        for (run, rows) in problem.runs.iter().enumerate() {
            for (place, &row) in rows.rows.iter().enumerate() {
                let standardised = state.standardised(&problem.rows[row], scales, run, place);
                for t in standardised.iter().flatten() {
                    all.losses.push(problem.huber.loss(*t));
                    all.freedom += 1.0;
                }
                all.freedom -= leverages[run][place].sum();
                all.latents[row] = state.latents[run][place];
                all.standardised[row] = standardised;
                all.leverages[row] = leverages[run][place].into();
            }
        }
        all.losses.sort_by(f64::total_cmp);
        all
    }

    /// The sum of the losses; so few of them as may be gross errors count no more than they would on Huber's threshold.
    fn bulk_loss(&self, problem: &Problem<'_>) -> f64 {
        let most = problem.huber.loss(problem.options.huber);
        let gross = (GROSS_SHARE * self.losses.len() as f64) as usize;
        let (bulk, tail) = self.losses.split_at(self.losses.len() - gross);
        bulk.iter().sum::<f64>() + tail.iter().map(|loss| loss.min(most)).sum::<f64>()
    }
}

/// Coordinates on a bound that are pulled further out.
fn held_on_bound(problem: &Problem<'_>, parameters: &DVector<f64>, pull: &DVector<f64>) -> Vec<bool> {
    let (low, high) = problem.room(parameters);
    let near = |p: usize, room: f64| {
        let width = high[p] - low[p];
        room.abs() <= if width.is_finite() { ON_BOUND * width } else { 0.0 }
    };
    let held = |p: usize| (near(p, low[p]) && pull[p] < 0.0) || (near(p, high[p]) && pull[p] > 0.0);
    (0..parameters.len()).map(held).collect()
}

/// Covariance of the parameters with those on a bound held there: zero in their rows.
pub(super) fn free_covariance(
    problem: &Problem<'_>,
    parameters: &DVector<f64>,
    equations: &NormalEquations,
) -> Option<DMatrix<f64>> {
    let held = held_on_bound(problem, parameters, &equations.pull);
    let mut information = equations.information.clone();
    for p in (0..held.len()).filter(|&p| held[p]) {
        information.row_mut(p).fill(0.0);
        information.column_mut(p).fill(0.0);
        information[(p, p)] = 1.0;
    }
    let mut covariance = bounded_covariance(problem, &information)?;
    for p in (0..held.len()).filter(|&p| held[p]) {
        covariance[(p, p)] = 0.0;
    }
    Some(covariance)
}
