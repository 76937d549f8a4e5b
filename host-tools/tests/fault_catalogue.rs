//! Every fault of every sensor, in the middle of simulated drives: the estimators survive it, say so, and are back in time.

use kapvik_firmware::rover::Rover;
use kapvik_host::bench::faults::REPORTED;
use kapvik_host::trial::faults::{ALLOWED_FRAMES, Case, catalogue};

/// Spread slips and hills, four drives each. A drive in which the estimates are out of bounds without a fault is asked for no
/// better than that: see [`kapvik_host::trial::faults::Outcome::frames_to_recover`].
#[test]
fn every_fault_is_survived_counted_and_over_in_twenty_frames() {
    assert_eq!(Case::all().len(), 30 * 5 + 3);
    let catalogue = catalogue(&REPORTED, 40..44, &Rover::assumed());
    assert_eq!((catalogue.drives, catalogue.outcomes.len()), (8, 8 * 153), "{:?}", catalogue.failures);
    for (scenario, seed, outcome) in &catalogue.outcomes {
        let which = format!("{scenario:?} {seed}, {:?}", outcome.case);
        assert_eq!(outcome.not_finite, 0, "{which}: not every number is finite");
        assert!(outcome.miscounted.is_empty(), "{which}: the health is wrong about {:?}", outcome.miscounted);
        let back = outcome.frames_to_recover.is_some_and(|frames| frames <= ALLOWED_FRAMES);
        assert!(back, "{which}: back after {:?} frames", outcome.frames_to_recover);
    }
}
