//! The frozen networks on cases that they have not seen.

use kapvik_host::bench::network::{score_rover, score_rover_on_patches};
use kapvik_host::train::scene::Design;

/// Cases of each kind: the standard error of a coverage is then below 0.5 %.
const CASES: usize = 10_000;
/// Of cases that no training has used.
const SEED: u32 = 77_001;

#[test]
fn one_instant_is_as_good_as_promised() {
    let [_, phi, k] = score_rover(Design::Kapvik { instants: 1, sinkage: true }, CASES, SEED);
    assert!(phi.rmse.to_degrees() <= 2.86, "φ RMSE {}°", phi.rmse.to_degrees());
    assert!(k.median_ratio_error <= 0.095, "median error of K {}", k.median_ratio_error);
}

#[test]
fn a_mean_of_a_hundred_is_as_good_as_promised() {
    let [_, phi, k] = score_rover(Design::Kapvik { instants: 100, sinkage: true }, CASES, SEED);
    assert!(phi.rmse.to_degrees() <= 1.21, "φ RMSE {}°", phi.rmse.to_degrees());
    assert!(k.median_ratio_error <= 0.016, "median error of K {}", k.median_ratio_error);
}

#[test]
fn intervals_cover_what_they_say() {
    for (name, target) in ["c", "φ", "K"].iter().zip(score_rover(Design::Training, CASES, SEED)) {
        let [narrow, wide] = target.interval_coverage;
        assert!((0.66..=0.70).contains(&narrow), "{name}: the 68 % interval covers {narrow}");
        assert!((0.94..=0.96).contains(&wide), "{name}: the 95 % interval covers {wide}");
    }
}

#[test]
fn on_patches_the_mean_is_within_what_is_said() {
    for instants in [1, 100] {
        let design = Design::Kapvik { instants, sinkage: true };
        let score = score_rover_on_patches(design, CASES, SEED).expect("such ground carries the wheels");
        for (name, target) in ["c", "φ", "K"].iter().zip(score) {
            // Of one instant next to nothing is known of c: of a flat posterior 58 % are within one standard deviation.
            let (narrow, wide) = (target.interval_coverage[0], target.std_coverage[1]);
            println!(
                "{name}, {instants} instants: {narrow} in the 68 % interval, {wide} within 1.96 standard deviations"
            );
            // Of the networks that know no patches, 42-55 % of the truths are within 1.96 of their standard deviations.
            assert!(narrow >= 0.60, "{name}, {instants} instants: {narrow} in the 68 % interval");
            assert!(wide >= 0.90, "{name}, {instants} instants: {wide} within 1.96 standard deviations");
        }
    }
}
