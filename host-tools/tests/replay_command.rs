//! `kapvik replay` with the flight library in this process: bad input ends it with one line that names the place, and
//! leaves nothing behind; the rest is written whole.

mod kapvik;
mod refused;
mod self_contained;
mod told;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use assert_cmd::assert::OutputAssertExt;
use kapvik::kapvik;
use kapvik_firmware::pipeline::Pipeline;
use kapvik_firmware::rover::Rover;
use kapvik_host::data::frame_file::{FrameReader, write_frame, write_header};
use kapvik_host::data::sensor_channels::names;
use kapvik_host::replay::EstimateWriter;
use kapvik_host::simulate::{Options, Scenario, Traverse};
use refused::refused;
use self_contained::{is_a_picture, is_self_contained};
use told::told;

/// A folder with a file of frames of a level drive.
struct Case {
    folder: tempfile::TempDir,
}

impl Case {
    /// Frames of a level drive, with the line of that number replaced, from 1, the header being the first.
    fn with(replaced: Option<(usize, String)>) -> Self {
        Self::lasting(6.0, replaced)
    }

    /// The same over so many seconds.
    fn lasting(duration_s: f64, replaced: Option<(usize, String)>) -> Self {
        let options = Options { duration_s: Some(duration_s), ..Options::default() };
        let drive = Traverse::new(Scenario::Level, 3, &Rover::assumed(), &options).expect("a drive");
        let mut bytes = Vec::new();
        write_header(&mut bytes).expect("written");
        for step in drive {
            write_frame(&mut bytes, &step.expect("a frame").0).expect("written");
        }
        let text = String::from_utf8(bytes).expect("text");
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        if let Some((number, line)) = replaced {
            lines[number - 1] = line;
        }
        let case = Self { folder: tempfile::tempdir().expect("a folder") };
        fs::write(case.path("frames.csv"), lines.join("\n") + "\n").expect("written");
        case
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, subcommand: &str) -> Command {
        let mut command = kapvik();
        command.current_dir(self.folder.path()).args([subcommand, "--on", "host"]);
        command
    }

    fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("readable");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// `replay` and `run` with these arguments fail with one line that has all of these words, and leave no file.
    fn is_refused(&self, arguments: &[&str], words: &[&str]) {
        for (subcommand, output) in [("replay", "-o"), ("run", "--report")] {
            refused(self.command(subcommand).args(arguments).args([output, "out"]), words);
        }
    }
}

/// A row of the drive with one field replaced.
fn row(time_s: &str, field: &str, column: usize) -> String {
    let mut fields = vec!["0.1".to_owned(); names().len() + 1];
    fields[0] = time_s.to_owned();
    fields[column - 1] = field.to_owned();
    fields.join(",")
}

#[test]
fn frames_become_estimates_row_by_row() {
    let case = Case::with(None);
    let told = told(case.command("replay").args(["frames.csv", "-o", "out.csv"]));
    assert!(told.contains("61 frames, 6.0 s") && told.contains("times real time"), "{told}");
    let mut pipeline = Pipeline::new(&Rover::assumed()).expect("the assumed rover can be");
    let mut expected = Vec::new();
    let mut writer = EstimateWriter::new(&mut expected).expect("written");
    for frame in FrameReader::open(&case.path("frames.csv")).expect("frames") {
        writer.write(pipeline.tick(&frame.expect("a frame"))).expect("written");
    }
    let written = fs::read(case.path("out.csv")).expect("written");
    assert!(written == expected, "the link changes no bit");
    assert_eq!(case.files(), ["frames.csv", "out.csv"]);
}

#[test]
fn a_rover_file_is_used() {
    let case = Case::with(None);
    fs::write(case.path("rover.toml"), "mass_kg = 60.0\n").expect("written");
    let run = |arguments: &[&str]| {
        case.command("replay").args(["frames.csv", "-o", "out.csv"]).args(arguments).assert().success();
        fs::read(case.path("out.csv")).expect("written")
    };
    assert!(run(&[]) != run(&["--rover", "rover.toml"]));
}

