//! Whole diagnoses of drawn campaigns: one of each kind of answer, and one in which the true effect was once fitted to a false
//! optimum beside the declared model's soil.

use super::answer::Answer;
use super::campaign_draw::{Subject, Truth, draw};
use super::shared_errors::SharedErrors;
use super::unlisted::UNLISTED;
use crate::diagnose::document::Verdict;
use crate::diagnose::{DiagnoseOptions, diagnose};

fn answer(subject: Subject, seed: u64, number: u64) -> (Truth, Answer) {
    let drawn = draw(subject, SharedErrors::Usual, seed, number).expect("a campaign in which it shows");
    let campaign = drawn.written.campaign(&drawn.name).expect("what was written");
    let found = diagnose(&campaign, &DiagnoseOptions::default(), &|_| ()).expect("a diagnosis");
    (drawn.truth, Answer::from(&found.document))
}

#[test]
fn the_true_effect_is_found_where_another_has_bent_the_soil() {
    let (_, answer) = answer(Subject::One("torque-scale"), 9029, 3);
    assert!(answer.first_alone("torque-scale"), "{answer:?}");
    assert_eq!(answer.effects.len(), 1, "{answer:?}");
}

#[test]
fn nothing_is_found_where_nothing_is_undeclared() {
    let (_, answer) = answer(Subject::Clean, 903, 0);
    assert_eq!(answer.verdict, Verdict::None, "{answer:?}");
}

#[test]
fn what_is_in_no_list_is_left_as_structure_of_its_channel() {
    let (truth, answer) = answer(Subject::Unlisted(&UNLISTED[0]), 903, 0);
    assert!(answer.is_right(&truth), "{answer:?}");
}
