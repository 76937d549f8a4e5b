//! The search for the manoeuvre that makes a soil known at the least cost.
//!
//! A grid of legs, alone and in pairs of equal time; the best are refined in steps of five per cent of a rim speed. What a leg
//! says grows in proportion to its time, so that the time that an accuracy takes is found without driving it again. The first
//! seconds of every leg, until drives and wheels have settled, count for nothing.

use kapvik_firmware::rover::{Axle, PerAxle, Rover};
use kapvik_firmware::terramechanics::Soil;
use rayon::prelude::*;

use super::bound::Bound;
use super::cost::{CostWeights, Expense};
use super::information::Information;
use super::manoeuvre::{Leg, Pattern, RimSpeeds, USUAL};
use super::map::shortest;
use super::rover_side::RoverMeasurement;
use super::sensors::FRAMES_PER_SECOND;
use super::steady_drive::{SideBalance, SteadyDrive, steady_drive};
use crate::parameter::Parameter;

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// The rover.
    pub rover: Rover<f64>,
    /// The soil.
    pub soil: Soil<f64>,
    /// What is to be known.
    pub targets: Vec<Parameter>,
    /// How well, as a share of the value.
    pub accuracy: f64,
    /// The longest manoeuvre, s.
    pub longest_s: f64,
    /// The steepest slope at hand, rad.
    pub steepest_rad: f64,
    /// Rim speeds.
    pub speeds: RimSpeeds,
    /// Sensors, and what is known beforehand.
    pub measurement: RoverMeasurement,
    /// What things cost.
    pub weights: CostWeights,
}

/// A leg, and what the rover does in it.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenLeg {
    /// The leg.
    pub leg: Leg,
    /// What the rover does.
    pub drive: SteadyDrive,
    /// What a second of it says to the sensors of one side.
    per_second: Information,
    /// Power at the wheels, W.
    pub power_w: f64,
    /// Sinkage of the deepest wheel, m.
    pub deepest_m: f64,
}

/// One or two legs of equal time.
#[derive(Debug, Clone, Copy)]
pub struct Manoeuvre<'a> {
    first: &'a DrivenLeg,
    second: Option<&'a DrivenLeg>,
}

/// A manoeuvre of some length, what it tells and what it costs.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Its legs, of equal time.
    pub legs: Vec<DrivenLeg>,
    /// What is known after it.
    pub bound: Bound,
    /// What it takes.
    pub expense: Expense,
    /// What that costs.
    pub cost: f64,
}

/// Ratios of rim speeds on the grid.
const RATIOS: [f64; 6] = [0.6, 0.8, 1.0, 1.3, 1.6, 2.0];
/// The range of ratios.
const RATIO_RANGE: (f64, f64) = (0.6, 2.0);
/// Steps by which ratios are refined, one after the other.
const REFINEMENTS: [f64; 2] = [0.1, 0.05];
/// Most steps of a refinement.
const REFINING_STEPS: usize = 12;
/// Halvings of the range of times.
const HALVINGS: usize = 10;
/// The least time of a leg that is measured in, s.
const SHORTEST_S: f64 = 1.0;
/// Until a leg is steady, s: the drives take 1.5 s to new speeds ([`crate::simulate`]), and then the wheels roll over the
/// length of their contact, about 50 mm at 20 mm/s.
pub const SETTLING_S: f64 = 4.0;
/// The least time of a manoeuvre that tells anything, s.
pub const SHORTEST_MANOEUVRE_S: f64 = SETTLING_S + SHORTEST_S;

impl Question {
    /// What the rover does in a leg; none where it cannot.
    pub fn driven(&self, leg: Leg) -> Option<DrivenLeg> {
        let balance = SideBalance::new(&self.rover, leg.slope_rad);
        let drive = steady_drive(&self.rover, &self.soil, &balance, leg.pattern.drives(&self.speeds))?;
        let frame = self.measurement.information(&self.rover, &self.soil, &balance, &drive)?;
        let (mut power_w, mut deepest_m) = (0.0, 0.0_f64);
        for wheel in drive.wheels.into_array() {
            let [torque_nm, sinkage_m] =
                wheel.response.map_or([0.0; 2], |response| [response.value[1], response.value[2]]);
            power_w += 2.0 * torque_nm * wheel.rim_speed_m_s / self.rover.wheel.radius_m;
            deepest_m = deepest_m.max(sinkage_m);
        }
        Some(DrivenLeg { leg, drive, per_second: frame * FRAMES_PER_SECOND, power_w, deepest_m })
    }

    /// All legs of the grid that the rover can drive; the usual one first, where it can be driven.
    pub fn legs(&self, done: impl Fn() + Sync) -> Vec<DrivenLeg> {
        let grid = self.grid();
        let driven = |leg: &Leg| {
            let driven = self.driven(*leg);
            done();
            driven
        };
        grid.par_iter().filter_map(driven).collect()
    }

