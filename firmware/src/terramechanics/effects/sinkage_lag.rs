//! Sinkage that follows with way travelled.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth};

effect_parameters! {
    /// The measured sinkage goes to the one of the equations over a relaxation length L of travel, and starts at a share of
    /// it: dz/dx = (z_∞ − z)/L.
    pub struct SinkageLag {
        /// L, m.
        length_m: "length_m" ["m"] = 0.0, 0.0 to 5.0, about 0.05;
        /// Share of the sinkage that is there at the start of a run (travel 0).
        start_share: "start" ["-"] = 1.0, -0.5 to 3.0, about 1.0;
    }
}

impl<S: Scalar> Effect<S> for SinkageLag<S> {
    const ID: &'static str = "sinkage-lag";
    const SUMMARY: &'static str = "the sinkage follows with a relaxation length";
    const TEST: &'static str = "a longer run at constant slip, and the sinkage over its way";
    const FORMS: &'static [Form] = &[
        Form {
            name: "from the first sinkage",
            free: &["length_m"],
            set: &[],
            needs: &[Column::Travel, Column::Sinkage],
        },
        Form {
            name: "from the surface",
            free: &["length_m"],
            set: &[("start", 0.0)],
            needs: &[Column::Travel, Column::Sinkage],
        },
        Form {
            name: "from a share of the sinkage",
            free: &["length_m", "start"],
            set: &[],
            needs: &[Column::Travel, Column::Sinkage],
        },
    ];

    fn read(
        &self,
        readings: &mut Readings<S>,
        _truth: &WheelTruth<S>,
        at: &Circumstances<'_, S>,
        memory: &mut Memory<S>,
    ) {
        let Some(travel) = at.conditions.travel_m else {
            return;
        };
        let settled = readings.sinkage_m;
        let (from_m, from_travel_m) = memory.lagging.unwrap_or((self.start_share * settled, S::zero()));
        let way = (travel - from_travel_m).max(S::zero());
        let left = if self.length_m > S::zero() { (-(way / self.length_m)).exp() } else { S::zero() };
        readings.sinkage_m = settled + (from_m - settled) * left;
        memory.lagging = Some((readings.sinkage_m, travel));
    }
}