#[test]
fn columns_of_no_sensor_are_named_once() {
    let case = Case::with(None);
    let text = fs::read_to_string(case.path("frames.csv")).expect("readable");
    assert!(text.starts_with("t_s,wheel_rate_fl_rad_s,"));
    fs::write(case.path("frames.csv"), text.replacen("wheel_rate_fl_rad_s", "battery_v", 1)).expect("written");
    for (subcommand, output) in [("replay", "-o"), ("run", "--report")] {
        let told = told(case.command(subcommand).args(["frames.csv", output, "out"]));
        assert_eq!(told.matches("columns that name no sensor, and are not used: battery_v\n").count(), 1, "{told}");
    }
}

/// A letter or a unit less, and the filters would do without a sensor that is there.
#[test]
fn a_column_that_is_nearly_one_of_a_sensor_is_refused() {
    let case = Case::with(None);
    let text = fs::read_to_string(case.path("frames.csv")).expect("readable");
    fs::write(case.path("frames.csv"), text.replacen("wheel_rate_fl_rad_s", "wheel_rate_fl", 1)).expect("written");
    let words = "frames.csv:1:2: `wheel_rate_fl` is no sensor: is `wheel_rate_fl_rad_s` meant?";
    case.is_refused(&["frames.csv"], &[words]);
}

#[test]
fn load_cells_that_do_not_bear_the_mass_are_told_of() {
    let case = Case::lasting(30.0, None);
    for (mass, is_off) in [("40", true), ("41", false)] {
        fs::write(case.path("rover.toml"), format!("mass_kg = {mass}\n")).expect("written");
        for (subcommand, output) in [("replay", "-o"), ("run", "--report")] {
            let arguments = ["frames.csv", output, "out", "--rover", "rover.toml"];
            let told = told(case.command(subcommand).args(arguments));
            let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
            assert_eq!(told.contains("mass, gravity or the cells' zero is off"), is_off, "{told}");
        }
        let html = fs::read_to_string(case.path("out")).expect("written");
        assert_eq!(html.contains("The load cells together bear 402 N where"), is_off);
    }
}

#[test]
fn sensors_that_are_noisier_than_stated_are_told_of() {
    let case = Case::lasting(30.0, None);
    for (noise, is_more) in [("0.02", true), ("0.05", false)] {
        fs::write(case.path("rover.toml"), format!("[noise]\nmotor_torque_nm = {noise}\n")).expect("written");
        for (subcommand, output) in [("replay", "-o"), ("run", "--report")] {
            let arguments = ["frames.csv", output, "out", "--rover", "rover.toml"];
            let told = told(case.command(subcommand).args(arguments));
            let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
            assert_eq!(told.contains("motor_torque_nm scatters by 0.0"), is_more, "{subcommand}: {told}");
            assert_eq!(told.contains("scatters"), is_more, "{subcommand}: {told}");
        }
        let html = fs::read_to_string(case.path("out")).expect("written");
        assert_eq!(html.contains("times the 0.02 that the rover file states"), is_more);
    }
}

/// Degrees in a column of rad are beyond what a joint does; the filters do without.
#[test]
fn a_sensor_in_other_units_is_told_of() {
    let case = Case::with(None);
    let text = fs::read_to_string(case.path("frames.csv")).expect("readable");
    let header = text.lines().next().expect("a header");
    let place = header.split(',').position(|name| name == "bogie_angle_l_rad").expect("the column");
    let in_degrees = |line: &str| {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        if let Ok(angle_rad) = fields[place].parse::<f64>() {
            fields[place] = (10.0 + angle_rad.to_degrees()).to_string();
        }
        fields.join(",") + "\n"
    };
    fs::write(case.path("frames.csv"), text.lines().map(in_degrees).collect::<String>()).expect("written");
    for (subcommand, output) in [("replay", "-o"), ("run", "--report")] {
        let told = told(case.command(subcommand).args(["frames.csv", output, "out"]));
        let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
        for words in [
            "bogie_angle_l_rad says more than a rover can do in nearly all readings",
            "out of range: bogie_angle_l_rad 61",
        ] {
            assert!(told.contains(words), "{subcommand}: {told}");
        }
    }
}

