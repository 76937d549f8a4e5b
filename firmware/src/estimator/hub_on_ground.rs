//! The wheels of a side, seen along their contacts.

use super::compaction::Correction;
use super::drawbar_split::{BogieWheel, along_contact};
use super::side_estimator::SideEstimator;
use crate::rover::{PerAxle, Planar};
use crate::scalar::Scalar;

/// A wheel, seen along its contact.
pub(super) struct HubOnGround<S> {
    /// What its share of a bogie's pull is told from.
    pub wheel: BogieWheel<S>,
    /// Drawbar pull, N.
    pub drawbar_pull_n: S,
    /// Contact angle, rad.
    pub contact_angle_rad: S,
    /// Sine and cosine of the contact angle less the pitch of its link.
    pub angle: (S, S),
}

impl<S: Scalar> SideEstimator<S> {
    /// The wheels along their contacts, with such forces on the hubs and the paths of these corrected.
    #[inline(never)] // flash is scarcer than the time of a call
    pub(super) fn on_ground(
        &self,
        forces: &PerAxle<Planar<S>>,
        corrections: &PerAxle<Correction<S>>,
    ) -> PerAxle<HubOnGround<S>> {
        let paths = self.angles.angles().zip(self.angles.links());
        let filters = paths.zip(*corrections).zip(self.wheels.as_ref());
        forces.zip(filters).map(|(force, (((path, link), correction), filter))| {
            let steeper = path + correction.steeper - link;
            let angle = steeper.sin_cos();
            let (load_n, drawbar_pull_n) = along_contact(force, angle);
            let [rate, torque, slip] = *filter.estimate().mean();
            let direction = if rate < S::zero() { -S::one() } else { S::one() };
            let wheel = BogieWheel { load_n, rim_force_n: torque / self.rover.wheel.radius_m, slip, direction };
            HubOnGround { wheel, drawbar_pull_n, contact_angle_rad: link + steeper, angle }
        })
    }
}
