//! A network's estimate in what it estimates: ln c, φ and ln K; and back, with wider intervals.

use kapvik_firmware::network::TARGETS;
use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};

use crate::train::dataset::prior_scale;

use super::target::{Target, is_told};

/// The targets of an estimate.
pub fn targets(estimate: &SoilEstimate) -> [Target; TARGETS] {
    [
        of_logarithm(&estimate.cohesion_pa),
        of_number(&estimate.friction_angle_rad),
        of_logarithm(&estimate.shear_modulus_m),
    ]
}

/// The estimate with errors added to its 68 % and 95 % intervals; what then is not known better than to half of the prior's variance
/// is not called identifiable.
pub fn widened(estimate: &SoilEstimate, errors: &[[f64; 2]; TARGETS]) -> SoilEstimate {
    let prior = prior_scale();
    let stated = targets(estimate);
    let wide = |target: usize, parameter: &ParameterEstimate| {
        if errors[target] == [0.0; 2] {
            return *parameter;
        }
        let ends = [prior.low[target], prior.high[target]].map(f64::from);
        let prior_std = f64::from(prior.std[target]);
        let found = stated[target].widened(errors[target], ends, prior_std);
        let identifiable = parameter.identifiable && is_told(found.std, prior_std);
        if target == 1 {
            to_number(parameter, &found, identifiable)
        } else {
            to_logarithm(parameter, &found, identifiable)
        }
    };
    SoilEstimate {
        cohesion_pa: wide(0, &estimate.cohesion_pa),
        friction_angle_rad: wide(1, &estimate.friction_angle_rad),
        shear_modulus_m: wide(2, &estimate.shear_modulus_m),
        ..*estimate
    }
}

fn of_number(parameter: &ParameterEstimate) -> Target {
    Target {
        value: parameter.value.into(),
        std: parameter.std.into(),
        intervals: [parameter.interval_68, parameter.interval_95].map(|interval| interval.map(f64::from)),
    }
}

/// The standard deviation of a log-normal over e to the mean of the logarithm is √(g (g − 1)), g being e to the variance.
fn of_logarithm(parameter: &ParameterEstimate) -> Target {
    let Target { value, std, intervals } = of_number(parameter);
    let share = std / value;
    let growth = 0.5 * (1.0 + (1.0 + 4.0 * share * share).sqrt());
    Target { value: value.ln(), std: growth.ln().sqrt(), intervals: intervals.map(|interval| interval.map(f64::ln)) }
}

/// The standard deviation of a log-normal, of the mean and the standard deviation of its logarithm.
pub fn log_normal_std(ln_mean: f64, ln_std: f64) -> f64 {
    let growth = (ln_std * ln_std).exp();
    ln_mean.exp() * (growth * (growth - 1.0)).sqrt()
}

fn to_number(parameter: &ParameterEstimate, target: &Target, identifiable: bool) -> ParameterEstimate {
    let [interval_68, interval_95] = target.intervals.map(|interval| interval.map(|end| end as f32));
    ParameterEstimate { value: parameter.value, std: target.std as f32, interval_68, interval_95, identifiable }
}

fn to_logarithm(parameter: &ParameterEstimate, target: &Target, identifiable: bool) -> ParameterEstimate {
    let std = log_normal_std(target.value, target.std);
    let intervals = target.intervals.map(|interval| interval.map(f64::exp));
    to_number(parameter, &Target { std, intervals, ..*target }, identifiable)
}
