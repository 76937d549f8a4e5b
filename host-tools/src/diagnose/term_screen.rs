//! A first look at terms of a law or of a column: what each would gain if everything were linear and every channel's errors its own. Good
//! enough to say which of a thousand terms deserve a fit.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::bench::Held;
use super::fit::{Fit, Latent, Model, Prediction, Reading, Row};
use super::linearised::{AddedTerms, Linearised};

/// Standard deviations beyond which a residual counts as so many.
const OUTLIER: f64 = 3.0;
/// Share of the largest singular value below which a direction is none.
const SINGULAR: f64 = 1e-7;
/// Share of a term that must be left beside the parameters for it to say anything.
const OWN_SHARE: f64 = 1e-4;

/// The residuals of a channel, less all that the parameters can make of them.
#[derive(Debug, Clone)]
pub struct Screen {
    whitening: Whitening,
    /// What the parameters can do in the channel's rows: a part of an orthonormal basis.
    basis: DMatrix<f64>,
    residual: DVector<f64>,
}

impl Screen {
    /// The residuals that a fit with some added terms leaves; none where nothing is measured or predicted.
    pub fn new(linearised: &Linearised<'_>, added: &AddedTerms, fit: &Fit, held: &Held) -> Option<Self> {
        let model = linearised.with(added);
        let mut latents: Vec<Latent> = held.rows.iter().zip(&fit.latents).map(measured).collect();
        let all: Vec<usize> = (0..held.rows.len()).collect();
        let predictions = model.predict(&fit.parameters, &all, &mut latents)?;
        let smallest = held.options.smallest_run_with_offset;
        let mut system = System::default();
        let mut own = None;
        for reading in Reading::JUDGED {
            let whitening =
                Whitening::new(&held.rows, &predictions, reading, fit.offset_std[reading.index()], smallest);
            let place = system.put(&held.rows, &predictions, reading, &whitening);
            if reading == added.channel {
                own = Some((whitening, place));
            }
        }
        system.put_priors(&model, &fit.parameters);
        let free = (0..fit.parameters.len()).filter(|p| !fit.on_bound[*p]);
        let columns: Vec<DVector<f64>> = free.filter_map(|p| system.column(p)).collect();
        let residual = DVector::from_vec(system.residual);
        let basis = if columns.is_empty() {
            DMatrix::zeros(residual.len(), 0)
        } else {
            let decomposed = DMatrix::from_columns(&columns).svd(true, false);
            let greatest = decomposed.singular_values.max();
            let kept = (0..columns.len()).filter(|k| decomposed.singular_values[*k] > SINGULAR * greatest);
            decomposed.u?.select_columns(&kept.collect::<Vec<_>>())
        };
        let left = &residual - &basis * basis.tr_mul(&residual);
        let (whitening, place) = own?;
        Some(Self {
            whitening,
            basis: basis.rows(place.start, place.len()).into_owned(),
            residual: left.rows(place.start, place.len()).into_owned(),
        })
    }

    /// What a term with these values in the rows gains in ln likelihood, nearly.
    pub fn gain(&self, values: &[f64]) -> f64 {
        self.gain_together(std::iter::once(values))
    }

    /// What terms gain together.
    pub fn gain_together<'a>(&self, terms: impl Iterator<Item = &'a [f64]>) -> f64 {
        let mut taken: Vec<Taken> = Vec::new();
        let mut gain = 0.0;
        for values in terms {
            let term = DVector::from_vec(self.whitening.apply(|row, _| values[row]));
            let mut new =
                Taken { by_parameters: self.basis.tr_mul(&term), own_part: 0.0, along: term.dot(&self.residual), term };
            let whole = new.term.norm_squared();
            for other in &taken {
                new.take_off(other);
            }
            new.own_part = new.term.norm_squared() - new.by_parameters.norm_squared();
            if new.own_part > OWN_SHARE * whole {
                gain += 0.5 * new.along.powi(2) / new.own_part;
                taken.push(new);
            }
        }
        gain
    }
}

/// A term, less what those before it can make of it.
struct Taken {
    term: DVector<f64>,
    /// Its part that the parameters can make, in the coordinates of the basis.
    by_parameters: DVector<f64>,
    /// The square of what is left.
    own_part: f64,
    /// Its product with the residual.
    along: f64,
}

impl Taken {
    fn take_off(&mut self, other: &Self) {
        let share = (self.term.dot(&other.term) - self.by_parameters.dot(&other.by_parameters)) / other.own_part;
        self.term.axpy(-share, &other.term, 1.0);
        self.by_parameters.axpy(-share, &other.by_parameters, 1.0);
        self.along -= share * other.along;
    }
}

