//! Whether what the rover file states is what the sensors show: mass, gravity, noise.

use super::findings::TraverseFindings;

/// What a reader must know where it is not.
pub fn rover_file_doubts(findings: &TraverseFindings) -> Option<String> {
    let sentences: Vec<String> = findings.outcome.doubts_of_rover_file().filter_map(|said| sentence(&said)).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

fn sentence(said: &str) -> Option<String> {
    let first = said.chars().next()?;
    Some(format!("{}{}.", first.to_uppercase(), &said[first.len_utf8()..]))
}
