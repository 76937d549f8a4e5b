//! Whether what the rover file states is what the sensors show: mass, gravity, noise.

use super::findings::TraverseFindings;
use crate::report::sentence::capitalised;

/// What a reader must know where it is not.
pub fn rover_file_doubts(findings: &TraverseFindings) -> Option<String> {
    let sentences: Vec<String> = findings.outcome.doubts_of_rover_file().map(|said| sentence(&said)).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

/// A key or a column has no capital letter.
fn sentence(said: &str) -> String {
    let begins_with_name = said.split(' ').next().is_some_and(|word| word.contains('_'));
    if begins_with_name { format!("{said}.") } else { capitalised(said) }
}
