//! How true what a network or a method states is for runs of one layout: the run is rehearsed on soils near the answer.
//!
//! A network's intervals are true on the whole over what it was trained with. A campaign may be laid out as few of those scenes
//! were (slips all small, loads in three steps, thousands of rows), and there what it states may be too narrow without any
//! input being out of range. What a method of the literature states is the noise by its own equations, not what it errs by since
//! these are simpler than the wheel, or since it takes a number as given. So soils are drawn about the answer, what the run's
//! sensors would show of each is given to the network or the method, and its answers are held against the soils. Where more of
//! them than chance explains lie outside of the intervals, an error is added to those: the least with which they hold as many as
//! they promise. Nothing is made narrower, and no value is changed.

use kapvik_firmware::network::TARGETS;
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::WheelState;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::prior::{self, Range, SOIL_PARAMETERS};
use crate::statistics::{quantile, sorted};
use crate::train::example::soil_targets;

use super::layout::Layout;
use super::target::Target;

/// Soils about the answer: the share of a 95 % interval then has a standard error of 1.5 %.
const SOILS: u64 = 200;
/// Their first seed; those below are of soils that bends are learnt from.
const FIRST_SEED: u64 = 1 << 32;
/// Fewer of them that carry the wheels say nothing.
const LEAST_SOILS: usize = 50;
/// A uniform distribution reaches so many of its standard deviations to either side.
pub const REACH: f64 = 1.732_050_807_568_877_2;
/// Shares are below what is promised by chance by up to so many of their standard errors.
const BY_CHANCE: f64 = 2.0;
/// Soils are drawn anew where errors turn out greater than they were drawn for by this factor…
const GROWN: f64 = 1.2;
/// …and no more often.
const ROUNDS: usize = 4;

/// Soils about an answer.
pub trait Soils: Sync {
    /// A soil whose c, φ and K are about what is stated, within such widths, as standard deviations.
    fn draw(&self, stated: &[Target; TARGETS], widths: &[f64; TARGETS], random: &mut ChaCha8Rng) -> Soil<f64>;

    /// Its c, φ and K, counted as they are in what is stated.
    fn targets(&self, soil: &Soil<f64>) -> [f64; TARGETS];
}

/// Soils of the networks' training; ln c, φ and ln K are stated.
#[derive(Debug, Clone, Copy)]
pub struct OfTraining;

/// What is missing in the intervals of c, φ and K, or of their logarithms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Missing {
    /// Error to be added to the 68 % and the 95 % interval, as a standard deviation; zero where nothing is missing.
    pub errors: [[f64; 2]; TARGETS],
    /// Share of the rehearsed answers with the truth in the 68 % and the 95 % interval as they are stated.
    pub held: [[f64; 2]; TARGETS],
}

impl Missing {
    /// What is widened and why, in words, the intervals being of such; none where nothing is.
    pub fn in_words(&self, of: &str) -> Option<String> {
        let of_interval = |interval: usize| {
            let widened = || (0..TARGETS).filter(move |target| self.errors[*target][interval] != 0.0);
            let names: Vec<&str> = widened().map(|target| ["c", "φ", "K"][target]).collect();
            let held: Vec<String> =
                widened().map(|target| format!("{:.0}", 100.0 * self.held[target][interval])).collect();
            let [names, held] = [names.join(", "), held.join(", ")];
            (!names.is_empty()).then(|| format!("{} % intervals in {held} % ({names})", ["68", "95"][interval]))
        };
        let lacking: Vec<String> = [1, 0].into_iter().filter_map(of_interval).collect();
        (!lacking.is_empty()).then(|| {
            format!(
                "widened: on simulated soils, runs laid out as this one have the truth in the {of} own {}",
                lacking.join(", ")
            )
        })
    }
}

/// What the intervals that are stated lack on runs of this layout; none where too few soils carry the wheels, or too few are
/// answered. `widths` are the standard deviations of the soils about the answer; `ask` is what makes of states an answer.
pub fn missing(
    layout: &Layout,
    soils: &impl Soils,
    stated: &[Target; TARGETS],
    mut widths: [f64; TARGETS],
    ask: impl Fn(&[WheelState<f64>]) -> Option<[Target; TARGETS]> + Sync,
) -> Option<Missing> {
    let mut missing = Missing::default();
    for _ in 0..ROUNDS {
        let runs = layout.rehearse(FIRST_SEED..FIRST_SEED + SOILS, |random| soils.draw(stated, &widths, random));
        let answers: Vec<([f64; TARGETS], [Target; TARGETS])> =
            runs.par_iter().filter_map(|(soil, run)| Some((soils.targets(soil), ask(&run.states)?))).collect();
        if answers.len() < LEAST_SOILS {
            return None;
        }
        for target in 0..TARGETS {
            let of_target: Vec<(f64, Target)> =
                answers.iter().map(|(truth, answer)| (truth[target], answer[target])).collect();
            missing.errors[target] = lacking(&of_target);
            missing.held[target] = [0, 1].map(|interval| {
                let held = of_target.iter().filter(|(truth, answer)| answer.excess(*truth, interval) <= 0.0);
                held.count() as f64 / of_target.len() as f64
            });
        }
        let found: [f64; TARGETS] = std::array::from_fn(|target| {
            stated[target].std.hypot(missing.errors[target][1].max(missing.errors[target][0]))
        });
        let has_grown = found.iter().zip(&widths).any(|(found, width)| *found > GROWN * width);
        if !has_grown {
            break;
        }
        widths = found;
    }
    Some(missing)
}

