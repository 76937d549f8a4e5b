//! Six wheels whose loads differ, and what a method says of many draws of their noise.

use kapvik_firmware::identification::{Identified, Observation, Refusal};
use rayon::prelude::*;

use super::made::{EQUAL_LOAD_N, Normal, SIX_SLIPS, averaged, noisy, seen, table_1_sand};

/// Deviations of the six loads from their mean, in units of the spread.
pub type Pattern = [f64; 6];

/// Loads that change sides from wheel to wheel.
pub const ALTERNATING: [Pattern; 2] = [[-1.0, 1.0, -1.0, 1.0, -1.0, 1.0], [1.0, -1.0, 1.0, -1.0, 1.0, -1.0]];

/// Six wheels on the seed's sand under loads of `spread` (share of the mean load) times a pattern.
pub fn loaded(spread: f64, pattern: &Pattern) -> [Observation<f64>; 6] {
    let loads = pattern.map(|deviation| EQUAL_LOAD_N * (1.0 + spread * deviation));
    std::array::from_fn(|wheel| seen(&table_1_sand(), SIX_SLIPS[wheel], loads[wheel]))
}

/// The observations as means of `instants`, with noise drawn.
pub fn draw(wheels: &[Observation<f64>; 6], instants: f64, random: &mut Normal) -> [Observation<f64>; 6] {
    wheels.map(|wheel| noisy(&averaged(&wheel, instants), random))
}

/// A pattern of even chances.
pub fn any_pattern(random: &mut Normal) -> Pattern {
    std::array::from_fn(|_| random.even(-1.0, 1.0))
}

/// Median and quartiles.
#[derive(Debug, Clone, Copy)]
pub struct Quartiles {
    /// A quarter lies below.
    pub first: f64,
    /// Half lies below.
    pub median: f64,
    /// Three quarters lie below.
    pub third: f64,
}

impl Quartiles {
    /// Of some numbers.
    pub fn of(mut numbers: Vec<f64>) -> Self {
        numbers.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let place = share * (numbers.len() - 1) as f64;
            let below = numbers[place.floor() as usize];
            below + place.fract() * (numbers[place.ceil() as usize] - below)
        };
        let [first, median, third] = [0.25, 0.5, 0.75].map(at);
        Self { first, median, third }
    }
}

impl std::fmt::Display for Quartiles {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.1} [{:.1}, {:.1}]", self.median, self.first, self.third)
    }
}

/// A method, for these observations.
pub trait Method: Fn(&[Observation<f64>]) -> Result<Identified<f64>, Refusal> + Sync {}
impl<F: Fn(&[Observation<f64>]) -> Result<Identified<f64>, Refusal> + Sync> Method for F {}

/// c (Pa), φ (degrees) and K (mm) over the draws that were answered, and the share of those refused.
pub struct Outcome {
    pub cohesion_pa: Quartiles,
    pub friction_deg: Quartiles,
    pub modulus_mm: Quartiles,
    pub refused: f64,
}

impl Outcome {
    fn of(answers: Vec<Result<Identified<f64>, Refusal>>) -> Self {
        let draws = answers.len() as f64;
        let answered: Vec<_> = answers.into_iter().filter_map(Result::ok).collect();
        let quartiles = |number: fn(&Identified<f64>) -> f64| Quartiles::of(answered.iter().map(number).collect());
        Self {
            cohesion_pa: quartiles(|soil| soil.cohesion_pa.value),
            friction_deg: quartiles(|soil| soil.friction_angle_rad.value.to_degrees()),
            modulus_mm: quartiles(|soil| 1e3 * soil.shear_modulus_m.value),
            refused: 1.0 - answered.len() as f64 / draws,
        }
    }
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { cohesion_pa, friction_deg, modulus_mm, refused } = self;
        write!(f, "c {cohesion_pa} Pa, φ {friction_deg}°, K {modulus_mm} mm, refused {:.0} %", 100.0 * refused)
    }
}

/// What a method says of 400 draws, each of loads of its own.
pub fn outcome(spread: f64, instants: f64, method: &impl Method) -> Outcome {
    const DRAWS: u64 = 400;
    let one = |seed| {
        let mut random = Normal::new(seed);
        let wheels = loaded(spread, &any_pattern(&mut random));
        method(&draw(&wheels, instants, &mut random))
    };
    Outcome::of((0..DRAWS).map(one).collect())
}

/// The outcomes of 100 draws for each of 24 patterns of loads: how far a figure moves with a pattern that is not stated.
pub fn by_pattern(spread: f64, instants: f64, method: &impl Method) -> Vec<Outcome> {
    const PATTERNS: usize = 24;
    const DRAWS: u64 = 100;
    let one = |seed: usize| {
        let mut random = Normal::new(1_000 + seed as u64);
        let pattern = ALTERNATING.get(seed).copied().unwrap_or_else(|| any_pattern(&mut random));
        let wheels = loaded(spread, &pattern);
        Outcome::of((0..DRAWS).map(|_| method(&draw(&wheels, instants, &mut random))).collect())
    };
    (0..PATTERNS).into_par_iter().map(one).collect()
}

/// First quartile, median and third quartile as published, as far as they are.
pub type Published = [Option<f64>; 3];

/// Which of the published figures could be those of one more pattern: not below the least nor above the greatest of the
/// patterns'. Of figures that come of the same method 2 in 25 are outside. One that is not published is none.
pub fn could_be_one_more(
    cell: &str,
    outcomes: &[Outcome],
    number: fn(&Outcome) -> Quartiles,
    published: Published,
) -> [bool; 3] {
    let parts: [fn(&Quartiles) -> f64; 3] = [|q| q.first, |q| q.median, |q| q.third];
    print!("{cell}:");
    let could = std::array::from_fn(|part| {
        let figures: Vec<_> = outcomes.iter().map(|outcome| parts[part](&number(outcome))).collect();
        let low = figures.iter().copied().fold(f64::INFINITY, f64::min);
        let high = figures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let name = ["first quartile", "median", "third quartile"][part];
        let published_or_none = published[part].map_or("–".into(), |figure| figure.to_string());
        print!("  {name} {published_or_none}, here {:.1} ({low:.1} … {high:.1})", Quartiles::of(figures).median);
        published[part].is_none_or(|figure| (low..=high).contains(&figure))
    });
    println!();
    could
}
