//! What is believed of a soil: what a campaign says, or the prior that the networks were trained with.

use kapvik_firmware::identification::{Belief, SoilPrior};

use crate::data::campaign::{Campaign, Knowledge};
use crate::data::soil_file::SoilRange;
use crate::prior::{self, Range};

/// A number that is less than so many of its standard deviations may be nothing at all…
pub const NEAR_NOTHING: f64 = 3.0;
/// …and no number is farther from where it is stated than so many.
pub const FARTHEST: f64 = 6.0;

/// The usual prior, but for what a campaign's `[soil]` says.
pub fn soil_prior(campaign: &Campaign) -> SoilPrior<f64> {
    let usual = SoilPrior::usual();
    let ground = &campaign.ground;
    let sinkage_exponent = number("n", ground.sinkage_exponent, usual.sinkage_exponent);
    SoilPrior {
        ln_cohesion: logarithm(ground.cohesion_pa, usual.ln_cohesion),
        friction_angle_rad: number("phi", ground.friction_angle_rad, usual.friction_angle_rad),
        ln_shear_modulus: logarithm(ground.shear_modulus_m, usual.ln_shear_modulus),
        ln_stiffness: match ground.stiffness(&campaign.wheel) {
            None => at_exponent(&usual, sinkage_exponent.mean),
            stiffness => logarithm(stiffness, usual.ln_stiffness),
        },
        // Who states a stiffness states it beside the exponent, not at a depth.
        known_depth_m: if ground.stiffness(&campaign.wheel).is_some() { 1.0 } else { usual.known_depth_m },
        sinkage_exponent,
        peak_stress_c1: number("c1", ground.peak_stress_c1, usual.peak_stress_c1),
        peak_stress_c2: number("c2", ground.peak_stress_c2, usual.peak_stress_c2),
        rebound_ratio: number("eta", ground.rebound_ratio, usual.rebound_ratio),
    }
}

/// What is believed of ln k where the mean exponent is another: the pressure at the depth at which it is known stays as it is believed, with
/// its bounds. Else 20 kPa at 15 mm would be 80 kPa there for who knows that n is 0.7.
fn at_exponent(usual: &SoilPrior<f64>, exponent: f64) -> Belief<f64> {
    let moved = -(exponent - usual.sinkage_exponent.mean) * usual.known_depth_m.ln();
    let Belief { mean, std, low, high } = usual.ln_stiffness;
    Belief { mean: mean + moved, std, low: low + moved, high: high + moved }
}

/// The prior that the networks were trained with: flat between bounds.
pub fn training_prior() -> SoilPrior<f64> {
    let flat = |range: Range| {
        let ends = [range.low, range.high].map(|end| if range.logarithmic { end.ln() } else { end });
        Belief::flat(ends[0], ends[1])
    };
    SoilPrior {
        ln_cohesion: flat(prior::COHESION_PA),
        friction_angle_rad: flat(prior::FRICTION_ANGLE_RAD),
        ln_shear_modulus: flat(prior::SHEAR_MODULUS_M),
        ln_stiffness: flat(prior::STIFFNESS),
        known_depth_m: 1.0,
        sinkage_exponent: flat(prior::SINKAGE_EXPONENT),
        peak_stress_c1: flat(prior::PEAK_STRESS_C1),
        peak_stress_c2: flat(prior::PEAK_STRESS_C2),
        rebound_ratio: Belief::known(0.0),
    }
}

/// Of the number that a key of `[soil]` gives.
fn number(key: &str, known: Option<Knowledge>, usual: Belief<f64>) -> Belief<f64> {
    let SoilRange { least, greatest } = SoilRange::of(key);
    within([least, greatest], known, usual)
}

/// A stated value may be off to either side by as much, wherever what is usual ends, but for what it can be.
fn within([least, greatest]: [f64; 2], known: Option<Knowledge>, usual: Belief<f64>) -> Belief<f64> {
    match known {
        None => usual,
        Some(Knowledge::Value { value, std: 0.0 }) => Belief::known(value),
        Some(Knowledge::Value { value, std }) => Belief {
            mean: value,
            std: Some(std),
            low: usual.low.min((value - FARTHEST * std).max(least)),
            high: usual.high.max((value + FARTHEST * std).min(greatest)),
        },
        Some(Knowledge::Between { min, max }) => Belief::flat(min, max),
    }
}