#[test]
fn bad_frames_are_refused_at_their_place() {
    let last = 62;
    for (line, text, words) in [
        (last, row("6", "abc", 5), ["frames.csv:62:5:", "`abc`"]),
        (30, row("1.0", "0.1", 5), ["frames.csv:30:1:", "backwards"]),
        (30, row("x", "0.1", 5), ["frames.csv:30:1:", "`x`"]),
        (30, "1,2,3".to_owned(), ["frames.csv:30:4:", "3 fields"]),
        (1, row("time", "wheel_rate_fl", 2), ["frames.csv:1:", "expected"]),
    ] {
        Case::with(Some((line, text))).is_refused(&["frames.csv"], &words);
    }
}

#[test]
fn missing_files_and_impossible_rovers_are_refused() {
    let case = Case::with(None);
    case.is_refused(&["nowhere.csv"], &["nowhere.csv", "No such file"]);
    case.is_refused(&["frames.csv", "--rover", "nowhere.toml"], &["nowhere.toml", "No such file"]);
    fs::write(case.path("rover.toml"), "mass_kg = 41\n[suspension]\nfront_hub = [-1.0, -0.2]\n").expect("written");
    case.is_refused(&["frames.csv", "--rover", "rover.toml"], &["rover.toml:3:13:", "front_hub"]);
    fs::write(case.path("empty.csv"), "").expect("written");
    case.is_refused(&["empty.csv"], &["empty.csv:1:1:"]);
    fs::write(case.path("header.csv"), "t_s,wheel_rate_fl_rad_s\n").expect("written");
    case.is_refused(&["header.csv"], &["header.csv:2:1: no frame"]);
    fs::write(case.path("rover.toml"), "mass_kg = 41\n[wheel]\nradius_m = 75\n").expect("written");
    case.is_refused(&["frames.csv", "--rover", "rover.toml"], &["rover.toml:3:12: radius_m = 75: expected m"]);
    fs::write(case.path("rover.toml"), "[suspension]\nfront_hub = [350, -200]\n").expect("written");
    case.is_refused(&["frames.csv", "--rover", "rover.toml"], &["rover.toml:2:13: front_hub: expected metres"]);
    fs::write(case.path("rover.toml"), "[suspension]\nfront_hub = [0.35, -0.20, 99]\n").expect("written");
    case.is_refused(&["frames.csv", "--rover", "rover.toml"], &["rover.toml:2:13: 3 numbers: expected 2"]);
}

#[test]
fn a_recording_is_not_replaced_by_its_estimates() {
    let case = Case::with(None);
    let recorded = fs::read(case.path("frames.csv")).expect("readable");
    case.command("replay").args(["frames.csv", "-o", "frames.csv"]).assert().failure();
    assert_eq!(fs::read(case.path("frames.csv")).expect("readable"), recorded);
}

#[test]
fn a_bad_truth_is_refused_at_its_place() {
    let case = Case::with(None);
    fs::write(case.path("frames.truth.csv"), "t_s,slip_fl\n0,0.1\n0.1,x\n").expect("written");
    refused(case.command("run").args(["frames.csv", "--report", "out"]), &["frames.truth.csv:3:2:"]);
}

/// A column that is nearly one of a truth would stay away from the errors without a word; so would a truth of other times.
#[test]
fn a_truth_that_says_nothing_of_the_frames_is_told() {
    let case = Case::with(None);
    let truth = |text: &str| fs::write(case.path("frames.truth.csv"), text).expect("written");
    let run = || {
        let mut command = case.command("run");
        command.args(["frames.csv", "--report", "out"]);
        command
    };
    truth("t_s,drawbar_pull_fl\n0,0.1\n");
    refused(
        &mut run(),
        &["frames.truth.csv:1:2: `drawbar_pull_fl` is no column of a truth: is `drawbar_pull_fl_n` meant?"],
    );
    truth("t_s\n0\n0.1\n");
    refused(&mut run(), &["frames.truth.csv:1:1: no column of a truth"]);
    truth("t_s,slip_fl\n0.05,0.1\n0.15,0.1\n");
    let told = told(&mut run());
    assert!(told.contains("has no row at the time of any of them"), "{told}");
}