    /// Legs to look at.
    pub fn grid(&self) -> Vec<Leg> {
        let slopes: &[f64] = if self.steepest_rad > 0.0 { &[0.0, 0.5, 1.0, -0.5, -1.0] } else { &[0.0] };
        let mut legs = vec![USUAL];
        for slope in slopes {
            let slope_rad = slope * self.steepest_rad;
            for (front, middle, rear) in triples() {
                let leg = Leg { pattern: Pattern::Roll(PerAxle { front, middle, rear }), slope_rad };
                if leg.pattern.is_canonical() && leg != USUAL {
                    legs.push(leg);
                }
            }
        }
        legs.extend(Axle::ALL.into_array().map(|axle| Leg { pattern: Pattern::Spin(axle), slope_rad: 0.0 }));
        legs
    }

    /// What is known after a manoeuvre that takes so long.
    pub fn bound(&self, manoeuvre: &Manoeuvre<'_>, time_s: f64) -> Option<Bound> {
        let measured_s = (time_s / manoeuvre.count() as f64 - SETTLING_S).max(0.0);
        let mut seen = Information::none();
        for leg in manoeuvre.legs() {
            seen = seen + leg.per_second * measured_s;
        }
        // Left and right are alike, with sensors of their own.
        Bound::new(&self.measurement.beforehand, &[(seen, 2.0)])
    }

    /// Whether a bound meets what is asked of some targets.
    pub fn is_met(&self, bound: &Bound, targets: &[Parameter]) -> bool {
        targets.iter().all(|target| bound.relative(*target, &self.soil) <= self.accuracy)
    }

    /// A manoeuvre of a given length.
    pub fn finding(&self, manoeuvre: &Manoeuvre<'_>, usual: &DrivenLeg, time_s: f64) -> Option<Finding> {
        let bound = self.bound(manoeuvre, time_s)?;
        let expense = manoeuvre.expense(usual, time_s);
        let legs = manoeuvre.legs().cloned().collect();
        Some(Finding { legs, bound, expense, cost: self.weights.cost(&expense) })
    }

    /// A manoeuvre just long enough, in whole seconds, for some targets; none where the longest is not enough.
    fn shortest(&self, manoeuvre: &Manoeuvre<'_>, usual: &DrivenLeg, targets: &[Parameter]) -> Option<Finding> {
        let known_after = |time_s: f64| self.bound(manoeuvre, time_s).is_some_and(|bound| self.is_met(&bound, targets));
        let (least_s, longest_s) = self.times_s(manoeuvre)?;
        let legs = manoeuvre.count() as f64;
        let time_s = shortest(least_s, longest_s, HALVINGS, known_after)?;
        self.finding(manoeuvre, usual, legs * (time_s / legs).ceil())
    }

    /// The least and the longest time that a manoeuvre may take, s, in whole seconds for every leg; none where that is too short for it.
    fn times_s(&self, manoeuvre: &Manoeuvre<'_>) -> Option<(f64, f64)> {
        let legs = manoeuvre.count() as f64;
        let (least_s, longest_s) = (legs * SHORTEST_MANOEUVRE_S.ceil(), legs * (self.longest_s / legs).floor());
        (least_s <= longest_s).then_some((least_s, longest_s))
    }

