//! Whether the rover's mass is what its load cells bear.

use super::findings::TraverseFindings;

/// What a reader must know where it is not.
pub fn cells_and_mass(findings: &TraverseFindings) -> Option<String> {
    let said = findings.outcome.misfit?.to_string();
    let first = said.chars().next()?;
    Some(format!("{}{}.", first.to_uppercase(), &said[first.len_utf8()..]))
}
