//! What the torques of a side tell of its contact angles, by what of them compacts the soil.

use super::compaction::{Compaction, Correction, Known, Together};
use super::estimate::WheelActivity;
use super::hub_on_ground::HubOnGround;
use super::side_estimator::SideEstimator;
use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// One standard deviation of how far the share of the rim force that compacts the soil departs from its mean on one soil: of the front
/// wheel, and of a bogie's two, of which each has its own noise.
const FRONT_SHARE: f64 = 0.015;
const BOGIE_SHARE: f64 = 0.011;
/// The variance of a contact angle by the path of its hub, over what the filter states, for the weight of what the torques tell. It errs the
/// same way for many frames, the share is new in each: so it is above one.
const OF_STATED: f64 = 1.4;
/// A wheel that skids by more than this slip pushes soil instead of compacting it.
const GREATEST_SKID: f64 = -0.3;
/// How far an angle lags behind one that turns, rad for each rad/m.
const ANGLE_LAG: f64 = 0.0205;
/// One standard deviation of what a wheel's path departs from the terrain by on rough ground, rad: slips and loads that change make it
/// sink in ways that nothing tells.
const ANGLE_UNTOLD: f64 = 0.003;

impl<S: Scalar> SideEstimator<S> {
    /// Follows what compacts the soil under the front wheel and under the bogie's, while they roll and bear loads. Where they dig in, more
    /// and more of the soil is compacted: then the terrain tells the angles on which they stood,
    /// and as long as it is asked its memory corrects the same paths.
    #[inline(never)] // flash is scarcer than the time of a call
    pub(super) fn follow_compaction(&mut self, travel_m: S) {
        let hubs = self.on_ground(&self.forces.forces_n(), &PerAxle::all(Correction::none()));
        let settled = !self.swings && self.digging_in.is_over();
        let rolls = self
            .activity
            .zip(self.settled())
            .zip(self.lifted)
            .map(|((activity, steady), lifted)| activity == WheelActivity::Rolling && steady && !lifted && settled);
        let skids = hubs.as_ref().map(|hub| hub.wheel.slip < S::constant(GREATEST_SKID));
        let held = self.forces.bogie_is_held();
        let [of_front, of_bogie] = &mut self.compaction;
        let are_known = !(skids.front || held);
        follow(of_front, travel_m, (are_known, rolls.front), &[&hubs.front]);
        let are_known = !(skids.middle || skids.rear || held);
        follow(of_bogie, travel_m, (are_known, rolls.middle && rolls.rear), &[&hubs.middle, &hubs.rear]);
        self.corrections = self.corrections(&hubs);
        if let Some((told, steeper)) = self.digging_in.terrain().tells(&self.angles) {
            let corrections = self.corrections.as_mut().zip(steeper).into_array();
            corrections.into_iter().for_each(|(correction, steeper)| correction.remember(told, steeper));
        }
    }

    fn corrections(&self, hubs: &PerAxle<HubOnGround<S>>) -> PerAxle<Correction<S>> {
        let [of_front, of_bogie] = &self.compaction;
        let estimate = self.angles.estimate();
        let [_, front, middle, rear, ..] = estimate.variances();
        let both = estimate.covariance(2, 3).unwrap_or(S::zero());
        let trends = self.angles.trends();
        let [rough, ..] = trends.restless();
        let square = |value: f64| S::constant(value * value);
        let stated = S::constant(OF_STATED);
        let untold = rough * square(ANGLE_UNTOLD);
        let truly = |variance: S, trend: S| stated * variance + square(ANGLE_LAG) * trend * trend + untold;
        let [turns_front, turns_middle, turns_rear] = trends.per_m();
        let (front, of_middle, of_rear) =
            (truly(front, turns_front), truly(middle, turns_middle), truly(rear, turns_rear));
        let met = self.met.map(|met| met.map_or(S::zero(), |met| met.steeper_rad));
        let [met_by_middle, met_by_rear] = met.map(|steeper| steeper * steeper);
        let (middle, rear) = (of_middle + met_by_middle, of_rear + met_by_rear);
        let both = stated * both;
        let loads = hubs.as_ref().map(|hub| hub.wheel.load_n.max(S::one()));
        let load_n = loads.middle + loads.rear;
        let (by_middle, by_rear) = (loads.middle / load_n, loads.rear / load_n);
        let known_middle =
            Known { variance: middle, path_variance: of_middle, with_mean: by_middle * middle + by_rear * both };
        let known_rear = Known { variance: rear, path_variance: of_rear, with_mean: by_middle * both + by_rear * rear };
        let departs = |spread: f64| S::constant(spread * spread);
        let alone = Together {
            wheels: S::one(),
            load_n: loads.front,
            variance: front,
            paths_variance: front,
            departs: departs(FRONT_SHARE),
        };
        let variance = by_middle * known_middle.with_mean + by_rear * known_rear.with_mean;
        let bogie = Together {
            wheels: S::constant(2.0),
            load_n,
            variance,
            paths_variance: variance - by_middle * by_middle * met_by_middle - by_rear * by_rear * met_by_rear,
            departs: departs(BOGIE_SHARE),
        };
        PerAxle {
            front: Known { variance: front, path_variance: front, with_mean: front }.corrected(of_front, &alone),
            middle: known_middle.corrected(of_bogie, &bogie),
            rear: known_rear.corrected(of_bogie, &bogie),
        }
    }
}

/// Takes what compacts the soil under some wheels together, if what they pull is known and all of them roll.
#[inline(never)] // flash is scarcer than the time of a call
fn follow<S: Scalar>(
    compaction: &mut Compaction<S>,
    travel_m: S,
    (are_known, roll): (bool, bool),
    hubs: &[&HubOnGround<S>],
) {
    if !are_known {
        return compaction.pause();
    }
    if !roll {
        return compaction.forget();
    }
    let sum = |of: fn(&HubOnGround<S>) -> S| hubs.iter().fold(S::zero(), |sum, hub| sum + of(hub));
    let compacts = sum(|hub| hub.wheel.rim_force_n - hub.drawbar_pull_n);
    compaction.follow(travel_m, compacts / sum(|hub| hub.wheel.load_n));
}
