//! The soil that is stated under each single wheel of a rover that drives: it tells little, and must say so.

mod driven;
mod recorded;

use driven::driven;
use kapvik_firmware::rover::Rover;
use kapvik_firmware::soil::ParameterEstimate;
use kapvik_host::simulate::{Options, Scenario};
use rayon::prelude::*;
use recorded::recorded;

/// Seeds that development has not looked at.
const SEEDS: std::ops::Range<u64> = 8400..8430;
/// When a drive is looked at, s: seconds apart, as its soil is one and its filters have settled.
const LOOKS_S: [u64; 4] = [15, 20, 25, 30];
/// Of the friction angles, and of those that are marked as identifiable, so many must be within two standard deviations. What is stated of
/// the wheels of one drive errs alike: thirty drives tell a share to some four points.
const LEAST: f64 = 0.88;
/// Where wheels are looked at, and how many friction angles are marked as identifiable there at least: on slopes one wheel tells its soil, on
/// the level hardly ever.
const MARKED: [(Scenario, u32); 4] =
    [(Scenario::Level, 0), (Scenario::Spread, 10), (Scenario::Slope, 300), (Scenario::Hills, 20)];

/// How often something was so.
#[derive(Debug, Default, Clone, Copy)]
struct Share {
    so: u32,
    of: u32,
}

impl Share {
    fn count(&mut self, so: bool) {
        self.so += u32::from(so);
        self.of += 1;
    }

    fn value(self) -> f64 {
        f64::from(self.so) / f64::from(self.of)
    }
}

/// Shares of the friction angles under wheels within two standard deviations: all, and those marked as identifiable; and what share is.
fn within(scenario: Scenario) -> [Share; 3] {
    let [mut all, mut identifiable, mut marked] = [Share::default(); 3];
    let looks = |seed| {
        let rover = Rover::assumed();
        let options = Options { duration_s: Some(31.0), ..Options::default() };
        let (mut said, _) = driven(&rover, recorded(scenario, seed, &rover, &options).iter().copied());
        said.retain(|(estimate, _)| LOOKS_S.iter().any(|look_s| estimate.time_us == 1_000_000 * look_s));
        said
    };
    let looks: Vec<_> = SEEDS.into_par_iter().flat_map_iter(looks).collect();
    for (estimate, truth) in looks {
        for (soil, truth) in estimate.wheel_soils.iter_wheels().zip(truth.wheels.iter_wheels()) {
            let Some(soil) = soil.as_ref().ok().filter(|soil| !soil.outside_training_range) else { continue };
            let ParameterEstimate { value, std, identifiable: is_marked, .. } = soil.friction_angle_rad;
            let is_within = (f64::from(value) - truth.soil.friction_angle_rad).abs() <= 2.0 * f64::from(std);
            all.count(is_within);
            marked.count(is_marked);
            if is_marked {
                identifiable.count(is_within);
            }
        }
    }
    [all, identifiable, marked]
}

#[test]
fn one_wheel_states_what_it_can_tell_of_the_friction_angle() {
    for (scenario, told) in MARKED {
        let [all, identifiable, marked] = within(scenario);
        println!("{scenario:?}: {:.3} of {} friction angles within two standard deviations", all.value(), all.of);
        println!(
            "{scenario:?}: {:.3} marked as identifiable, of these {} of {}",
            marked.value(),
            identifiable.so,
            identifiable.of
        );
        assert!(all.of > 500, "{scenario:?}: {all:?}");
        assert!(all.value() >= LEAST, "{scenario:?}: {all:?}");
        assert!(identifiable.of >= told, "{scenario:?}: {identifiable:?}");
        assert!(identifiable.of < 20 || identifiable.value() >= LEAST, "{scenario:?}: {identifiable:?}");
    }
}
