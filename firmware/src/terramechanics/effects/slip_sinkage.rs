//! Slip-sinkage: a wheel that slips digs itself in.

use crate::scalar::Scalar;
use crate::terramechanics::Soil;

use super::info::effect_parameters;
use super::saturation::saturated;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth, Words};

effect_parameters! {
    /// Sinkage exponent or stiffness follow the slip. With S = (1 − e^(−a |i|))/a, which is |i| for a = 0:
    ///
    /// - n = n₀ + n₁ S: Ding et al. 2010, J. Central South Univ. Technol. 17:129–135 (linear in slip);
    /// - p = k (z/(1 + m S))ⁿ: soil dug away stretches the sinkage, as in Lyasko's (1 + i)/(1 − i/2);
    /// - z read = (1 + q S) z: soil moved past the wheel, which carries no load; or Lyasko's factor on the sinkage that is read.
    ///
    /// The saturation a is ours: measured sinkage stops growing at high slip. The slip i is the one that the soil has felt,
    /// where that is known beside the present one.
    pub struct SlipSinkage {
        /// n₁.
        exponent_per_slip: "n1" ["-"] = 0.0, -0.5 to 2.0, about 0.3;
        /// a.
        saturation: "saturation" ["-"] = 0.0, -2.0 to 25.0, shape 4.0;
        /// m.
        stretch_per_slip: "stretch" ["-"] = 0.0, -0.5 to 12.0, about 0.8;
        /// q.
        apparent_per_slip: "apparent" ["-"] = 0.0, -0.5 to 6.0, about 0.5;
    }
}

impl<S: Scalar> Effect<S> for SlipSinkage<S> {
    const ID: &'static str = "slip-sinkage";
    const SUMMARY: &'static str = "the sinkage depends on the slip";
    const WORDS: &'static [Words] = &[
        Words {
            parameter: "n1",
            above: "the wheel sinks deeper the more it slips",
            below: "the wheel sinks less the more it slips",
        },
        Words {
            parameter: "stretch",
            above: "the wheel sinks deeper the more it slips",
            below: "the wheel sinks less the more it slips",
        },
        Words {
            parameter: "apparent",
            above: "the wheel sinks deeper the more it slips",
            below: "the wheel sinks less the more it slips",
        },
    ];
    const TEST: &'static str = "sinkage at the same load and several slips, standing wheel included";
    const FORMS: &'static [Form] = &[
        Form { name: "exponent", free: &["n1"], set: &[], needs: &[] },
        Form { name: "exponent, saturating", free: &["n1", "saturation"], set: &[], needs: &[] },
        Form { name: "stretch", free: &["stretch"], set: &[], needs: &[] },
        Form { name: "stretch, saturating", free: &["stretch", "saturation"], set: &[], needs: &[] },
        Form { name: "apparent", free: &["apparent"], set: &[], needs: &[Column::Sinkage] },
        Form { name: "apparent, saturating", free: &["apparent", "saturation"], set: &[], needs: &[Column::Sinkage] },
    ];

    fn soil(&self, soil: &mut Soil<S>, at: &Circumstances<'_, S>) {
        let slip = saturated(at.felt_slip().abs(), self.saturation);
        let stretch = (S::one() + self.stretch_per_slip * slip).max(S::constant(0.05));
        soil.scale_stiffness((-(soil.sinkage_exponent * stretch.ln())).exp());
        soil.sinkage_exponent = (soil.sinkage_exponent + self.exponent_per_slip * slip).max(S::zero());
    }

    fn read(&self, readings: &mut Readings<S>, _truth: &WheelTruth<S>, at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        let slip = saturated(at.felt_slip().abs(), self.saturation);
        readings.sinkage_m = readings.sinkage_m * (S::one() + self.apparent_per_slip * slip);
    }
}
