//! What the sensors show otherwise than rover file and agreement say, for a reader of the report.

use super::findings::TraverseFindings;
use crate::report::sentence::as_sentence;

/// What a reader must know where they do.
pub fn doubts(findings: &TraverseFindings) -> Option<String> {
    let sentences: Vec<String> = findings.outcome.doubts.iter().map(|said| sentence(said)).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}

/// A key or a column has no capital letter.
fn sentence(said: &str) -> String {
    let begins_with_name = said.split(' ').next().is_some_and(|word| word.contains('_'));
    if begins_with_name { format!("{said}.") } else { as_sentence(said) }
}
