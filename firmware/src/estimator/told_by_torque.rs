//! What the torques of a side tell of its contact angles, by what of them compacts the soil.

use super::compaction::{Compaction, Correction, Known};
use super::doubt::WheelDoubt;
use super::estimate::WheelActivity;
use super::side_estimator::{HubOnGround, SideEstimator};
use crate::rover::PerAxle;
use crate::scalar::Scalar;

impl<S: Scalar> SideEstimator<S> {
    /// Follows what compacts the soil under the front wheel and under the bogie's, while they roll and bear loads.
    pub(super) fn follow_compaction(&mut self, travel_m: S) {
        let hubs = self.on_ground(&self.forces.forces_n(), &PerAxle::all(Correction::none()));
        let rolls = self.activity.zip(self.unsettled).zip(self.lifted()).map(|((activity, unsettled), lifted)| {
            activity == WheelActivity::Rolling && unsettled == 0 && !lifted && !self.swings
        });
        let [of_front, of_bogie] = &mut self.compaction;
        follow(of_front, travel_m, rolls.front, &[&hubs.front]);
        follow(of_bogie, travel_m, rolls.middle && rolls.rear, &[&hubs.middle, &hubs.rear]);
        self.corrections = self.corrections(&hubs);
    }

    fn corrections(&self, hubs: &PerAxle<HubOnGround<S>>) -> PerAxle<Correction<S>> {
        let [of_front, of_bogie] = &self.compaction;
        let estimate = self.angles.estimate();
        let [_, front, middle, rear, ..] = estimate.variances();
        let both = estimate.covariance(2, 3).unwrap_or(S::zero());
        let truly = |variance: S, doubt: &WheelDoubt<S>| doubt.angle * variance + doubt.angle_variance;
        let doubt = &self.doubt.wheels;
        let (front, middle, rear) =
            (truly(front, &doubt.front), truly(middle, &doubt.middle), truly(rear, &doubt.rear));
        let both = doubt.middle.angle * both;
        let loads = hubs.as_ref().map(|hub| hub.wheel.load_n.max(S::one()));
        let load_n = loads.middle + loads.rear;
        let (by_middle, by_rear) = (loads.middle / load_n, loads.rear / load_n);
        let known_middle = Known { variance: middle, with_mean: by_middle * middle + by_rear * both };
        let known_rear = Known { variance: rear, with_mean: by_middle * both + by_rear * rear };
        let of_mean = by_middle * known_middle.with_mean + by_rear * known_rear.with_mean;
        let of_bogie = |known: &Known<S>| known.corrected(of_bogie, of_mean, S::constant(2.0), load_n);
        PerAxle {
            front: Known { variance: front, with_mean: front }.corrected(of_front, front, S::one(), loads.front),
            middle: of_bogie(&known_middle),
            rear: of_bogie(&known_rear),
        }
    }
}

/// Takes what compacts the soil under some wheels together, if all of them roll.
fn follow<S: Scalar>(compaction: &mut Compaction<S>, travel_m: S, rolls: bool, hubs: &[&HubOnGround<S>]) {
    if !rolls {
        return compaction.forget();
    }
    let sum = |of: fn(&HubOnGround<S>) -> S| hubs.iter().fold(S::zero(), |sum, hub| sum + of(hub));
    let compacts = sum(|hub| hub.wheel.rim_force_n - hub.drawbar_pull_n);
    compaction.follow(travel_m, compacts / sum(|hub| hub.wheel.load_n));
}
