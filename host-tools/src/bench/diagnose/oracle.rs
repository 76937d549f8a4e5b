//! What of two effects could be found at all: by somebody who is told which two they are.

use rayon::prelude::*;

use super::campaign_draw::{Drawn, Subject};
use super::share::Share;
use super::trial::Trial;
use crate::diagnose::{Told, told};

/// For each campaign with two effects, whether each shows beyond chance beside the other, and whether the diagnosis was right.
pub fn print(drawn: &[Drawn], trials: &[Trial]) {
    let of = |(drawn, trial): (&Drawn, &Trial)| match drawn.truth.subject {
        Subject::Two(first, second) => {
            let campaign = drawn.written.campaign(&drawn.name).ok()?;
            let found = told(&campaign, &[first, second]).ok()?;
            let right = trial.answer.as_ref().is_ok_and(|answer| answer.is_right(&drawn.truth));
            Some((drawn.name.clone(), [first, second], found, right))
        }
        _ => None,
    };
    let pairs: Vec<_> = drawn.par_iter().zip(trials).filter_map(of).collect();
    println!(
        "\nto one who is told of the two effects, beside the other (chance, gain of held-out rows in nats a row):"
    );
    for (name, ids, found, right) in &pairs {
        let said: Vec<String> = ids.iter().zip(found).map(|(id, told)| format!("{id} {}", figures(*told))).collect();
        println!("  {name}: {}; {}", said.join(", "), if *right { "both found" } else { "not both found" });
    }
    let is_visible = |found: &[Option<Told>]| found.iter().all(|told| told.is_some_and(|told| told.is_detectable()));
    let visible: Vec<_> = pairs.iter().filter(|(_, _, found, _)| is_visible(found)).collect();
    println!("both beyond chance            {}", Share::of(&pairs, |(_, _, found, _)| is_visible(found)));
    println!("  of these both found         {}", Share::of(&visible, |(_, _, _, right)| *right));
}

fn figures(told: Option<Told>) -> String {
    told.map_or("without a fit".to_owned(), |told| format!("({:.0e}, {:.3})", told.p_value, told.gain_per_row))
}
