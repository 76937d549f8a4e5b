//! Advice to a driver.

use std::fmt::Write as _;

use serde::Serialize;

use crate::parameter::Parameter;

use super::bound::Bound;
use super::cost::{CostWeights, Expense};
use super::manoeuvre::{Leg, RimSpeeds, USUAL};
use super::rover_side::RoverMeasurement;
use super::search::{DrivenLeg, Finding, Manoeuvre, Question, manoeuvres};

/// What is to be done, and what else could be.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// Targets asked for that are known well enough after it.
    pub reached: Vec<Parameter>,
    /// The cheapest manoeuvre; where no target is within reach, the one that knows most.
    pub best: Finding,
    /// The cheapest of each other kind, cheapest first.
    pub others: Vec<Finding>,
    /// The single leg that knows most in the time of the first; none where the first has a single leg.
    pub one_leg: Option<Finding>,
    /// The usual drive in the time of the first; none where it leaves something open of which nothing is known beforehand.
    pub usual: Option<Finding>,
    /// What is known before any drive, as far as anything is.
    pub before: Option<Bound>,
}

/// Why there is no advice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoAdvice {
    /// The rover cannot drive as usual.
    #[error(
        "the rover cannot drive on level ground of this soil: it does not pull, or a wheel sinks deeper than 0.6 of its radius"
    )]
    Stuck,
    /// Nothing is told.
    #[error("no manoeuvre tells all parameters of which nothing is known beforehand")]
    Nothing,
}

impl Advice {
    /// The advice. `done` is called after each leg of the grid.
    ///
    /// # Errors
    /// Where the rover cannot drive, or nothing can be told.
    pub fn new(question: &Question, done: impl Fn() + Sync) -> Result<Self, NoAdvice> {
        let legs = question.legs(done);
        let usual = legs.iter().find(|driven| driven.leg == USUAL).ok_or(NoAdvice::Stuck)?;
        let all = manoeuvres(&legs);
        let reached = question.within_reach(&all);
        let mut findings = if reached.is_empty() { Vec::new() } else { question.cheapest(&all, usual, &reached) };
        if findings.is_empty() {
            findings.extend(question.best_known(&all, usual, question.longest_s));
        }
        let mut findings = findings.into_iter();
        let best = findings.next().ok_or(NoAdvice::Nothing)?;
        let time_s = best.expense.time_s;
        let single: Vec<Manoeuvre<'_>> = all.iter().filter(|manoeuvre| manoeuvre.count() == 1).copied().collect();
        let one_leg = if best.legs.len() == 1 { None } else { question.best_known(&single, usual, time_s) };
        let alone = Manoeuvre::of(std::slice::from_ref(usual));
        let usual = alone.and_then(|alone| question.finding(&alone, usual, time_s));
        let before = Bound::new(&question.measurement.beforehand, &[]);
        Ok(Self { reached, best, others: findings.collect(), one_leg, usual, before })
    }

    /// The advice as a sentence.
    pub fn sentence(&self, question: &Question) -> String {
        let best = &self.best;
        let mut text = order(best);
        let known = |target: &&Parameter| self.reached.contains(target);
        let named = |target: &Parameter| {
            format!("{} to {}", target.symbol(), percent(best.bound.relative(*target, &question.soil)))
        };
        let reached: Vec<String> = question.targets.iter().filter(known).map(named).collect();
        let missed: Vec<String> = question
            .targets
            .iter()
            .filter(|target| !known(target))
            .map(|target| {
                format!(
                    "{} not within reach ({})",
                    target.symbol(),
                    percent(best.bound.relative(*target, &question.soil))
                )
            })
            .collect();
        let all: Vec<String> = reached.into_iter().chain(missed).collect();
        let _ = write!(text, ": {}", all.join(", "));
        text
    }
}

/// A share as whole per cent; more digits where it is small, and none where it means that nothing is known.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent {
        ..1.0 => format!("{percent:.1} %"),
        ..1000.0 => format!("{percent:.0} %"),
        _ => "over 1000 %".to_owned(),
    }
}

