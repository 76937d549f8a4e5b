//! Whether what the rover file states is what the sensors show: mass, gravity, noise.

use super::findings::TraverseFindings;

/// What a reader must know where it is not.
pub fn rover_file_doubts(findings: &TraverseFindings) -> Option<String> {
    let outcome = &findings.outcome;
    let cells = outcome.misfit.map(|misfit| misfit.to_string());
    let gravity = outcome.other_gravity.map(|other| other.to_string());
    let said = cells.into_iter().chain(gravity).chain(outcome.noisier.iter().map(ToString::to_string));
    let sentences: Vec<String> = said.filter_map(|said| sentence(&said)).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

fn sentence(said: &str) -> Option<String> {
    let first = said.chars().next()?;
    Some(format!("{}{}.", first.to_uppercase(), &said[first.len_utf8()..]))
}
