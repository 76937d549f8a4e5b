//! The diagnosis of a campaign.

use kapvik_host::data::campaign::Campaign;
use kapvik_host::diagnose::document::Diagnosis;
use kapvik_host::diagnose::{DiagnoseOptions, diagnose};

/// What is found where nothing is asked for but the campaign.
pub fn diagnosed(campaign: &Campaign) -> Diagnosis {
    let document = diagnose(campaign, &DiagnoseOptions::default(), &|_| ()).expect("diagnosed").document;
    check_that_each_effect_says_what_it_may_be_else(&document);
    document
}

/// With each effect stands what the verdict says of the first and the caveats say of the others.
fn check_that_each_effect_says_what_it_may_be_else(document: &Diagnosis) {
    for (place, effect) in document.effects.iter().enumerate() {
        let others = &effect.ambiguous_with;
        let caveat = format!("{}: these data do not tell it from {}.", effect.id, others.join(" or "));
        let is_said_by_verdict = place == 0 && *others == document.ambiguous_with;
        assert_eq!(document.caveats.contains(&caveat), !others.is_empty() && !is_said_by_verdict, "{effect:?}");
        assert!(place > 0 || others.starts_with(&document.ambiguous_with), "{effect:?}");
    }
}
