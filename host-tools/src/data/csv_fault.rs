//! What makes text no CSV table before any field is read, and in which field that is.

use std::str::Utf8Error;

use super::text::NOT_UTF_8;
use crate::error::HostError;

/// Something that no table holds, at a line and a field of a text, both from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fault {
    line: u64,
    field: u64,
    message: &'static str,
}

impl Fault {
    /// A line that ends in a carriage return alone, which would run into the next one, or a quote that is never closed, behind which the rest
    /// would vanish into one field; none where there is neither.
    pub fn of(text: &str) -> Option<Self> {
        let open = open_quote(text)
            .map(|at| (at, "a quote is not closed: expected another (a quote within a field is written twice)"));
        let alone = text.match_indices('\r').find(|(at, _)| !text[at + 1..].starts_with('\n'));
        let alone = || alone.map(|(at, _)| (at, "a line ends in a carriage return alone: expected a line feed"));
        open.or_else(alone).map(|(at, message)| Self::behind(&text[..at], message))
    }

    /// A byte that is not UTF-8.
    pub fn of_encoding(bytes: &[u8], error: &Utf8Error) -> Self {
        let before = String::from_utf8_lossy(bytes.get(..error.valid_up_to()).unwrap_or(bytes));
        Self::behind(&before, NOT_UTF_8)
    }

    /// As an error of a file, where the text begins at such a line of it. `error` takes a line, a field and a message.
    pub fn told(self, first_line: u64, error: impl Fn(u64, u64, &'static str) -> HostError) -> HostError {
        error(first_line + self.line - 1, self.field, self.message)
    }

    fn behind(before: &str, message: &'static str) -> Self {
        let line = before.rsplit('\n').next().unwrap_or("");
        let (mut is_quoted, mut field) = (false, 1);
        for character in line.chars() {
            match character {
                '"' => is_quoted = !is_quoted,
                ',' if !is_quoted => field += 1,
                _ => (),
            }
        }
        Self { line: 1 + before.matches('\n').count() as u64, field, message }
    }
}

/// Where the last quote stands of the first line that has an odd number of them, in a text that has; behind it all quotes would be turned.
fn open_quote(text: &str) -> Option<usize> {
    let quotes = |text: &str| text.matches('"').count();
    if quotes(text).is_multiple_of(2) {
        return None;
    }
    let mut start = 0;
    text.split_inclusive('\n').find_map(|line| {
        let at = start + line.rfind('"').unwrap_or(0);
        start += line.len();
        (!quotes(line).is_multiple_of(2)).then_some(at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_is_in_a_field_of_a_line() {
        let place = |text: &str| Fault::of(text).map(|fault| (fault.line, fault.field));
        assert_eq!(place("a,b\n1,\"2\n"), Some((2, 2)));
        assert_eq!(place("a,b\n1,\"2\n\"3\",4\n\"5\",\"6\"\n"), Some((2, 2)), "whole quotes below it");
        assert_eq!(place("a,b\r\n\"1,5\",2\r3,4\n"), Some((2, 2)));
        assert_eq!(place("a,b\r\n\"1,5\",\"2\"\r\n"), None);
    }
}
