//! What is said of a command line that is none.

use std::process::ExitCode;

use clap::Error;
use clap::error::ErrorKind;

/// Explains on one line what is wrong, as for any other input; or prints the help that was asked for.
pub fn explain(error: &Error) -> ExitCode {
    let whole = !error.use_stderr() || error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    if whole {
        // Where help cannot be printed, there is nobody to tell.
        let _ = error.print();
    } else {
        eprintln!("kapvik: {} (more: --help)", on_one_line(&error.render().to_string()));
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(1))
}

/// The paragraphs that tell what is wrong and what may be meant, without those that are the same for every mistake.
fn on_one_line(rendered: &str) -> String {
    let telling = rendered.split("\n\n").filter(|paragraph| {
        !["Usage:", "For more information"].iter().any(|start| paragraph.trim_start().starts_with(start))
    });
    let lines: Vec<_> = telling.map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    lines.join("; ").trim_start_matches("error: ").to_owned()
}

#[cfg(test)]
mod tests {
    use super::on_one_line;

    #[test]
    fn what_is_missing_and_what_may_be_meant_stand_on_one_line() {
        let rendered = "error: unexpected argument '--rovr' found\n\n  tip: a similar argument exists: '--rover'\n\n\
                        Usage: kapvik replay <FRAMES.csv>\n\nFor more information, try '--help'.\n";
        let line = "unexpected argument '--rovr' found; tip: a similar argument exists: '--rover'";
        assert_eq!(on_one_line(rendered), line);
    }
}