/// Of the logarithm of a number that is not below zero.
fn logarithm(known: Option<Knowledge>, usual: Belief<f64>) -> Belief<f64> {
    // Below the usual range a number is as good as zero.
    let least = usual.low.exp();
    let ln = |value: f64| value.max(least).ln();
    match known {
        // What may be nothing at all is far from normal in its logarithm, and what may be anything from nothing on is no less likely to be
        // much than little: such a logarithm is believed to be what it is on the mean, as surely as it scatters.
        Some(Knowledge::Value { value, std }) if value < NEAR_NOTHING * std => {
            let most = (value + FARTHEST * std).max(2.0 * least);
            let (mean, std) = moments_of_ln([least, most], |number| (-0.5 * ((number - value) / std).powi(2)).exp());
            Belief { mean, std: Some(std), low: usual.low, high: most.ln() }
        }
        Some(Knowledge::Between { min, max }) if min <= least && max > 2.0 * least => {
            let (mean, std) = moments_of_ln([least, max], |_| 1.0);
            Belief { mean, std: Some(std), low: usual.low, high: max.ln() }
        }
        Some(Knowledge::Value { value, std }) => {
            let known = Knowledge::Value { value: ln(value), std: std / value.max(least) };
            within([f64::NEG_INFINITY, f64::INFINITY], Some(known), usual)
        }
        Some(Knowledge::Between { min, max }) => Belief::flat(ln(min), ln(max).max(ln(min) + 1e-9)),
        None => usual,
    }
}

/// Mean and standard deviation of the logarithm of a number between two that are greater than zero, which has this density.
fn moments_of_ln([least, most]: [f64; 2], density: impl Fn(f64) -> f64) -> (f64, f64) {
    const STEPS: u32 = 2000;
    let [low, high] = [least.ln(), most.ln()];
    let step = (high - low) / f64::from(STEPS);
    let [mut sum, mut first, mut second] = [0.0; 3];
    for place in 0..STEPS {
        let ln = low + (f64::from(place) + 0.5) * step;
        let weight = density(ln.exp()) * ln.exp();
        sum += weight;
        first += weight * ln;
        second += weight * ln * ln;
    }
    let mean = first / sum;
    (mean, (second / sum - mean * mean).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn usual() -> Belief<f64> {
        SoilPrior::usual().ln_cohesion
    }

    /// Of a number that is uniform from nothing to M, the logarithm has the mean ln M − 1 and the standard deviation one; of the size of a
    /// normal one without mean, ln σ − (γ + ln 2)/2 and π/√8.
    #[test]
    fn what_may_be_nothing_is_believed_by_its_logarithm() {
        let uniform = logarithm(Some(Knowledge::Between { min: 0.0, max: 1000.0 }), usual());
        assert!((uniform.mean - (1000_f64.ln() - 1.0)).abs() < 0.01, "{uniform:?}");
        assert!((uniform.spread() - 1.0).abs() < 0.02 && uniform.is_valid(), "{uniform:?}");
        let half = logarithm(Some(Knowledge::Value { value: 0.0, std: 200.0 }), usual());
        assert!((half.mean - (200_f64.ln() - 0.635)).abs() < 0.01, "{half:?}");
        assert!((half.spread() - 1.11).abs() < 0.02 && half.is_valid(), "{half:?}");
        assert!((half.high - 1200_f64.ln()).abs() < 1e-12, "no more than six standard deviations: {half:?}");
    }

    #[test]
    fn a_stated_value_at_the_end_of_what_is_usual_has_two_sides() {
        let known = |value, std| Some(Knowledge::Value { value, std });
        let steep = number("n", known(2.5, 0.2), SoilPrior::usual().sinkage_exponent);
        assert!((steep.low - 0.1).abs() < 1e-12 && (steep.high - 3.7).abs() < 1e-12, "{steep:?}");
        let loose = number("n", known(0.05, 0.02), SoilPrior::usual().sinkage_exponent);
        assert_eq!((loose.low, loose.high), (0.0, 2.2), "an exponent is not below zero");
    }

    /// k z₀ⁿ at 15 mm.
    #[test]
    fn a_stated_exponent_leaves_the_pressure_at_its_depth() {
        let usual = SoilPrior::<f64>::usual();
        let ln_pressure = |ln_stiffness: f64, exponent: f64| ln_stiffness + exponent * usual.known_depth_m.ln();
        let expected = ln_pressure(usual.ln_stiffness.mean, usual.sinkage_exponent.mean);
        for exponent in [0.7, 1.05, 1.6] {
            let stiffness = at_exponent(&usual, exponent);
            assert!((ln_pressure(stiffness.mean, exponent) - expected).abs() < 1e-12, "{stiffness:?} at {exponent}");
            assert!(stiffness.is_valid() && stiffness.spread() == usual.ln_stiffness.spread(), "{stiffness:?}");
        }
    }

    #[test]
    fn what_is_far_from_nothing_is_believed_as_it_is_stated() {
        let stated = logarithm(Some(Knowledge::Value { value: 500.0, std: 50.0 }), usual());
        assert_eq!((stated.mean, stated.std), (500_f64.ln(), Some(0.1)));
        let between = logarithm(Some(Knowledge::Between { min: 50.0, max: 500.0 }), usual());
        assert_eq!((between.low, between.high, between.std), (50_f64.ln(), 500_f64.ln(), None));
        let nothing = logarithm(Some(Knowledge::Value { value: 0.0, std: 0.0 }), usual());
        assert!(nothing.is_known() && nothing.mean == usual().low);
    }
}
