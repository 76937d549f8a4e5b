//! One check of `kapvik test`: a program to run and what came of it.

use std::fmt;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::process::lines;

/// A check that has not run yet.
pub struct Check {
    name: &'static str,
    action: Result<Command, String>,
}

/// What came of a check.
pub struct Outcome {
    name: &'static str,
    /// Tests that passed; a check without tests of its own counts as one.
    pub passed: u32,
    /// Tests that failed.
    pub failed: u32,
    /// Checks that were left out.
    pub skipped: u32,
    took: Duration,
    remark: String,
}

impl Check {
    /// A check that passes when the program does.
    pub fn new(name: &'static str, program: Command) -> Self {
        Self { name, action: Ok(program) }
    }

    /// A check that cannot be made here, and why.
    pub fn skipped(name: &'static str, reason: String) -> Self {
        Self { name, action: Err(reason) }
    }

    /// Runs the program, showing what it prints.
    pub fn run(self) -> Outcome {
        println!("\n== {}", self.name);
        let mut program = match self.action {
            Ok(program) => program,
            Err(remark) => return Outcome { skipped: 1, ..Outcome::new(self.name, remark) },
        };
        let start = Instant::now();
        let mut outcome = match run_and_count(&mut program) {
            Ok(counts) => {
                Outcome { passed: counts.passed, failed: counts.failed, ..Outcome::new(self.name, String::new()) }
            }
            Err(error) => Outcome::failed(self.name, error.to_string()),
        };
        outcome.took = start.elapsed();
        outcome
    }
}

impl Outcome {
    fn new(name: &'static str, remark: String) -> Self {
        Self { name, passed: 0, failed: 0, skipped: 0, took: Duration::ZERO, remark }
    }

    /// A check that could not be made although it should.
    pub fn failed(name: &'static str, remark: String) -> Self {
        Self { failed: 1, ..Self::new(name, remark) }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = match (self.failed, self.skipped) {
            (1.., _) => "FAILED",
            (0, 1..) => "skipped",
            (0, 0) => "ok",
        };
        write!(
            f,
            "{word:<8}{:<36}{:>5} passed{:>4} failed{:>7.0} s",
            self.name,
            self.passed,
            self.failed,
            self.took.as_secs_f64()
        )?;
        if self.remark.is_empty() { Ok(()) } else { write!(f, "  {}", self.remark) }
    }
}

/// How many tests passed and failed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Counts {
    passed: u32,
    failed: u32,
}

/// Runs a program, passes on what it prints, and adds up the result lines of the test runner in it.
fn run_and_count(program: &mut Command) -> std::io::Result<Counts> {
    let mut child = program.stdout(Stdio::piped()).spawn()?;
    let mut counts = Counts::default();
    for line in child.stdout.take().into_iter().flat_map(lines) {
        println!("{line}");
        if let Some(result) = result_line(&line) {
            counts.passed += result.passed;
            counts.failed += result.failed;
        }
    }
    let succeeded = child.wait()?.success();
    Ok(match counts {
        // A program without tests of its own is one test.
        Counts { passed: 0, failed: 0 } if succeeded => Counts { passed: 1, failed: 0 },
        // It failed before, or beside, its tests.
        Counts { failed: 0, .. } if !succeeded => Counts { failed: 1, ..counts },
        counts => counts,
    })
}

/// The counts of a line `test result: ok. 12 passed; 0 failed; …`.
fn result_line(line: &str) -> Option<Counts> {
    let rest = line.strip_prefix("test result: ")?;
    let count = |word: &str| {
        let part = rest.split([';', '.']).find(|part| part.trim().ends_with(word))?;
        part.split_whitespace().next()?.parse().ok()
    };
    Some(Counts { passed: count("passed")?, failed: count("failed")? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn result_lines_of_the_test_runner_are_read() {
        let line = "test result: FAILED. 12 passed; 3 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.03s";
        assert_eq!(result_line(line), Some(Counts { passed: 12, failed: 3 }));
        assert_eq!(result_line("test link ... ok"), None);
    }

    #[test]
    fn a_program_that_fails_counts_as_a_failed_test() {
        let counts = |code: &str| run_and_count(Command::new("sh").args(["-c", code])).expect("there is a shell");
        assert_eq!(counts("exit 0"), Counts { passed: 1, failed: 0 });
        assert_eq!(counts("exit 3"), Counts { passed: 0, failed: 1 });
        let tests = "echo 'test result: ok. 5 passed; 0 failed; 0 ignored'";
        assert_eq!(counts(tests), Counts { passed: 5, failed: 0 });
        assert_eq!(counts(&format!("{tests}; exit 1")), Counts { passed: 5, failed: 1 });
    }
}