    /// The cheapest manoeuvre of each kind for some targets, cheapest first.
    pub fn cheapest(&self, manoeuvres: &[Manoeuvre<'_>], usual: &DrivenLeg, targets: &[Parameter]) -> Vec<Finding> {
        let findings: Vec<Finding> =
            manoeuvres.par_iter().filter_map(|manoeuvre| self.shortest(manoeuvre, usual, targets)).collect();
        let mut best: Vec<Finding> = Vec::new();
        for finding in findings {
            match best.iter_mut().find(|known| known.kind() == finding.kind()) {
                Some(known) if finding.cost < known.cost => *known = finding,
                Some(_) => {}
                None => best.push(finding),
            }
        }
        let mut refined: Vec<Finding> =
            best.into_par_iter().map(|finding| self.refined(finding, usual, targets)).collect();
        refined.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        refined
    }

    /// The manoeuvre of some length that knows the targets asked for best: the product of their errors is least.
    pub fn best_known(&self, manoeuvres: &[Manoeuvre<'_>], usual: &DrivenLeg, time_s: f64) -> Option<Finding> {
        let targets = &self.targets;
        let logarithm = |finding: &Finding| -> f64 {
            targets.iter().map(|target| finding.bound.relative(*target, &self.soil).ln()).sum()
        };
        manoeuvres
            .par_iter()
            .filter_map(|manoeuvre| self.finding(manoeuvre, usual, time_s))
            .min_by(|a, b| logarithm(a).total_cmp(&logarithm(b)))
    }

    /// The largest set of the targets asked for that a manoeuvre of the longest time makes known; of sets as large, that of targets named first.
    pub fn within_reach(&self, manoeuvres: &[Manoeuvre<'_>]) -> Vec<Parameter> {
        let places_known = |manoeuvre: &Manoeuvre<'_>| -> Vec<usize> {
            let bound = self.times_s(manoeuvre).and_then(|(_, longest_s)| self.bound(manoeuvre, longest_s));
            let met = |place: &usize| bound.is_some_and(|bound| self.is_met(&bound, &[self.targets[*place]]));
            (0..self.targets.len()).filter(met).collect()
        };
        let sets = manoeuvres.par_iter().map(places_known);
        let largest =
            sets.max_by(|one, other| one.len().cmp(&other.len()).then_with(|| other.cmp(one))).unwrap_or_default();
        largest.into_iter().map(|place| self.targets[place]).collect()
    }

    /// A finding made cheaper by small changes of its rim speeds.
    fn refined(&self, mut best: Finding, usual: &DrivenLeg, targets: &[Parameter]) -> Finding {
        for step in REFINEMENTS {
            for _ in 0..REFINING_STEPS {
                let cheaper = best.neighbours(step).into_iter().filter_map(|legs| {
                    let legs: Vec<DrivenLeg> = legs.into_iter().map(|leg| self.driven(leg)).collect::<Option<_>>()?;
                    self.shortest(&Manoeuvre::of(&legs)?, usual, targets)
                });
                match cheaper.min_by(|a, b| a.cost.total_cmp(&b.cost)).filter(|next| next.cost < best.cost) {
                    Some(next) => best = next,
                    None => break,
                }
            }
        }
        best
    }
}

fn triples() -> impl Iterator<Item = (f64, f64, f64)> {
    let of = |place: usize| RATIOS[place % RATIOS.len()];
    let count = RATIOS.len();
    (0..count * count * count).map(move |index| (of(index / (count * count)), of(index / count), of(index)))
}

/// Every leg alone, and every two.
pub fn manoeuvres(legs: &[DrivenLeg]) -> Vec<Manoeuvre<'_>> {
    let mut all = Vec::new();
    for (place, first) in legs.iter().enumerate() {
        all.push(Manoeuvre { first, second: None });
        all.extend(legs[place + 1..].iter().map(|second| Manoeuvre { first, second: Some(second) }));
    }
    all
}

impl<'a> Manoeuvre<'a> {
    /// Of one leg or two; none of another number.
    pub fn of(legs: &'a [DrivenLeg]) -> Option<Self> {
        match legs {
            [first] => Some(Self { first, second: None }),
            [first, second] => Some(Self { first, second: Some(second) }),
            _ => None,
        }
    }

    fn legs(&self) -> impl Iterator<Item = &'a DrivenLeg> {
        std::iter::once(self.first).chain(self.second)
    }

    /// How many legs it has.
    pub fn count(&self) -> usize {
        1 + usize::from(self.second.is_some())
    }

    fn expense(&self, usual: &DrivenLeg, time_s: f64) -> Expense {
        let share_s = time_s / self.count() as f64;
        let energy_j: f64 = self.legs().map(|leg| (leg.power_w - usual.power_w) * share_s).sum();
        let deepest_m = self.legs().map(|leg| leg.deepest_m).fold(0.0, f64::max);
        Expense { time_s, energy_j: energy_j.max(0.0), sinkage_m: (deepest_m - usual.deepest_m).max(0.0) }
    }
}

/// Manoeuvres that ask the same of a driver and of the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind {
    legs: usize,
    level: bool,
    spins: bool,
}

impl Finding {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        Kind {
            legs: self.legs.len(),
            level: self.legs.iter().all(|driven| driven.leg.is_level()),
            spins: self.legs.iter().any(|driven| driven.leg.spins()),
        }
    }

    /// The legs with one ratio changed by a step.
    fn neighbours(&self, step: f64) -> Vec<Vec<Leg>> {
        let legs: Vec<Leg> = self.legs.iter().map(|driven| driven.leg).collect();
        let mut all = Vec::new();
        for place in 0..legs.len() {
            let Pattern::Roll(ratios) = legs[place].pattern else { continue };
            for axle in Axle::ALL.into_array() {
                for change in [step, -step] {
                    let mut ratios = ratios;
                    let ratio = ((*ratios.of(axle) + change) / REFINEMENTS[1]).round() * REFINEMENTS[1];
                    // Multiples of a twentieth, as the nearest numbers: 1 has to be 1.
                    *ratios.of_mut(axle) = (ratio * 1e6).round() / 1e6;
                    let pattern = Pattern::Roll(ratios);
                    let inside = (RATIO_RANGE.0..=RATIO_RANGE.1).contains(ratios.of(axle));
                    if inside && pattern.is_canonical() {
                        let mut changed = legs.clone();
                        changed[place].pattern = pattern;
                        all.push(changed);
                    }
                }
            }
        }
        all
    }
}