impl Soils for OfTraining {
    fn draw(&self, stated: &[Target; TARGETS], widths: &[f64; TARGETS], random: &mut ChaCha8Rng) -> Soil<f64> {
        prior::any_soil_within(&about(stated, widths), || random.random())
    }

    fn targets(&self, soil: &Soil<f64>) -> [f64; TARGETS] {
        soil_targets(soil)
    }
}

/// Where soils are drawn: c, φ and K about the answer, all else from the prior.
fn about(stated: &[Target; TARGETS], widths: &[f64; TARGETS]) -> [Range; SOIL_PARAMETERS] {
    let mut ranges = prior::SOIL_RANGES;
    for (range, (target, width)) in ranges.iter_mut().zip(stated.iter().zip(widths)) {
        let end = |side: f64| {
            let end = target.value + side * REACH * width;
            if range.logarithmic { end.exp() } else { end }
        };
        let (low, high) = (end(-1.0).max(range.low), end(1.0).min(range.high));
        *range = Range { low: low.min(range.high), high: high.max(range.low), ..*range };
    }
    ranges
}

/// The error that is missing in the 68 % and in the 95 % interval of one target.
fn lacking(answers: &[(f64, Target)]) -> [f64; 2] {
    [(0, 0.68), (1, 0.95)].map(|(interval, share)| {
        let excesses = sorted(answers.iter().map(|(truth, answer)| answer.excess(*truth, interval)));
        let chance = (share * (1.0 - share) / answers.len() as f64).sqrt();
        if quantile(&excesses, share - BY_CHANCE * chance) > 0.0 { quantile(&excesses, share) } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};

    /// Six hundred errors of a standard deviation of one, stated to be of another.
    fn stated(std: f64) -> Vec<(f64, Target)> {
        let normal = |place: u32| {
            let share = (f64::from(place) + 0.5) / 600.0;
            std::f64::consts::SQRT_2 * statrs::function::erf::erf_inv(2.0 * share - 1.0)
        };
        let intervals = [1.0, 1.96].map(|width| [-width * std, width * std]);
        (0..600).map(|place| (normal(place), Target { value: 0.0, std, intervals })).collect()
    }

    #[test]
    fn what_is_missing_is_what_a_narrow_statement_leaves_out() {
        assert_eq!(lacking(&stated(1.0)), [0.0; 2], "nothing is missing");
        assert_eq!(lacking(&stated(1.5)), [0.0; 2], "nothing is made narrower");
        // √(1 − 0.5²) besides 0.5.
        for missing in lacking(&stated(0.5)) {
            assert!((missing - 0.866).abs() < 0.02, "{missing}");
        }
    }

    #[test]
    fn soils_are_drawn_about_the_answer_and_within_the_prior() {
        let parameter = |value, std| ParameterEstimate {
            value,
            std,
            interval_68: [value - std, value + std],
            interval_95: [value - 2.0 * std, value + 2.0 * std],
            identifiable: true,
        };
        let estimate = SoilEstimate {
            cohesion_pa: parameter(200.0, 20.0),
            friction_angle_rad: parameter(0.7, 0.05),
            shear_modulus_m: parameter(0.01, 0.001),
            outside_training_range: false,
        };
        let stated = crate::identify::logarithmic::targets(&estimate);
        let ranges = about(&stated, &stated.map(|target| target.std));
        for (range, prior) in ranges.iter().zip(&prior::SOIL_RANGES) {
            assert!(prior.low <= range.low && range.low < range.high && range.high <= prior.high, "{range:?}");
        }
        assert!(ranges[0].low > 150.0 && ranges[0].high < 260.0, "{:?}", ranges[0]);
        assert_eq!(ranges[1].high, prior::FRICTION_ANGLE_RAD.high);
        assert_eq!(ranges[3], prior::SOIL_RANGES[3]);
    }
}
