//! The range in which an effect's parameter is looked for.

use kapvik_firmware::terramechanics::effects::{EffectInfo, ParameterInfo};

use super::fit::Reading;
use super::measurements::Measurements;

/// That of the effect's own law, and of it what the measurements leave plausible. A zero of the sinkage that was off by more than
/// the greatest sinkage ever read from it would be most of every reading: such a sensor measured nothing, and what a fit does
/// with an offset of that size is another law's work.
pub fn plausible_range(info: &EffectInfo, parameter: &ParameterInfo, measurements: &Measurements) -> (f64, f64) {
    let (low, high) = (parameter.low, parameter.high);
    if (info.id, parameter.name) != ("sinkage-reference", "offset_m") {
        return (low, high);
    }
    let sinkages = measurements.rows.iter().filter_map(|row| row.readings[Reading::Sinkage.index()]);
    let greatest_m = sinkages.map(f64::abs).fold(0.0, f64::max);
    if greatest_m > 0.0 { (low.max(-greatest_m), high.min(greatest_m)) } else { (low, high) }
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
        let (found, own) = range("slip-sinkage", "n1", &measurements);
        assert_eq!(found, own, "another effect's range is its own");
        set(&mut measurements, Some(0.5));
        let (found, own) = range("sinkage-reference", "offset_m", &measurements);
        assert_eq!(found, own, "never wider than the law's");
    }
}
