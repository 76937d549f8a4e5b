//! A model that is linear in everything, and campaigns drawn from it.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::diagnose::fit::{
    CHANNELS, Coordinate, Derivatives, Latent, Model, OffsetStd, Options, Prediction, Reading, Row, Start, fit,
};

/// How a row's readings depend on everything.
#[derive(Debug, Clone)]
pub struct Terms {
    pub constant: [f64; CHANNELS],
    pub parameters: Vec<[f64; CHANNELS]>,
    pub slip: [f64; CHANNELS],
    pub load: [f64; CHANNELS],
}

#[derive(Debug, Clone)]
pub struct Linear {
    pub coordinates: Vec<Coordinate>,
    pub terms: Vec<Terms>,
}

impl Linear {
    pub fn value(&self, row: usize, parameters: &[f64], latent: &Latent) -> [f64; CHANNELS] {
        let terms = &self.terms[row];
        std::array::from_fn(|c| {
            let by_parameters: f64 = terms.parameters.iter().zip(parameters).map(|(by, value)| by[c] * value).sum();
            terms.constant[c] + by_parameters + terms.slip[c] * latent.slip + terms.load[c] * latent.load_n
        })
    }
}

impl Model for Linear {
    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        let predict = |(&row, latent): (&usize, &mut Latent)| Prediction {
            value: self.value(row, parameters, latent),
            slopes: Derivatives {
                by_parameter: self.terms[row].parameters.clone(),
                by_slip: self.terms[row].slip,
                by_load: self.terms[row].load,
            },
        };
        Some(rows.iter().zip(latents).map(predict).collect())
    }
}

/// A coordinate without prior and without bounds.
pub fn free(name: &str) -> Coordinate {
    Coordinate { name: name.to_owned(), low: f64::NEG_INFINITY, high: f64::INFINITY, start: 0.0, prior: None }
}

/// Squares in place of Huber's loss, no offsets, no range of the latents: what closed forms are made for.
pub fn plain() -> Options {
    Options {
        huber: f64::INFINITY,
        offsets: [OffsetStd::None; CHANNELS],
        slip_range: (f64::NEG_INFINITY, f64::INFINITY),
        load_range_n: (f64::NEG_INFINITY, f64::INFINITY),
        ..Options::default()
    }
}

/// How many starts come within 0.1 in ln posterior of the best, and how many to a fit at all.
pub fn agreeing(model: &dyn Model, rows: &[Row], starts: &[Start], options: &Options) -> [usize; 2] {
    let posterior = |start: &Start| Some(fit(model, rows, start, options).ok()?.log_posterior);
    let found: Vec<f64> = starts.iter().filter_map(posterior).collect();
    let highest = found.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [found.iter().filter(|posterior| **posterior > highest - 0.1).count(), found.len()]
}

/// A row of a run with nothing measured and noise 1.
pub fn blank(run: usize) -> Row {
    Row { run, readings: [None; CHANNELS], noise: [1.0; CHANNELS] }
}

pub fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

pub fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Noise of mean square 1 that keeps a share from row to row, after what it was before, if it was.
pub fn red(before: Option<f64>, kept: f64, random: &mut ChaCha8Rng) -> f64 {
    let fresh = normal(random);
    before.map_or(fresh, |before| kept * before + (1.0 - kept * kept).sqrt() * fresh)
}

/// True offsets of the judged channels and noise of a drawn campaign.
pub const OFFSET: [f64; CHANNELS] = [0.6, 0.2, 0.002, 0.5, 0.0, 0.0];
pub const NOISE: [f64; CHANNELS] = [0.5, 0.1, 0.001, 0.4, 0.02, 1.5];

/// A campaign of `sizes.len()` runs of so many rows each and `count` parameters (true values 0.5, 1.0, 1.5, …), all channels
/// measured, latents anywhere in 0 to 0.6 and 40 to 80 N.
pub fn campaign(sizes: &[usize], count: usize, seed: u64) -> (Linear, Vec<Row>) {
    let mut random = random(seed);
    let truth: Vec<f64> = (0..count).map(|p| 0.5 * (p + 1) as f64).collect();
    let mut model = Linear { coordinates: (0..count).map(|p| free(&format!("p{p}"))).collect(), terms: Vec::new() };
    let mut rows = Vec::new();
    for (run, &size) in sizes.iter().enumerate() {
        let offset: [f64; CHANNELS] = std::array::from_fn(|c| OFFSET[c] * normal(&mut random));
        for _ in 0..size {
            let latent =
                Latent { slip: random.random_range(0.0..0.6), load_n: random.random_range(40.0..80.0), sinkage_m: 0.0 };
            model.terms.push(terms(count, &mut random));
            let value = model.value(rows.len(), &truth, &latent);
            let readings = std::array::from_fn(|c| Some(value[c] + offset[c] + NOISE[c] * normal(&mut random)));
            rows.push(Row { run, readings, noise: NOISE });
        }
    }
    (model, rows)
}

/// Judged channels depend on everything; slip and load readings are those of the latents, with a little of the first parameter.
fn terms(count: usize, random: &mut ChaCha8Rng) -> Terms {
    let mut draw = |size: f64| -> [f64; CHANNELS] {
        std::array::from_fn(|c| if c < 4 { size * NOISE[c] * random.random_range(-1.0..1.0) } else { 0.0 })
    };
    let mut terms = Terms {
        constant: draw(3.0),
        parameters: (0..count).map(|_| draw(2.0)).collect(),
        slip: draw(20.0),
        load: draw(0.2),
    };
    terms.slip[Reading::Slip.index()] = 1.0;
    terms.load[Reading::Load.index()] = 1.0;
    terms.slip[Reading::Load.index()] = 3.0;
    terms.parameters[0][Reading::Slip.index()] = 0.01;
    terms
}
