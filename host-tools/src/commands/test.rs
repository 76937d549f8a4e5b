//! `kapvik test`

mod check;

use clap::Args;

use crate::error::HostError;
use crate::process::{command, find_on_path};
use crate::setup::{self, TARGET, TARGET_FROM, TargetFrom, TargetRoute, Toolchain};

use check::{Check, Outcome};

/// Options of `kapvik test`.
#[derive(Args)]
pub struct Arguments {
    /// Leave out the flight image built by Debian's compiler, the second way to the Arm target
    #[arg(long)]
    skip_second_target: bool,
}

/// Runs every check, whatever the others say, and sums up.
///
/// # Errors
/// Where a check failed.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let toolchain = setup::prepare(None)?;
    let mut outcomes = Vec::new();
    for check in checks(&toolchain) {
        outcomes.push(check.run());
    }
    if !arguments.skip_second_target {
        outcomes.push(second_target(&toolchain));
    }
    sum_up(&outcomes)
}

fn checks(toolchain: &Toolchain) -> Vec<Check> {
    let format = |of: &[&str]| {
        let mut format = command("cargo");
        format.args(["fmt", "--check"]).args(of);
        format
    };
    let mut lint = command("cargo");
    lint.args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]);
    let mut tests = command("cargo");
    tests.args(["test", "--release", "--workspace", "--no-fail-fast"]);
    let mut docs = command("cargo");
    docs.args(["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings");
    vec![
        Check::new("formatting", format(&["--all"])),
        // A workspace of its own, so that what they need is not the product's.
        Check::new("formatting, contenders", format(&["--manifest-path", "tests/contenders/Cargo.toml"])),
        Check::new("lints, host", lint),
        lint_image(toolchain),
        Check::new("tests, host and QEMU", tests),
        Check::new("documentation", docs),
    ]
}

fn lint_image(toolchain: &Toolchain) -> Check {
    const NAME: &str = "lints, flight image";
    if toolchain.target != TargetRoute::Rustup {
        return Check::skipped(NAME, format!("the toolchain that has clippy has no {TARGET}"));
    }
    let mut lint = command("cargo");
    lint.args(["clippy", "--target", TARGET, "--package", "kapvik-firmware", "--package", "kapvik-board-an386"]);
    lint.args(["--features", "kapvik-firmware/board-an386", "--lib", "--bins", "--", "-D", "warnings"]);
    Check::new(NAME, lint)
}

/// Tests of the image that hang on how it was compiled, by their files in `tests`: not that of another table, which is built by the same steps.
const TESTS_OF_THE_IMAGE: [&str; 5] = ["image", "link_in_qemu", "replay", "run", "target"];

/// These tests in QEMU once more, with the image built by the other compiler. Instruction counts are the first one's.
fn second_target(toolchain: &Toolchain) -> Outcome {
    const NAME: &str = "tests, image by Debian's compiler";
    if toolchain.target != TargetRoute::Rustup {
        return Check::skipped(NAME, "the tests above ran with it".to_owned()).run();
    }
    if find_on_path("apt-get").is_none() {
        return Check::skipped(NAME, "this is no Debian".to_owned()).run();
    }
    if let Err(error) = setup::prepare(Some(TargetFrom::Debian)) {
        return Check::skipped(NAME, error.to_string()).run();
    }
    let mut tests = command("cargo");
    tests.env(TARGET_FROM, "debian");
    tests.args(["test", "--release", "--package", "kapvik-tests", "--no-fail-fast"]);
    tests.args(TESTS_OF_THE_IMAGE.iter().flat_map(|name| ["--test", name]));
    tests.args(["--", "--skip", "functions_cost_no_more_than_their_budget"]);
    Check::new(NAME, tests).run()
}

fn sum_up(outcomes: &[Outcome]) -> Result<(), HostError> {
    println!();
    for outcome in outcomes {
        println!("{outcome}");
    }
    let sum = |count: fn(&Outcome) -> u32| outcomes.iter().map(count).sum::<u32>();
    let (passed, failed, skipped) = (sum(|o| o.passed), sum(|o| o.failed), sum(|o| o.skipped));
    match skipped {
        0 => println!("\n{passed} passed, {failed} failed"),
        _ => println!("\n{passed} passed, {failed} failed, {skipped} skipped"),
    }
    if failed == 0 { Ok(()) } else { Err(HostError::Failed(format!("{failed} failed"))) }
}
