//! `kapvik diagnose` on campaigns that are broken, or that say little: one line that names the place and nothing left behind;
//! or a diagnosis that states its limits, and finds no effect where none is.

mod columns;
mod kapvik;
mod refused;
#[path = "columns/without.rs"]
mod without;

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use assert_cmd::assert::OutputAssertExt;
use columns::COLUMNS;
use kapvik::kapvik;
use kapvik_firmware::terramechanics::{Soil, Wheel, sinkage_for_load, wheel_forces};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use refused::refused;
use serde_json::Value;
use without::without;

const TOML: &str = "\
name = \"Made by the equations\"
kind = \"simulated\"
source = \"equations 1–11\"
gravity_m_s2 = 9.81
[wheel]
radius_m = 0.1
width_m = 0.1
[soil]
n = { value = 1.1, std = 0.05 }
[noise]
slip = 0.004
load_n = 0.5
drawbar_pull_n = 0.4
torque_nm = 0.04
sinkage_m = 0.0005
";

/// One wheel state, made by the equations alone: nothing is undeclared.
#[derive(Clone, Copy)]
struct State {
    slip: f64,
    load_n: f64,
}

fn soil() -> Soil<f64> {
    Soil {
        sinkage_exponent: 1.1,
        cohesive_modulus: 10.0e3,
        frictional_modulus: 1500.0e3,
        cohesion_pa: 300.0,
        friction_angle_rad: 0.55,
        shear_modulus_m: 0.012,
        peak_stress_c1: 0.2,
        peak_stress_c2: 0.3,
        rebound_ratio: 0.0,
    }
}

/// The table; the run of each row is by its place.
fn csv(states: &[State], run: impl Fn(usize) -> String) -> String {
    let wheel = Wheel { radius_m: 0.1, width_m: 0.1 };
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut blur = |value: f64, std: f64| {
        let normal: f64 = StandardNormal.sample(&mut random);
        value + std * normal
    };
    let mut csv = format!("{COLUMNS}\n");
    for (row, State { slip, load_n }) in states.iter().enumerate() {
        let sinkage = sinkage_for_load(&wheel, &soil(), *slip, *load_n).expect("the soil carries it");
        let forces = wheel_forces(&wheel, &soil(), *slip, sinkage).expect("forces");
        let (slip, load) = (blur(*slip, 0.004), blur(*load_n, 0.5));
        let (pull, torque) = (blur(forces.drawbar_pull_n, 0.4), blur(forces.torque_nm, 0.04));
        let sinkage = blur(sinkage, 0.0005);
        let run = run(row);
        writeln!(csv, "{run},{row},{slip:.5},{load:.4},{pull:.4},{torque:.5},{sinkage:.6}").expect("text");
    }
    csv
}

fn each_its_own(row: usize) -> String {
    format!("r{row:02}")
}

/// Sixteen states; slips over a range, loads at two levels.
fn varied() -> Vec<State> {
    let load_n = |row: usize| if row.is_multiple_of(2) { 60.0 } else { 100.0 };
    (0..16).map(|row| State { slip: 0.04 * row as f64, load_n: load_n(row) }).collect()
}

/// A folder with a campaign.
struct Case {
    folder: tempfile::TempDir,
}

impl Case {
    fn new(csv: &str) -> Self {
        let case = Self { folder: tempfile::tempdir().expect("a folder") };
        fs::write(case.path("made.csv"), csv).expect("written");
        fs::write(case.path("made.toml"), TOML).expect("written");
        case
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self) -> Command {
        let mut command = kapvik();
        let outputs = ["--json", "out.json", "--html", "out.html", "--declared", "out.toml"];
        command.current_dir(self.folder.path()).args(["diagnose", "made.csv"]).args(outputs);
        command
    }

    /// Fails with one line that has all of these words, and leaves no file.
    fn is_refused(&self, words: &[&str]) {
        refused(&mut self.command(), words);
    }

    /// Ends well, with what was written.
    fn diagnosis(&self) -> Value {
        self.command().assert().success();
        for name in ["out.html", "out.toml"] {
            assert!(self.path(name).is_file(), "{name}");
        }
        let text = fs::read_to_string(self.path("out.json")).expect("written");
        serde_json::from_str(&text).expect("JSON")
    }
}

