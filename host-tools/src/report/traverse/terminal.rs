//! The findings in lines for the terminal.

use super::errors;
use super::findings::TraverseFindings;
use crate::replay;
use crate::report::terminal::wrapped;
use crate::terminal_table::{align_right, plain_table};

use super::caveats::caveats;

/// What came of the drive, a table of errors where the truth is known, and the caveats.
pub fn terminal(findings: &TraverseFindings) -> String {
    let mut text = format!("{}\n\n", findings.name());
    for line in findings.remarks.iter().chain(&replay::lines(&findings.outcome)) {
        text += &wrapped("", line);
    }
    if let Some(errors) = &findings.errors {
        let mut table = plain_table();
        table.set_header(errors::HEAD);
        errors::rows(errors).into_iter().for_each(|row| {
            table.add_row(row);
        });
        align_right(&mut table);
        text += &format!("\nestimates against the truth\n{table}\n");
        text += "  raw sensors: frame by frame or as a mean of the last second, whichever is better\n";
    }
    text += "\n";
    for caveat in caveats(findings) {
        text += &wrapped("• ", &caveat);
    }
    text
}
