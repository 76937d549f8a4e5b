//! `kapvik simulate` as a person runs it.

use std::fs;
use std::process::{Command, Output};
use std::time::Duration;

use super::kapvik::kapvik;
use super::refused::refused;
use kapvik_host::data::frame_file::FrameReader;
use kapvik_host::data::truth_file::{Truth, TruthReader};
use tempfile::TempDir;

/// A folder to simulate in.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = kapvik();
        command.current_dir(self.0.path()).arg("simulate").args(arguments);
        command
    }

    fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().expect("kapvik runs")
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.0.path().join(name)).expect("a file")
    }

    fn files(&self) -> usize {
        fs::read_dir(self.0.path()).expect("a folder").count()
    }
}

#[test]
fn frames_and_truth_stand_beside_each_other_and_repeat() {
    let folder = Folder::new();
    let arguments = ["--seed", "3", "--scenario", "level", "--duration", "6", "--rate", "20"];
    let output = folder.run(&[arguments.as_slice(), &["-o", "a.csv"]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("121 frames, 6 s") && said.contains("a.csv and a.truth.csv"), "{said}");
    assert!(folder.run(&[arguments.as_slice(), &["-o", "b.csv"]].concat()).status.success());
    assert_eq!(folder.text("a.csv"), folder.text("b.csv"));
    assert_eq!(folder.text("a.truth.csv"), folder.text("b.truth.csv"));
    assert_eq!(folder.files(), 4);
    let frames: Vec<_> = FrameReader::open(&folder.0.path().join("a.csv")).expect("frames").collect();
    let truths: Vec<_> = TruthReader::open(&folder.0.path().join("a.truth.csv")).expect("truths").collect();
    assert_eq!((frames.len(), truths.len()), (121, 121));
    for (frame, truth) in frames.into_iter().zip(truths) {
        assert_eq!(frame.expect("a frame").time_us, truth.expect("a truth").time_us);
    }
}

/// Where the sides stand on different soils both are told, and the truth of the soil is half-way between.
#[test]
fn the_right_side_may_stand_on_another_soil() {
    let folder = Folder::new();
    for (name, phi) in [("l.toml", 0.6), ("r.toml", 0.5)] {
        let soil = format!("n = 1.1\nk_phi = 2e6\nc = 300\nphi = {phi}\nK = 0.015\nc1 = 0.3\nc2 = 0.2\n");
        fs::write(folder.0.path().join(name), soil).expect("written");
    }
    let arguments = ["--seed", "3", "--scenario", "spread", "--duration", "3", "-o", "a.csv"];
    let output = folder.run(&[arguments.as_slice(), &["--soil", "l.toml", "--right-soil", "r.toml"]].concat());
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let told = "c = 300 Pa, phi = 34.4°, K = 15.0 mm (left), c = 300 Pa, phi = 28.6°, K = 15.0 mm (right)";
    assert!(output.status.success() && said.contains(told), "{said}{}", String::from_utf8_lossy(&output.stderr));
    let truths = TruthReader::open(&folder.0.path().join("a.truth.csv")).expect("truths");
    for truth in truths {
        let soil = truth.expect("a truth").soil;
        assert!((soil.friction_angle_rad - 0.55).abs() < 1e-9, "{soil:?}");
    }
    let output = folder.run(&["--seed", "3", "-o", "r.toml", "--right-soil", "r.toml"]);
    assert!(!output.status.success() && folder.text("r.toml").starts_with("n = 1.1"), "an input is not written over");
}

#[test]
fn what_a_rover_file_says_besides_is_named() {
    let folder = Folder::new();
    let rover = "mass_kg = 30.0\nmaker = \"NN\"\n[camera]\nheight_m = 0.5\n";
    fs::write(folder.0.path().join("r.toml"), rover).expect("written");
    let output =
        folder.run(&["--seed", "3", "-o", "a.csv", "--scenario", "level", "--duration", "2", "--rover", "r.toml"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    for expected in ["kapvik: r.toml:2:1: `maker` is not used\n", "kapvik: r.toml:3:2: `camera` is not used\n"] {
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn soils_rovers_effects_and_faults_can_be_asked_for() {
    let folder = Folder::new();
    fs::write(folder.0.path().join("r.toml"), "mass_kg = 30.0\n").expect("written");
    let output = folder.run(&[
        "--seed",
        "1",
        "-o",
        "a.csv",
        "--scenario",
        "level",
        "--duration",
        "30",
        "--rover",
        "r.toml",
        "--soil",
        "seed-table-1",
        "--then",
        "ice-cemented@0.45",
        "--effect",
        "force-bias=5",
        "--effect",
        "nan=gyro_*@2-3",
        "--effect",
        "skip-frames=@10-11",
    ]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let path = folder.0.path().join("a.truth.csv");
    let truths: Vec<_> = TruthReader::open(&path).expect("truths").map(|truth| truth.expect("a truth")).collect();
    assert_eq!(truths.len(), 301 - 11);
    assert_eq!(truths[0].wheels.left.front.soil.cohesion_pa, 250.0);
    assert_eq!(truths[truths.len() - 1].wheels.left.front.soil.cohesion_pa, 3250.0);
    let load: f64 = truths[0].wheels.iter_wheels().map(|wheel| wheel.normal_load_n).sum();
    assert!((load - 30.0 * 9.81).abs() < 1.0e-6);
    let frames = folder.text("a.csv");
    assert_eq!(frames.lines().filter(|line| line.contains("NaN")).count(), 11);
}

/// What is refused, with what the one line on the error stream starts; nothing is left behind.
#[test]
fn mistakes_are_told_in_one_line_and_leave_nothing_behind() {
    let rovers = [
        ("[suspension]\nfront_hub = [-0.1, -0.2]\n", "r.toml:2:13: the hubs are out of order"),
        ("mass_kg = heavy\n", "r.toml:1:11: "),
        ("maker = \"NN\"\nmass_kg = \"heavy\"\n", "r.toml:2:11: invalid type"),
    ];
    for (rover, expected) in rovers {
        let folder = Folder::new();
        fs::write(folder.0.path().join("r.toml"), rover).expect("written");
        is_refused(&folder, &["--rover", "r.toml"], expected);
    }
    let cases: [(&[&str], &str); 23] = [
        (&["--rover", "none.toml"], "none.toml: "),
        (&["--soil", "butter"], "butter: expected a file S.toml, or a soil of the catalogue: seed-table-1,"),
        (&["--soil", "none.toml"], "none.toml: "),
        (&["--soil", "lete-sand", "--then", "ice"], "--then ice: expected SOIL@METRES"),
        (&["--then", "ice@far"], "--then ice@far: expected SOIL@METRES"),
        (
            &["--effect", "slip-sinking=0.3"],
            "--effect slip-sinking=0.3: no effect is named `slip-sinking`: expected one of slip-sinkage",
        ),
        (&["--effect", "latency"], "--effect latency: expected ID=VALUE"),
        (&["--effect", "latency=late"], "--effect latency=late: `late`: expected a number"),
        (&["--effect", "interface-friction=abc"], "--effect interface-friction=abc: `abc`: expected a number"),
        (&["--effect", "multi-pass.m2=x"], "--effect multi-pass.m2=x: `x`: expected a number"),
        (&["--effect", "nan=load@1-2"], "--effect nan=load@1-2: `load`: expected a column"),
        (&["--effect", "nan=gyro_*"], "--effect nan=gyro_*: `gyro_*`: expected SENSOR@T1-T2"),
        (
            &["--duration", "10", "--effect", "skip-frames=@0-10"],
            "--effect skip-frames: expected one that leaves a frame",
        ),
        (
            &["--effect", "skip-frames=gyro_*@0-1"],
            "--effect skip-frames=gyro_*@0-1: `gyro_*@0-1`: expected @T1-T2, which is of whole frames",
        ),
        (&["--effect", "foo\nbar=1"], r"--effect foo\nbar=1: no effect is named `foo\nbar`: expected one of"),
        (&["--effect", "foo\nbar"], r"--effect foo\nbar: expected ID=VALUE"),
        (&["--then", "x\ny@z"], r"--then x\ny@z: expected SOIL@METRES"),
        (
            &["--effect", "nan=gyro_*@3.31-3.39"],
            "--effect: a fault from 3.31 s to 3.39 s: expected one that a frame falls in, of 10 a second",
        ),
        (&["--effect", "latency=1", "--effect", "latency=2"], "--effect latency=2: `latency` is given twice"),
        (
            &["--effect", "slip-sinkage=0.3", "--effect", "slip-sinkage.n1=0.5"],
            "--effect slip-sinkage.n1=0.5: it sets what `slip-sinkage` has set: expected one of the two",
        ),
        (
            &["--effect", "shear-hump.share=0.5", "--effect", "shear-hump=0.6"],
            "--effect shear-hump=0.6: it sets what `shear-hump.share` has set",
        ),
        (
            &["--effect", "drive-friction.viscous_nm_s=0.1", "--effect", "drive-viscosity=0.2"],
            "--effect drive-viscosity=0.2: it sets what `drive-friction.viscous_nm_s` has set",
        ),
        (&["--scenario", "slope", "--soil", "snow-us"], "the rover does not stand on all its wheels"),
    ];
    for (arguments, expected) in cases {
        is_refused(&Folder::new(), arguments, expected);
    }
}

/// On level ground, where other simulations stop; this soil answers each slip, but never with a pull.
#[test]
fn a_rover_that_slides_back_is_stuck() {
    let folder = Folder::new();
    let drive = ["--scenario", "level", "--duration", "15", "--soil", "dry-sand-iagnemma"];
    let said = refusal(&folder, &drive);
    assert!(said.starts_with("kapvik: at ") && said.contains(" m from the start, the rover slides back"), "{said}");
}

/// The one line that a drive says that fails.
fn refusal(folder: &Folder, arguments: &[&str]) -> String {
    let mut command = folder.command(&["--seed", "1", "-o", "a.csv"]);
    let output = refused(command.args(arguments), &[]);
    String::from_utf8(output.stderr).expect("text")
}

fn is_refused(folder: &Folder, arguments: &[&str], expected: &str) {
    let said = refusal(folder, arguments);
    assert!(said.starts_with(&format!("kapvik: {expected}")), "{arguments:?}: {said}");
}

#[test]
fn no_drive_has_more_frames_than_can_be_counted() {
    for (option, number, most) in [("--duration", "1e30", "10000000"), ("--rate", "1e9", "1000")] {
        let folder = Folder::new();
        let output = folder.run(&["--seed", "1", "-o", "a.csv", option, number]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && said.contains(&format!("at most {most}")), "{option} {number}: {said}");
        assert_eq!(folder.files(), 0, "{option} {number} left something behind");
    }
}

#[test]
fn what_was_there_survives_a_refusal() {
    let folder = Folder::new();
    fs::write(folder.0.path().join("a.csv"), "before").expect("written");
    is_refused(&folder, &["--scenario", "slope", "--soil", "snow-us"], "the rover does not stand on all its wheels");
    assert_eq!(folder.text("a.csv"), "before");
}

#[test]
fn a_soil_that_is_driven_onto_is_not_overwritten() {
    let folder = Folder::new();
    let soil = "n = 1.1\nk_phi = 2e6\nc = 300\nphi = 0.5\nK = 0.015\nc1 = 0.3\nc2 = 0.2\n";
    fs::write(folder.0.path().join("s.toml"), soil).expect("written");
    let output = folder.run(&["--seed", "1", "--then", "s.toml@2", "-o", "s.toml"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && said.contains("the output is the input"), "{said}");
    assert_eq!((folder.text("s.toml").as_str(), folder.files()), (soil, 1));
}

/// Ended by `kill` while it writes.
#[cfg(unix)]
#[test]
fn a_drive_that_is_ended_early_leaves_nothing_behind() {
    use std::os::unix::process::ExitStatusExt;

    let folder = Folder::new();
    let arguments = ["simulate", "--seed", "3", "--scenario", "level", "--duration", "100000", "-o", "a.csv"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_kapvik"));
    let mut drive = command.current_dir(folder.0.path()).args(arguments).spawn().expect("kapvik runs");
    while folder.files() < 2 {
        assert!(drive.try_wait().expect("known").is_none(), "the drive came to its end");
        std::thread::sleep(Duration::from_millis(10));
    }
    let killed = Command::new("kill").arg(drive.id().to_string()).status().expect("kill runs");
    assert!(killed.success());
    assert_eq!(drive.wait().expect("ended").signal(), Some(15));
    assert_eq!(folder.files(), 0, "something is left behind");
}

/// Ahead over hills for 40 s, and back for as long: on loose ground a rover does not come back to the millimetre. Every frame is in balance, or
/// there would be no file.
#[test]
fn a_rover_that_turns_back_comes_near_its_start() {
    let folder = Folder::new();
    let drive = ["--seed", "2", "--scenario", "hills", "--duration", "81"];
    let run = |name: &str, turn_back: &[&str]| {
        let output = folder.run(&[drive.as_slice(), turn_back, &["-o", name]].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let truths = TruthReader::open(&folder.0.path().join(name).with_extension("truth.csv")).expect("truths");
        truths.map(|truth| truth.expect("a truth")).collect::<Vec<_>>()
    };
    let (ahead, back) = (run("ahead.csv", &[]), run("back.csv", &["--turn-back", "41"]));
    assert!(ahead[..=400] == back[..=400], "up to then it is the same drive");
    let farthest = back.iter().max_by(|a, b| a.x_m.total_cmp(&b.x_m)).expect("frames");
    assert!(farthest.x_m > 0.8 && (40_000_000..43_000_000).contains(&farthest.time_us), "{farthest:?}");
    let last = back.last().expect("frames");
    assert!(last.x_m.abs() < 0.1 * farthest.x_m && ahead[810].x_m > 1.6, "{last:?}");
    // Wheels that back up and drive have a slip above zero as well.
    let slips: Vec<f64> = back[500..800].iter().filter_map(|truth| truth.wheels.left.rear.slip).collect();
    assert!(slips.len() == 300 && slips.iter().sum::<f64>() > 0.0, "{slips:?}");
    let backs_up = |truth: &&Truth| truth.x_m < farthest.x_m - 0.1 && truth.time_us > farthest.time_us;
    let near = |truth: &Truth| {
        let same = ahead.iter().min_by(|a, b| (a.x_m - truth.x_m).abs().total_cmp(&(b.x_m - truth.x_m).abs()));
        same.is_some_and(|same| {
            (same.z_m - truth.z_m).abs() < 1.0e-3 && (same.pitch_rad - truth.pitch_rad).abs() < 0.01
        })
    };
    assert!(back.iter().filter(backs_up).all(near), "over the ground that it came by");
}
