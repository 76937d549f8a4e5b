//! Sentences.

/// With a capital letter.
pub fn capitalised(said: &str) -> String {
    let mut letters = said.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}", first.to_uppercase(), letters.as_str()))
}

/// With a capital letter and a full stop; nothing of nothing.
pub fn as_sentence(said: &str) -> String {
    if said.is_empty() { String::new() } else { format!("{}.", capitalised(said)) }
}