/// A row's slip and load as they were measured.
fn measured((row, latent): (&Row, &Latent)) -> Latent {
    Latent {
        slip: row.readings[Reading::Slip.index()].unwrap_or(latent.slip),
        load_n: row.readings[Reading::Load.index()].unwrap_or(latent.load_n),
        ..*latent
    }
}

/// Makes errors of a channel's readings, which the rows of a run share in part, independent and one in size.
#[derive(Debug, Clone)]
struct Whitening {
    rows: Vec<usize>,
    weights: Vec<f64>,
    /// The places of each run, and how much of their common part is taken off.
    runs: Vec<(Range<usize>, f64)>,
    /// Standard deviation of the runs' offsets.
    offset_std: f64,
}

impl Whitening {
    fn new(rows: &[Row], predictions: &[Prediction], reading: Reading, offset_std: f64, smallest: usize) -> Self {
        let c = reading.index();
        let places: Vec<usize> = (0..rows.len()).filter(|row| rows[*row].readings[c].is_some()).collect();
        let weight = |row: &usize| {
            let (of_row, slopes) = (&rows[*row], &predictions[*row].slopes);
            let by = |source: Reading, slope: f64| {
                of_row.readings[source.index()].map_or(0.0, |_| slope * of_row.noise[source.index()])
            };
            let through = [by(Reading::Slip, slopes.by_slip[c]), by(Reading::Load, slopes.by_load[c])];
            1.0 / (of_row.noise[c].powi(2) + through[0].powi(2) + through[1].powi(2)).sqrt()
        };
        let weights: Vec<f64> = places.iter().map(weight).collect();
        let mut runs = Vec::new();
        let mut start = 0;
        for of_run in places.chunk_by(|a, b| rows[*a].run == rows[*b].run) {
            let range = start..start + of_run.len();
            start = range.end;
            let size: f64 = weights[range.clone()].iter().map(|weight| weight * weight).sum();
            if offset_std > 0.0 && of_run.len() >= smallest {
                // The inverse root of 1 + τ² u uᵀ.
                runs.push((range, (1.0 - 1.0 / (1.0 + offset_std * offset_std * size).sqrt()) / size));
            }
        }
        Self { rows: places, weights, runs, offset_std }
    }

    /// A value of each row, told the row and its weight, made one of an independent error.
    fn apply(&self, value: impl Fn(usize, f64) -> f64) -> Vec<f64> {
        let rows = self.rows.iter().zip(&self.weights);
        let mut found: Vec<f64> = rows.map(|(row, weight)| weight * value(*row, *weight)).collect();
        for (range, shrink) in &self.runs {
            let common: f64 = found[range.clone()].iter().zip(&self.weights[range.clone()]).map(|(a, b)| a * b).sum();
            for place in range.clone() {
                found[place] -= shrink * common * self.weights[place];
            }
        }
        found
    }
}

/// Residuals of all channels and of the priors, and their derivatives by each parameter, in units of their errors.
#[derive(Debug, Default)]
struct System {
    residual: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

impl System {
    /// Puts in a channel; gives its place.
    fn put(
        &mut self,
        rows: &[Row],
        predictions: &[Prediction],
        reading: Reading,
        whitening: &Whitening,
    ) -> Range<usize> {
        let c = reading.index();
        let start = self.residual.len();
        let offset_std = whitening.offset_std;
        let residual = |row: usize, weight: f64| {
            let bound = OUTLIER * (1.0 / (weight * weight) + offset_std * offset_std).sqrt();
            rows[row].readings[c].map_or(0.0, |measured| (measured - predictions[row].value[c]).clamp(-bound, bound))
        };
        self.residual.extend(whitening.apply(residual));
        let count = predictions.first().map_or(0, |prediction| prediction.slopes.by_parameter.len());
        self.columns.resize(count, Vec::new());
        for (p, column) in self.columns.iter_mut().enumerate() {
            column.extend(whitening.apply(|row, _| predictions[row].slopes.by_parameter[p][c]));
        }
        start..self.residual.len()
    }

    fn put_priors(&mut self, model: &dyn Model, parameters: &[f64]) {
        for (p, (coordinate, value)) in model.coordinates().iter().zip(parameters).enumerate() {
            if let Some((mean, std)) = coordinate.prior {
                self.residual.push((mean - value) / std);
                for (other, column) in self.columns.iter_mut().enumerate() {
                    column.push(if other == p { 1.0 / std } else { 0.0 });
                }
            }
        }
    }

    /// The derivatives by a parameter, one in length; none where there are none.
    fn column(&self, parameter: usize) -> Option<DVector<f64>> {
        DVector::from_column_slice(self.columns.get(parameter)?).try_normalize(f64::MIN_POSITIVE)
    }
}