/// Clocks start anywhere: what a start-up is counts from the first frame.
#[test]
fn errors_do_not_hang_on_the_clock() {
    let folder = tempfile::tempdir().expect("a folder");
    let drive = folder.path().join("drive.1");
    let mut command = kapvik();
    command.args(["simulate", "--scenario", "spread", "--seed", "3", "--duration", "20", "-o"]).arg(&drive);
    command.assert().success();
    // What stands behind a full stop belongs to the name, unless it is csv.
    let truth = folder.path().join("drive.1.truth.csv");
    let errors = || {
        let mut command = kapvik();
        command.args(["run", "--on", "host"]).arg(&drive).arg("--report").arg(folder.path().join("out.html"));
        let told = told(&mut command);
        let (_, table) = told.split_once("estimates against the truth").expect("a table of errors");
        table.split("raw sensors:").next().expect("the table").to_owned()
    };
    let from_zero = errors();
    for path in [&drive, &truth] {
        let text = fs::read_to_string(path).expect("written");
        let later = |line: &str| match line.split_once(',').map(|(time, rest)| (time.parse::<f64>(), rest)) {
            Some((Ok(time_s), rest)) => format!("{:.6},{rest}\n", time_s + 1000.0),
            _ => format!("{line}\n"),
        };
        fs::write(path, text.lines().map(later).collect::<String>()).expect("written");
    }
    assert_eq!(errors(), from_zero);
}

#[test]
fn an_output_that_was_there_stays_where_the_frames_are_bad() {
    let case = Case::with(Some((62, row("6", "abc", 5))));
    fs::write(case.path("out.csv"), "before").expect("written");
    case.command("replay").args(["frames.csv", "-o", "out.csv"]).assert().failure();
    assert_eq!(fs::read_to_string(case.path("out.csv")).expect("readable"), "before");
}

#[test]
fn the_report_of_a_recording_needs_nothing_else() {
    let case = Case::with(None);
    let report = |name: &str| {
        case.command("run").args(["frames.csv", "--report", name, "--picture", "picture.svg"]).assert().success();
        fs::read_to_string(case.path(name)).expect("written")
    };
    let html = report("one.html");
    assert!(html == report("two.html"), "a run repeats itself to the bit");
    is_self_contained(&html);
    for words in
        ["frames.csv", "recorded sensor frames", "rover assumed (set K0)", "Drawbar pull", "What to keep in mind"]
    {
        assert!(html.contains(words), "{words} is missing");
    }
    is_a_picture(&fs::read_to_string(case.path("picture.svg")).expect("written"));
}

#[test]
fn the_table_that_is_frozen_in_flies_at_once_and_a_damaged_one_not_at_all() {
    let case = Case::with(None);
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/../firmware/weights/kapvik.table");
    case.command("replay").args(["frames.csv", "-o", "plain.csv"]).assert().success();
    let said = told(case.command("replay").args(["frames.csv", "-o", "out.csv", "--weights", table]));
    assert!(said.contains("kapvik.table, trained with none: equations 1-11"), "{said}");
    assert_eq!(
        fs::read(case.path("out.csv")).expect("estimates"),
        fs::read(case.path("plain.csv")).expect("estimates")
    );
    let text = fs::read_to_string(table).expect("the table");
    fs::write(case.path("damaged.table"), text.replacen("note seed: 1", "note seed: 2", 1)).expect("written");
    case.is_refused(&["frames.csv", "--weights", "damaged.table"], &["damaged.table", "altered"]);
}
