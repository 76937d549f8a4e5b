//! The range in which an effect's parameter is looked for.

use kapvik_firmware::terramechanics::effects::{EffectInfo, ParameterInfo};

use super::fit::Reading;
use super::measurements::Measurements;

/// A gauge that was zeroed on a wheel which had sunk already is off by at most that, as a share of the radius.
const SUNK: f64 = 0.5;
/// So many standard deviations below zero no reading of a sinkage is by chance, and the share of the rows from which such readings are no
/// outliers.
const BELOW_ZERO: f64 = 2.0;
const NO_OUTLIERS: f64 = 0.1;

/// That of the effect's own law, and of it what the measurements leave plausible. A zero of the sinkage that was off by more than
/// the greatest sinkage ever read from it would be most of every reading: such a sensor measured nothing, and what a fit does
/// with an offset of that size is another law's work. But where sinkages are below zero, which no wheel's are, the gauge was zeroed on a wheel
/// that had sunk, by more than it sank from there perhaps.
pub fn plausible_range(info: &EffectInfo, parameter: &ParameterInfo, measurements: &Measurements) -> (f64, f64) {
    let (low, high) = (parameter.low, parameter.high);
    if (info.id, parameter.name) != ("sinkage-reference", "offset_m") {
        return (low, high);
    }
    let channel = Reading::Sinkage.index();
    let sinkages: Vec<f64> = measurements.rows.iter().filter_map(|row| row.readings[channel]).collect();
    let greatest_m = sinkages.iter().copied().map(f64::abs).fold(0.0, f64::max);
    if greatest_m == 0.0 {
        return (low, high);
    }
    let least_m = -BELOW_ZERO * measurements.noise[channel].std;
    let below = sinkages.iter().filter(|sinkage_m| **sinkage_m < least_m).count() as f64;
    let is_sunk = below > NO_OUTLIERS * sinkages.len() as f64;
    let deepest_m = if is_sunk { greatest_m.max(SUNK * measurements.radius_m()) } else { greatest_m };
    (low.max(-deepest_m), high.min(greatest_m))
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::terramechanics::effects::effect_info;

    use super::*;
    use crate::data::campaign::Carried;

    #[test]
    fn a_zero_is_off_by_no_more_than_was_ever_read_from_it() {
        let campaign = Carried::CmuSmoothStraight.campaign().expect("carried");
        let mut measurements = Measurements::of(&campaign, false).expect("measured");
        let range = |id: &str, name: &str, measurements: &Measurements| {
            let info = effect_info(id).expect("listed");
            let parameter = info.parameters.iter().find(|parameter| parameter.name == name).expect("a parameter");
            (plausible_range(info, parameter, measurements), (parameter.low, parameter.high))
        };
        let set = |measurements: &mut Measurements, sinkage_m: Option<f64>| {
            measurements.rows.iter_mut().for_each(|row| row.readings[Reading::Sinkage.index()] = sinkage_m);
        };
        set(&mut measurements, Some(0.004));
        measurements.rows[0].readings[Reading::Sinkage.index()] = Some(-0.012);
        assert_eq!(range("sinkage-reference", "offset_m", &measurements).0, (-0.012, 0.012));
        let half = measurements.rows.len() / 2;
        for (place, row) in measurements.rows.iter_mut().enumerate() {
            row.readings[Reading::Sinkage.index()] = Some(if place < half { -0.004 } else { 0.002 });
        }
        let sunk = range("sinkage-reference", "offset_m", &measurements).0;
        assert_eq!(sunk, (-0.5 * measurements.radius_m(), 0.004), "the gauge was zeroed on a wheel that had sunk");
        let (found, own) = range("slip-sinkage", "n1", &measurements);
        assert_eq!(found, own, "another effect's range is its own");
        set(&mut measurements, Some(0.5));
        let (found, own) = range("sinkage-reference", "offset_m", &measurements);
        assert_eq!(found, own, "never wider than the law's");
    }
}