/// The table with one column's numbers changed.
fn changed(csv: &str, place: usize, change: impl Fn(f64) -> f64) -> String {
    let line = |line: &str| {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        fields[place] = fields[place].parse().map_or(fields[place].clone(), |value: f64| change(value).to_string());
        fields.join(",")
    };
    csv.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

fn says(diagnosis: &Value, words: &str) {
    let caveats = diagnosis["caveats"].as_array().expect("caveats");
    assert!(caveats.iter().any(|caveat| caveat.as_str().is_some_and(|caveat| caveat.contains(words))), "{caveats:#?}");
}

/// Nothing is undeclared in these campaigns: whatever is found is a false alarm.
fn finds_no_effect(diagnosis: &Value) {
    assert_ne!(diagnosis["verdict"], "effect", "{diagnosis:#}");
    assert_eq!(diagnosis["effects"], Value::Array(Vec::new()));
    assert_eq!(diagnosis["force_channels"], Value::Array(Vec::new()));
}

#[test]
fn a_campaign_without_a_needed_column_is_refused() {
    let csv = csv(&varied(), each_its_own);
    // Noise is stated of columns that are gone: the table is what is named first, or the line of that noise.
    let refused = |names: &[&str], words: &[&str]| {
        let case = Case::new(&without(&csv, names));
        let stated = TOML.lines().filter(|line| !names.iter().any(|name| line.starts_with(name)));
        fs::write(case.path("made.toml"), stated.collect::<Vec<_>>().join("\n")).expect("written");
        case.is_refused(words);
    };
    refused(&["run"], &["made.csv:1:", "run"]);
    refused(&["t_s"], &["made.csv:1:", "t_s"]);
    refused(&["slip"], &["made.csv:1:", "slip"]);
    refused(&["load_n", "sinkage_m"], &["made.csv:1:", "load_n", "sinkage_m"]);
    refused(&["drawbar_pull_n", "torque_nm", "sinkage_m"], &["made.csv:1:", "drawbar_pull_n"]);
}

#[test]
fn numbers_in_other_units_are_refused_where_they_stand() {
    let csv = csv(&varied(), each_its_own);
    Case::new(&changed(&csv, 6, |sinkage_m| 1000.0 * sinkage_m)).is_refused(&["made.csv:2:7", "sinkage", "metres"]);
    // Slip in per cent: the first row beyond 1 in size is refused.
    Case::new(&changed(&csv, 2, |slip| 100.0 * slip)).is_refused(&["made.csv:", ":3", "slip from −1 to 1"]);
}

#[test]
fn text_in_place_of_a_number_is_refused_where_it_stands() {
    let csv = csv(&varied(), each_its_own);
    let lines: Vec<&str> = csv.lines().collect();
    let broken = [&lines[..3], &["r99,0,0.1,sixty,1,1,0.01"], &lines[3..]].concat().join("\n");
    Case::new(&broken).is_refused(&["made.csv:4:4", "sixty"]);
    Case::new(&format!("{COLUMNS}\n")).is_refused(&["made.csv:1:", "no rows"]);
}

#[test]
fn a_campaign_without_its_description_is_refused() {
    let case = Case::new(&csv(&varied(), each_its_own));
    fs::remove_file(case.path("made.toml")).expect("removed");
    case.is_refused(&["made.toml", "expected it beside"]);
}

#[test]
fn one_run_is_diagnosed_with_its_limit_stated() {
    let diagnosis = Case::new(&csv(&varied(), |_| "only".to_owned())).diagnosis();
    says(&diagnosis, "One run only");
    finds_no_effect(&diagnosis);
}

#[test]
fn equal_loads_leave_cohesion_and_friction_untold() {
    let equal: Vec<State> = varied().into_iter().map(|state| State { load_n: 80.0, ..state }).collect();
    let diagnosis = Case::new(&csv(&equal, each_its_own)).diagnosis();
    says(&diagnosis, "One load level");
    finds_no_effect(&diagnosis);
}

#[test]
fn constant_slip_is_no_effect() {
    let constant: Vec<State> = varied().into_iter().map(|state| State { slip: 0.3, ..state }).collect();
    let diagnosis = Case::new(&csv(&constant, each_its_own)).diagnosis();
    says(&diagnosis, "Constant slip");
    finds_no_effect(&diagnosis);
}
