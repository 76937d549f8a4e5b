//! The stiffness of the soil under one wheel, as the rover feels it without seeing its sinkage.
//!
//! What a wheel's torque could pull with and does not pull with, T/r − DP, is what it spends on compacting soil. Sinkage
//! decides that, and stiffness decides sinkage: ice-cemented soil (three times as stiff) takes a third of it away at once,
//! loose soil over a void adds as much, while cohesion and friction hardly move it.

use serde::{Deserialize, Serialize};

use super::travel_mean::TravelMean;
use crate::estimator::{Estimate, WheelActivity, WheelEstimate};
use crate::math;

/// How the stiffness of the soil changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Stiffness {
    /// Ice-cemented, dense.
    Rises,
    /// Loose, sublimated.
    Falls,
}

/// By how much the resistance grows with slip, on the soils of the catalogue between slips of 0.05 and 0.6.
const SLOPE_IN_SLIP: f32 = 0.07;
/// Travel that the recent mean spans, m: less than a contact length.
const RECENT_M: f32 = 0.06;
/// Travel that the reference spans, m: a rover length.
const REFERENCE_M: f32 = 1.0;
/// Travel before a reference is trusted, m.
const LEARNED_M: f32 = 0.15;
/// A difference that matters, whatever the noise: a third of what ice does.
const LEAST_CHANGE: f32 = 0.025;
/// Standard deviations of a difference that is not chance. How often drives on one soil claim another all the same: `bench estimators --drives
/// 180`.
const SIGNIFICANT: f32 = 4.0;
/// Where chance alone may make so much of a difference, it tells neither that the soil is another nor that it is the same: the reference learns
/// this share of it. Where a soil begins pulls are not known well for some decimetres, and a reference that took all for its soil would
/// miss the other. So it is where a rover starts. On hills, where they are known, shares drift by as much from metre to metre, and are learned.
const DOUBTFUL: f32 = 0.06;
const IN_DOUBT: f32 = 0.2;
/// Travel for which a difference must last, m.
const LASTING_M: f32 = 0.04;
/// Least load on which a resistance says something, over its standard deviation.
const LEAST_LOAD: f32 = 10.0;

/// Motion resistance over load, (T/r − DP)/W, at zero slip; none for a wheel that does not roll under load.
pub fn motion_resistance(wheel: &WheelEstimate, radius_m: f32) -> Option<Estimate> {
    let Estimate { value: load, std: load_std } = wheel.normal_load_n;
    let slip = wheel.slip?;
    if wheel.activity != WheelActivity::Rolling || load <= LEAST_LOAD * load_std {
        return None;
    }
    let torque_std = wheel.resistive_torque_nm.std / radius_m;
    let spread = torque_std * torque_std + wheel.drawbar_pull_n.std * wheel.drawbar_pull_n.std;
    let value = wheel.resistance_n(radius_m) / load - SLOPE_IN_SLIP * slip.value;
    Some(Estimate { value, std: math::sqrt(spread) / load })
}

/// Watches the resistance of one wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct ResistanceWatch {
    recent: TravelMean,
    reference: TravelMean,
    beyond_m: f32,
}

impl ResistanceWatch {
    /// A watch that knows nothing yet.
    pub const fn new() -> Self {
        Self { recent: TravelMean::new(RECENT_M), reference: TravelMean::new(REFERENCE_M), beyond_m: 0.0 }
    }

    /// Takes a resistance that held over some travel, m. How the soil changed, when it is sure.
    pub fn see(&mut self, resistance: Estimate, travel_m: f32) -> Option<Stiffness> {
        self.recent.take(resistance.value, travel_m);
        let difference = self.recent.mean() - self.reference.mean();
        let noise = SIGNIFICANT * resistance.std;
        let learned = self.reference.travel_m() >= LEARNED_M;
        let differs = learned && math::abs(difference) > LEAST_CHANGE;
        if !differs || math::abs(difference) <= noise {
            let share = if (differs || !learned) && noise > DOUBTFUL { IN_DOUBT } else { 1.0 };
            self.reference.take(resistance.value, share * travel_m);
            self.beyond_m = 0.0;
            return None;
        }
        self.beyond_m += travel_m;
        if self.beyond_m < LASTING_M {
            return None;
        }
        self.beyond_m = 0.0;
        self.reference = self.reference.restarted_as(&self.recent);
        Some(if difference < 0.0 { Stiffness::Rises } else { Stiffness::Falls })
    }
}

#[cfg(test)]
mod tests {
    use super::{Estimate, ResistanceWatch, Stiffness};

    /// What a watch says while a resistance of such a standard deviation holds over a travel of so many centimetres.
    fn see(watch: &mut ResistanceWatch, value: f32, std: f32, travel_cm: u16) -> Option<Stiffness> {
        (0..travel_cm).fold(None, |said, _| said.or(watch.see(Estimate { value, std }, 0.01)))
    }

    /// Where a soil begins pulls are not known well; half a metre on they are, and then the change is plain, though for all that way it may
    /// have been chance.
    #[test]
    fn a_change_is_noticed_after_half_a_metre_in_doubt() {
        let mut watch = ResistanceWatch::new();
        assert_eq!(see(&mut watch, 0.35, 0.005, 80), None);
        assert_eq!(see(&mut watch, 0.43, 0.03, 50), None);
        assert_eq!(see(&mut watch, 0.43, 0.012, 8), Some(Stiffness::Falls));
    }

    /// Where a rover starts its pulls are not known, either: what they seem to be then is no soil to tell another from.
    #[test]
    fn what_a_start_makes_of_a_resistance_is_hardly_learned() {
        let mut watch = ResistanceWatch::new();
        assert_eq!(see(&mut watch, 0.45, 0.05, 20), None);
        assert_eq!(see(&mut watch, 0.36, 0.005, 100), None);
        assert_eq!(see(&mut watch, 0.43, 0.005, 8), Some(Stiffness::Falls));
    }

    /// Soil that becomes other by little and little is the soil that there is.
    #[test]
    fn what_drifts_slowly_is_learned() {
        let mut watch = ResistanceWatch::new();
        let drifts = (0..40_u8).find_map(|step| see(&mut watch, 0.3 + 0.002 * f32::from(step), 0.005, 10));
        assert_eq!(drifts, None);
    }
}
