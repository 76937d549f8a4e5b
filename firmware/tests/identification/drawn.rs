//! Six wheels whose loads differ, and what a method says of many draws of their noise.

use kapvik_firmware::identification::{Identified, Observation, Refusal};

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
    /// One standard deviation of the median, as if it were of that many normal numbers.
    pub median_std: f64,
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
        // Of normal numbers: 1.2533 σ/√N, σ being the interquartile range over 1.349.
        let median_std = 0.929 * (third - first) / (numbers.len() as f64).sqrt();
        Self { first, median, third, median_std }
    }
}

impl std::fmt::Display for Quartiles {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.1} [{:.1}, {:.1}]", self.median, self.first, self.third)
    }
}

/// c (Pa), φ (degrees) and K (mm) over the draws that were answered, and the share of those refused.
pub struct Outcome {
    pub cohesion_pa: Quartiles,
    pub friction_deg: Quartiles,
    pub modulus_mm: Quartiles,
    pub refused: f64,
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { cohesion_pa, friction_deg, modulus_mm, refused } = self;
        write!(f, "c {cohesion_pa} Pa, φ {friction_deg}°, K {modulus_mm} mm, refused {:.0} %", 100.0 * refused)
    }
}

/// What a method says of 400 draws.
pub fn outcome(
    spread: f64,
    pattern: Option<&Pattern>,
    instants: f64,
    method: impl Fn(&[Observation<f64>]) -> Result<Identified<f64>, Refusal>,
) -> Outcome {
    const DRAWS: u64 = 400;
    let known = pattern.map(|pattern| loaded(spread, pattern));
    let answers = (0..DRAWS).map(|seed| {
        let mut random = Normal::new(seed);
        let wheels = known.unwrap_or_else(|| loaded(spread, &any_pattern(&mut random)));
        method(&draw(&wheels, instants, &mut random))
    });
    let answered: Vec<_> = answers.filter_map(Result::ok).collect();
    let quartiles = |number: fn(&Identified<f64>) -> f64| Quartiles::of(answered.iter().map(number).collect());
    Outcome {
        cohesion_pa: quartiles(|soil| soil.cohesion_pa.value),
        friction_deg: quartiles(|soil| soil.friction_angle_rad.value.to_degrees()),
        modulus_mm: quartiles(|soil| 1e3 * soil.shear_modulus_m.value),
        refused: 1.0 - answered.len() as f64 / DRAWS as f64,
    }
}
