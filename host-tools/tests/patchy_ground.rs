//! The soil that is told of drives whose sides stand on different soils: half-way between them, within what is said.

mod driven;

use driven::driven;
use kapvik_firmware::rover::{Rover, Side};
use kapvik_firmware::terramechanics::Soil;
use kapvik_host::prior::FRICTION_ANGLE_RAD;
use kapvik_host::simulate::{Options, Scenario, Traverse};
use rayon::prelude::*;

/// Seeds that development of the networks has not looked at.
const SEEDS: std::ops::Range<u64> = 8350..8390;
/// How long a drive takes, s.
const DURATION_S: f64 = 40.0;
/// Of forty friction angles within two standard deviations; where this is so in truth in 95 %, chance alone gives fewer in one of
/// a hundred sets.
const LEAST: f64 = 0.85;

/// Error and stated standard deviation of the friction angle at the end of a drive, rad; none where the drive ends before its time.
fn end_of_drive(seed: u64, apart_rad: f64) -> Option<(f64, f64)> {
    let rover = Rover::assumed();
    let options = Options { duration_s: Some(DURATION_S), ..Options::default() };
    let drawn = Traverse::new(Scenario::Spread, seed, &rover, &options).ok()?;
    let soil = drawn.world().soils.under(Side::Left, 0.0);
    let (low, high) = (FRICTION_ANGLE_RAD.low + apart_rad / 2.0, FRICTION_ANGLE_RAD.high - apart_rad / 2.0);
    let middle = soil.friction_angle_rad.clamp(low, high);
    let of_side = |way: f64| Some(Soil { friction_angle_rad: middle + way, ..soil });
    let options = Options { soil: of_side(-apart_rad / 2.0), right_soil: of_side(apart_rad / 2.0), ..options };
    let (said, _) = driven(&rover, Traverse::new(Scenario::Spread, seed, &rover, &options).ok()?.run().ok()?);
    let (last, truth) = said.last()?;
    let estimate = last.soil.as_ref().ok()?.estimate.friction_angle_rad;
    Some((f64::from(estimate.value) - truth.soil.friction_angle_rad, f64::from(estimate.std)))
}

#[test]
fn the_friction_angle_between_the_sides_is_within_what_is_said() {
    for apart_deg in [0.0, 2.0, 4.0] {
        let ends: Vec<(f64, f64)> =
            SEEDS.into_par_iter().filter_map(|seed| end_of_drive(seed, f64::to_radians(apart_deg))).collect();
        let count = ends.len() as f64;
        let within = ends.iter().filter(|(error, std)| error.abs() <= 2.0 * std).count() as f64 / count;
        let rms = |value: &dyn Fn(&(f64, f64)) -> f64| {
            (ends.iter().map(|end| value(end) * value(end)).sum::<f64>() / count).sqrt()
        };
        println!(
            "sides {apart_deg}° apart, {count} drives: {within:.3} within 2 standard deviations; errors {:.2}°, stated {:.2}°, \
             {:.2} standard deviations",
            rms(&|end| end.0.to_degrees()),
            rms(&|end| end.1.to_degrees()),
            rms(&|end| end.0 / end.1)
        );
        assert!(ends.len() >= 36, "of {SEEDS:?} only {count} drives reach their end");
        assert!(within >= LEAST, "sides {apart_deg}° apart: {within}");
    }
}
