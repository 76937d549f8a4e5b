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
/// Standard deviations of a difference that is not chance: with 4 one of some 450 drives over hills claimed another soil; with 4.5 one of 80
/// changes was noticed beyond a rover length.
const SIGNIFICANT: f32 = 4.2;
/// Travel for which a difference must last, m.
const LASTING_M: f32 = 0.04;
/// Least load, N, on which a resistance says something.
const LEAST_LOAD_N: f32 = 5.0;

/// Motion resistance over load, (T/r − DP)/W, at zero slip; none for a wheel that does not roll under load.
pub fn motion_resistance(wheel: &WheelEstimate, radius_m: f32) -> Option<Estimate> {
    let load = wheel.normal_load_n.value;
    let slip = wheel.slip?;
    if wheel.activity != WheelActivity::Rolling || load < LEAST_LOAD_N {
        return None;
    }
    let torque_std = wheel.resistive_torque_nm.std / radius_m;
    let spread = torque_std * torque_std + wheel.drawbar_pull_n.std * wheel.drawbar_pull_n.std;
    let resistance = wheel.resistive_torque_nm.value / radius_m - wheel.drawbar_pull_n.value;
    let value = resistance / load - SLOPE_IN_SLIP * slip.value;
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
        let matters = math::abs(difference) > if noise > LEAST_CHANGE { noise } else { LEAST_CHANGE };
        if self.reference.travel_m() < LEARNED_M || !matters {
            self.reference.take(resistance.value, travel_m);
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
