//! Text of files, safe to print.

use std::fmt;

/// What would break a line or command a terminal is escaped.
pub fn on_one_line(text: &str) -> impl fmt::Display + '_ {
    fmt::from_fn(move |line| {
        text.chars().try_for_each(|character| {
            if character.is_control() {
                write!(line, "{}", character.escape_debug())
            } else {
                write!(line, "{character}")
            }
        })
    })
}

/// The same of a paragraph, whose lines may end where they like.
pub fn paragraph(text: &str) -> String {
    on_one_line(&text.split_whitespace().collect::<Vec<_>>().join(" ")).to_string()
}

#[cfg(test)]
mod tests {
    use super::{on_one_line, paragraph};

    #[test]
    fn what_commands_a_terminal_is_escaped_and_all_else_stays() {
        assert_eq!(on_one_line("a\u{1b}[31m\n“b” ± 3°").to_string(), "a\\u{1b}[31m\\n“b” ± 3°");
    }

    #[test]
    fn a_paragraph_is_one_line_of_words() {
        assert_eq!(paragraph("  dry\n  sand,\t2011\u{7} "), "dry sand, 2011\\u{7}");
    }
}
