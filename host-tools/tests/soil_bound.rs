//! The bound on what the sensors of a drive can tell of the soil.

use kapvik_firmware::rover::Rover;
use kapvik_host::bench::estimators_soil::SoilErrors;
use kapvik_host::identifiability::bound::Bound;
use kapvik_host::parameter::Parameter;
use kapvik_host::simulate::{Options, Scenario};
use kapvik_host::trial::{Drive, trial};

fn bound(scenario: Scenario, seconds: f64) -> Bound {
    let options = Options { duration_s: Some(seconds), ..Options::default() };
    Drive::run(scenario, 3, &Rover::assumed(), &options).unwrap().soil_bound.unwrap()
}

fn degrees(bound: &Bound) -> f64 {
    bound.std(Parameter::FrictionAngle).to_degrees()
}

/// A number from anywhere in a range is its width over √12 from the middle, in the mean square: φ in 22–42°, K in 5–35 mm.
#[test]
fn before_the_wheels_roll_it_is_what_the_networks_are_told_beforehand() {
    let standing = bound(Scenario::Level, 0.9);
    assert!((degrees(&standing) - 20.0 / 12.0_f64.sqrt()).abs() < 1e-6, "{}", degrees(&standing));
    let modulus = standing.std(Parameter::ShearModulus);
    assert!((modulus - 7.0_f64.ln() / 12.0_f64.sqrt()).abs() < 1e-12, "{modulus}");
}

/// Where little else limits, four times the frames halve it; what is only known beforehand keeps it above that.
#[test]
fn it_falls_with_the_frames_that_were_seen_and_with_the_spread_of_slips() {
    let [short, long] = [11.0, 31.0].map(|seconds| bound(Scenario::Spread, seconds));
    for target in Parameter::ALL {
        let ratio = long.std(target) / short.std(target);
        assert!((0.5..1.0).contains(&ratio), "{target:?}: {ratio}");
    }
    let alike = bound(Scenario::Level, 31.0);
    assert!(degrees(&alike) > 1.3 * degrees(&long), "{} {}", degrees(&alike), degrees(&long));
}

/// Development seeds.
#[test]
fn no_estimate_beats_it_on_average_and_none_says_that_it_does() {
    for scenario in [Scenario::Spread, Scenario::Level] {
        let trial = trial(scenario, 100..110, &Rover::assumed());
        assert_eq!(trial.drives.len(), 10, "{scenario:?}: {:?}", trial.failures);
        let errors = SoilErrors::after_30_s(&trial);
        for [error, stated, bound] in [errors.friction_angle_deg(), errors.ln_shear_modulus()] {
            assert!(error > bound && stated > bound && bound > 0.0, "{scenario:?}: {error} {stated} {bound}");
        }
    }
}