/// A manoeuvre as an order.
pub fn order(finding: &Finding) -> String {
    let share_s = finding.expense.time_s / finding.legs.len() as f64;
    let legs = finding.legs.iter().map(|driven| format!("{} for {share_s:.0} s", driven.leg));
    legs.collect::<Vec<_>>().join(", then ")
}

/// The advice as a file says it.
#[derive(Debug, Clone, Serialize)]
pub struct Document {
    /// The soil, as it was asked for.
    pub soil: String,
    /// Accuracy asked for, as a share of the value.
    pub accuracy: f64,
    /// The longest manoeuvre that was looked at, s.
    pub longest_s: f64,
    /// Sensors, and what is known beforehand.
    pub measurement: RoverMeasurement,
    /// Rim speeds.
    pub speeds: RimSpeeds,
    /// What things cost.
    pub weights: CostWeights,
    /// The sentence.
    pub advice: String,
    /// Targets that are known well enough after it.
    pub reached: Vec<Parameter>,
    /// Manoeuvres, cheapest first.
    pub manoeuvres: Vec<Row>,
    /// The single leg that tells most in the same time as the first; none where the first has a single leg.
    pub one_leg: Option<Row>,
    /// The usual drive in the same time as the first; none where it leaves something open of which nothing is known
    /// beforehand.
    pub usual: Option<Row>,
}

/// A manoeuvre in the file.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// As an order.
    pub order: String,
    /// Its legs, of equal time.
    pub legs: Vec<LegRow>,
    /// What it takes.
    pub expense: Expense,
    /// What that costs.
    pub cost: f64,
    /// Standard deviation of c over c.
    pub cohesion_relative_std: f64,
    /// Standard deviation of φ over φ.
    pub friction_angle_relative_std: f64,
    /// Standard deviation of K over K.
    pub shear_modulus_relative_std: f64,
}

/// A leg in the file.
#[derive(Debug, Clone, Serialize)]
pub struct LegRow {
    /// What is asked for.
    #[serde(flatten)]
    pub leg: Leg,
    /// Speed of the hubs, m/s.
    pub hub_speed_m_s: f64,
    /// Rim speeds, m/s, front to rear.
    pub rim_speeds_m_s: [f64; 3],
    /// Slips, front to rear.
    pub slips: [f64; 3],
    /// Loads, N, front to rear.
    pub loads_n: [f64; 3],
}

impl Document {
    /// Of an advice.
    pub fn new(soil: &str, question: &Question, advice: &Advice) -> Self {
        let row = |finding: &Finding| {
            let relative = |target| finding.bound.relative(target, &question.soil);
            Row {
                order: order(finding),
                legs: finding.legs.iter().map(LegRow::new).collect(),
                expense: finding.expense,
                cost: finding.cost,
                cohesion_relative_std: relative(Parameter::Cohesion),
                friction_angle_relative_std: relative(Parameter::FrictionAngle),
                shear_modulus_relative_std: relative(Parameter::ShearModulus),
            }
        };
        Self {
            soil: soil.to_owned(),
            accuracy: question.accuracy,
            longest_s: question.longest_s,
            measurement: question.measurement,
            speeds: question.speeds,
            weights: question.weights,
            advice: advice.sentence(question),
            reached: advice.reached.clone(),
            manoeuvres: std::iter::once(&advice.best).chain(&advice.others).map(row).collect(),
            one_leg: advice.one_leg.as_ref().map(row),
            usual: advice.usual.as_ref().map(row),
        }
    }
}

impl LegRow {
    fn new(driven: &DrivenLeg) -> Self {
        let wheels = driven.drive.wheels.into_array();
        Self {
            leg: driven.leg,
            hub_speed_m_s: driven.drive.hub_speed_m_s,
            rim_speeds_m_s: wheels.map(|wheel| wheel.rim_speed_m_s),
            slips: wheels.map(|wheel| wheel.slip),
            loads_n: wheels.map(|wheel| wheel.load_n),
        }
    }
}
