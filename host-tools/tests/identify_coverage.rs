//! How often the truth lies in what `identify` states, over campaigns drawn from the prior and laid out in ways that few scenes of
//! the networks' training are.

mod described;
mod drawn;
#[path = "../../firmware/tests/support/six_slips.rs"]
mod six_slips;

use drawn::{Held, KEYS, Plan};
use kapvik_firmware::pipeline;
use kapvik_host::identify::{Document, identify_rehearsed};
use six_slips::SIX_SLIPS;

/// Of a hundred cases with a chance of 95 each, fewer than 88 are in one of 600 sets; of fifty, fewer than 42.
fn check(plan: &Plan, soils: usize, least: usize) -> usize {
    let (campaign, drawn) = plan.campaign(soils, 71);
    let found = identify_rehearsed(&campaign, false, &mut |query| Ok(pipeline::answer(query))).expect("identified");
    let held = Held::of(&Document::of(&campaign, &found), &drawn);
    println!("of {soils}: within 2 σ and 95 % {held:?}");
    for ([_, in_interval], key) in held.within.into_iter().zip(KEYS) {
        assert!(in_interval >= least, "{key}: {in_interval} of {soils} in the 95 % interval");
    }
    for [within, _] in &held.within[1..] {
        assert!(*within >= least, "{within} of {soils} within 2 σ: {held:?}");
    }
    held.widened
}

#[test]
fn one_wheel_swept_over_slips_at_three_loads() {
    check(&Plan::of(&SIX_SLIPS, &[45.0, 65.0, 90.0], 30), 50, 42);
}

#[test]
fn slips_that_are_all_small() {
    check(&Plan::of(&[0.03, 0.055, 0.08, 0.105, 0.13, 0.15], &[65.0], 30), 100, 88);
}

#[test]
fn six_wheels_as_in_training_are_left_as_the_networks_state_them() {
    let widened = check(&Plan::of(&SIX_SLIPS, &[65.0], 1), 100, 88);
    assert!(widened < 30, "{widened}");
}

#[test]
fn one_wheel_at_one_slip() {
    check(&Plan::of(&[0.4], &[90.0], 30), 100, 88);
}

/// Of a hundred rows a state, whose noise keeps nine tenths from row to row, five are independent.
#[test]
fn rows_that_remember_each_other() {
    let plan = Plan::of(&SIX_SLIPS, &[45.0, 65.0, 90.0], 100);
    check(&Plan { kept: 0.9, ..plan }, 50, 42);
}
