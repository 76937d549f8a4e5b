//! How far answers are from the truth, case by case and over many.

use kapvik_firmware::terramechanics::Soil;
use rand::SeedableRng;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use crate::identify::method::{Finding, Statement};
use crate::parameter::Parameter;
use crate::statistics::{median, quantile, root_mean_square, sorted};

/// What a contender reached in a situation.
#[derive(Debug, Clone, Serialize)]
pub struct Score {
    /// The contender.
    pub contender: &'static str,
    /// Cases.
    pub cases: usize,
    /// Share of them that it refused.
    pub refused: f64,
    /// Its most frequent reason.
    pub reason: Option<String>,
    /// Mean time of an answer, s.
    pub seconds: f64,
    /// c, Pa.
    pub cohesion_pa: ParameterScore,
    /// φ, degrees.
    pub friction_angle_deg: ParameterScore,
    /// K, mm.
    pub shear_modulus_mm: ParameterScore,
}

/// Of one parameter, over the cases that were answered.
#[derive(Debug, Clone, Default, Serialize)]
pub struct ParameterScore {
    /// Median of the estimates.
    pub median: f64,
    /// A quarter of the estimates lies below.
    pub low_quartile: f64,
    /// A quarter of the estimates lies above.
    pub high_quartile: f64,
    /// Median of the errors' sizes.
    pub median_error: f64,
    /// Root mean square error.
    pub rmse: f64,
    /// Median of the errors: estimate less truth.
    pub bias: f64,
    /// Share of the 68 % intervals that hold the truth.
    pub within_68: f64,
    /// Share of the 95 % intervals that hold the truth.
    pub within_95: f64,
    /// Share called identifiable.
    pub identifiable: f64,
    /// Whether the contender takes it as given.
    pub assumed: bool,
    /// Sizes of the errors by place of the case, for comparison with others; not written.
    #[serde(skip)]
    pub errors: Vec<(usize, f64)>,
}

/// One answer, and how long it took.
#[derive(Debug, Clone)]
pub struct Timed {
    /// What was said.
    pub found: Result<Finding, String>,
    /// How long it took, s.
    pub seconds: f64,
}

impl Parameter {
    /// Of a finding, in the SI unit.
    fn of_finding(self, finding: &Finding) -> &Statement {
        match self {
            Self::Cohesion => &finding.cohesion_pa,
            Self::FrictionAngle => &finding.friction_angle_rad,
            Self::ShearModulus => &finding.shear_modulus_m,
        }
    }
}

impl Score {
    /// Of a contender's answers to the cases.
    pub fn of(contender: &'static str, truths: &[Soil<f64>], answers: &[Timed]) -> Self {
        let answered = |(place, (truth, timed)): (usize, (&Soil<f64>, &Timed))| {
            Some((place, *truth, timed.found.as_ref().ok()?.clone()))
        };
        let found: Vec<(usize, Soil<f64>, Finding)> =
            truths.iter().zip(answers).enumerate().filter_map(answered).collect();
        let [cohesion_pa, friction_angle_deg, shear_modulus_mm] =
            Parameter::ALL.map(|parameter| ParameterScore::of(parameter, &found));
        let cases = answers.len();
        Self {
            contender,
            cases,
            refused: 1.0 - found.len() as f64 / cases as f64,
            reason: most_frequent(answers.iter().filter_map(|timed| timed.found.as_ref().err())),
            seconds: answers.iter().map(|timed| timed.seconds).sum::<f64>() / cases as f64,
            cohesion_pa,
            friction_angle_deg,
            shear_modulus_mm,
        }
    }

    /// Of one parameter.
    pub fn parameter(&self, parameter: Parameter) -> &ParameterScore {
        match parameter {
            Parameter::Cohesion => &self.cohesion_pa,
            Parameter::FrictionAngle => &self.friction_angle_deg,
            Parameter::ShearModulus => &self.shear_modulus_mm,
        }
    }
}

impl ParameterScore {
    fn of(parameter: Parameter, found: &[(usize, Soil<f64>, Finding)]) -> Self {
        let count = found.len() as f64;
        let values = sorted(found.iter().map(|(_, _, finding)| parameter.shown(parameter.of_finding(finding).value)));
        let error = |(_, soil, finding): &(usize, Soil<f64>, Finding)| {
            parameter.shown(parameter.of_finding(finding).value) - parameter.shown(parameter.of_soil(soil))
        };
        let by_place = found.iter().map(|one| (one.0, error(one).abs())).collect();
        let errors = sorted(found.iter().map(error));
        let sizes = sorted(errors.iter().map(|error| error.abs()));
        let share = |holds: &dyn Fn(f64, &Statement) -> bool| {
            let held =
                found.iter().filter(|(_, soil, finding)| holds(parameter.of_soil(soil), parameter.of_finding(finding)));
            held.count() as f64 / count
        };
        let inside = |truth: f64, [low, high]: [f64; 2]| low <= truth && truth <= high;
        Self {
            median: quantile(&values, 0.5),
            low_quartile: quantile(&values, 0.25),
            high_quartile: quantile(&values, 0.75),
            median_error: quantile(&sizes, 0.5),
            rmse: root_mean_square(errors.iter().copied()),
            bias: quantile(&errors, 0.5),
            within_68: share(&|truth, statement| inside(truth, statement.interval_68)),
            within_95: share(&|truth, statement| inside(truth, statement.interval_95)),
            identifiable: share(&|_, statement| statement.identifiable),
            errors: by_place,
            assumed: found.iter().any(|(_, _, finding)| parameter.of_finding(finding).assumed),
        }
    }
}

/// Whether the median error of one is greater than that of the other beyond the chance of the cases drawn: in 95 of 100
/// resamplings of the cases that both answered (B. Efron's bootstrap).
pub fn is_beaten(one: &ParameterScore, other: &ParameterScore) -> bool {
    const RESAMPLINGS: usize = 1000;
    let others: std::collections::HashMap<usize, f64> = other.errors.iter().copied().collect();
    let pairs: Vec<(f64, f64)> =
        one.errors.iter().filter_map(|(place, error)| Some((*error, *others.get(place)?))).collect();
    let mut random = ChaCha8Rng::seed_from_u64(0);
    let mut worse = || {
        let drawn: Vec<&(f64, f64)> = (0..pairs.len()).filter_map(|_| pairs.choose(&mut random)).collect();
        median(drawn.iter().map(|pair| pair.0)) > median(drawn.iter().map(|pair| pair.1))
    };
    let count = (0..RESAMPLINGS).filter(|_| worse()).count();
    count as f64 > 0.95 * RESAMPLINGS as f64
}

fn most_frequent<'a>(reasons: impl Iterator<Item = &'a String>) -> Option<String> {
    let mut counts = std::collections::BTreeMap::new();
    for reason in reasons {
        *counts.entry(reason).or_insert(0_usize) += 1;
    }
    counts.into_iter().max_by_key(|(_, count)| *count).map(|(reason, _)| reason.clone())
}
