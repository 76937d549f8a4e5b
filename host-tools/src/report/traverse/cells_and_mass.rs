//! Whether the rover's mass is what its load cells bear, and its gravity what its accelerometer feels.

use super::findings::TraverseFindings;

/// What a reader must know where they are not.
pub fn cells_and_mass(findings: &TraverseFindings) -> Option<String> {
    let outcome = &findings.outcome;
    let cells = outcome.misfit.map(|misfit| misfit.to_string());
    let said = cells.into_iter().chain(outcome.other_gravity.map(|other| other.to_string()));
    let sentences: Vec<String> = said.filter_map(|said| sentence(&said)).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

fn sentence(said: &str) -> Option<String> {
    let first = said.chars().next()?;
    Some(format!("{}{}.", first.to_uppercase(), &said[first.len_utf8()..]))
}
