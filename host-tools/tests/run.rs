//! `run --measured`, on the figures that the project carries, with the flight library in this process.

mod columns;
mod kapvik;
mod self_contained;
mod told;

use std::path::Path;

use columns::COLUMNS;
use kapvik::kapvik;
use kapvik_host::data::campaign::{Campaign, Provenance};
use kapvik_host::flight_computer::Computer;
use kapvik_host::prior;
use kapvik_host::report::{Findings, ModelCheck, RowKind, page, picture};
use self_contained::{is_a_picture, is_self_contained};
use told::told;

fn carried() -> Campaign {
    Campaign::carried().expect("the project's own figures")
}

#[test]
fn the_equations_leave_what_a_first_pass_over_these_figures_left() {
    let rms = ModelCheck::of(&carried()).expect("the soil is known").rms();
    // An independent implementation of equations 1–11 left 5.56 N and 4.08 mm on the same figures.
    assert!((rms.drawbar_pull_n.expect("measured") - 5.56).abs() < 0.06, "{rms:?}");
    assert!((1e3 * rms.sinkage_m.expect("measured") - 4.08).abs() < 0.05, "{rms:?}");
}

/// A number that no wheel can have felt is left out of what the equations leave, too.
#[test]
fn a_gross_error_is_no_residual() {
    let toml = "name = \"T\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.075\nwidth_m = 0.07\n";
    let rows = "a,0,0.2,65,5,1.8,0.012\na,1,0.3,65,8,2.1,0.013\n";
    let parse = |rows: &str| {
        let csv = format!("{COLUMNS}\n{rows}");
        Campaign::parse(Path::new("t.csv"), &csv, toml).expect("a campaign")
    };
    let soil = prior::soil([800.0, 0.55, 0.0114, 1.0, 1.0e6, 0.3, 0.15]);
    let [sound, spoiled] = [rows.to_owned(), format!("{rows}a,2,0.4,65,10,2.3,0.9\n")]
        .map(|rows| ModelCheck::with(&parse(&rows), soil).rms());
    assert!(sound.sinkage_m.is_some());
    assert_eq!(sound, spoiled);
}

#[test]
fn a_run_on_the_host_repeats_itself_to_the_bit() {
    let run = || {
        let folder = tempfile::tempdir().expect("a folder");
        let (report, picture) = (folder.path().join("report.html"), folder.path().join("picture.svg"));
        let mut command = kapvik();
        command.args(["run", "--measured", "--on", "host", "--report"]).arg(&report).arg("--picture").arg(&picture);
        let text = told(&mut command);
        let lines: Vec<&str> =
            text.lines().filter(|line| !line.starts_with("report:") && !line.starts_with("picture:")).collect();
        let read = |path| std::fs::read_to_string(path).expect("written");
        (lines.join("\n"), read(report), read(picture))
    };
    let (first, second) = (run(), run());
    assert_eq!(first, second);
    for words in ["direct tests", "fingerprint", "self-test at boot: passed", "left out: no torque_nm (line 2)"] {
        assert!(first.0.contains(words), "{words} in\n{}", first.0);
    }
}

#[test]
fn the_report_needs_nothing_else_and_hides_nothing() {
    let findings = Findings::gather(carried(), false, Computer::Host).expect("answers");
    assert_eq!(findings.campaign.provenance, Provenance::Digitised);
    let rows = Findings::rows(&findings.identification.runs[0]);
    let alone = rows.iter().filter(|row| row.kind == RowKind::Wheel);
    let told = alone.filter(|row| row.estimate.expect("an estimate").cohesion_pa.identifiable).count();
    assert_eq!(told, 0, "one wheel at one load cannot tell cohesion");
    let html = page(&findings);
    is_self_contained(&html);
    for words in
        ["digitised", "cannot be told from these data", "direct tests", "Every state has one load", "MIT licence"]
    {
        assert!(html.contains(words), "{words} is missing");
    }
    is_a_picture(&picture(&findings).expect("a picture"));
}

/// The main job without a file: the drive that the project carries, and the picture of it that the project shows.
#[test]
fn the_carried_drive_is_reported_as_the_project_shows_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let (report, picture) = (folder.path().join("report.html"), folder.path().join("picture.svg"));
    let mut command = kapvik();
    command.args(["run", "--on", "host", "--report"]).arg(&report).arg("--picture").arg(&picture);
    let told = told(&mut command);
    for words in ["a simulated drive", "soil at the end: c", "estimates against the truth", "self-test at boot: passed"]
    {
        assert!(told.contains(words), "{words} in\n{told}");
    }
    let read = |path| std::fs::read_to_string(path).expect("written");
    is_self_contained(&read(report));
    let command = "cargo kapvik run --on host --picture host-tools/pictures/traverse.svg";
    assert!(read(picture) == include_str!("../pictures/traverse.svg"), "the picture is out of date; type: {command}");
}

#[test]
fn the_picture_that_the_project_shows_is_the_one_that_it_makes() {
    let findings = Findings::gather(carried(), false, Computer::Host).expect("answers");
    let shown = include_str!("../pictures/ding2011-smooth.svg");
    let command = "cargo kapvik run --measured --on host --picture host-tools/pictures/ding2011-smooth.svg";
    assert!(picture(&findings).as_deref() == Some(shown), "the picture is out of date; type: {command}");
}

#[test]
fn a_campaign_with_many_runs_and_no_known_soil_is_reported() {
    let toml = "name = \"<b>&\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.075\nwidth_m = 0.07\n";
    let mut csv = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm\n".to_owned();
    (0..30).for_each(|run| csv += &format!("r{run},0,0.{run:02},65,3,1.6\n"));
    let campaign = Campaign::parse(std::path::Path::new("many.csv"), &csv, toml).expect("a campaign");
    let findings = Findings::gather(campaign, false, Computer::Host).expect("answers");
    assert!(findings.model.is_none());
    let html = page(&findings);
    assert!(html.contains("&lt;b&gt;&amp;") && !html.contains("<b>&"), "what a file says is text, never markup");
    assert!(html.contains("6 more runs"));
}
