//! `identify` on campaigns made by the equations, and on campaigns that are broken.

mod kapvik;
mod refused;
mod support;

use assert_cmd::assert::OutputAssertExt;
use kapvik::kapvik;
use kapvik_firmware::pipeline;
use kapvik_firmware::wheel_state::WheelNoise;
use kapvik_host::data::campaign::Campaign;
use kapvik_host::identify::{Document, identify};
use proptest::prelude::*;
use refused::refused;
use serde_json::Value;
use std::path::Path;
use support::{Made, TOML};

fn document(csv: &str, toml: &str) -> Result<Value, String> {
    let campaign = Campaign::parse(Path::new("made.csv"), csv, toml).map_err(|error| error.to_string())?;
    let identification =
        identify(&campaign, &mut |query| Ok(pipeline::answer(query))).map_err(|error| error.to_string())?;
    Ok(serde_json::to_value(Document::of(&campaign, &identification)).expect("a document is JSON"))
}

/// The shape that other programs rely on.
fn check_parameter(parameter: &Value) {
    for key in ["value", "std"] {
        let number = parameter[key].as_f64().unwrap_or_else(|| panic!("{key} of {parameter}"));
        assert!(number.is_finite() && number > 0.0, "{parameter}");
    }
    assert!(parameter["identifiable"].is_boolean(), "{parameter}");
    let end = |interval: &str, place: usize| parameter[interval][place].as_f64().expect("an end of an interval");
    let ordered = [end("interval_95", 0), end("interval_68", 0), end("interval_68", 1), end("interval_95", 1)];
    assert!(ordered.is_sorted(), "{parameter}");
}

#[test]
fn the_document_has_the_agreed_shape() {
    let csv = Made { runs: vec![("a", 1), ("b", 4)], ..Made::default() }.csv();
    let document = document(&csv, TOML).expect("identified");
    assert_eq!(document["method"], "network");
    let runs = document["runs"].as_array().expect("runs");
    assert_eq!(runs.iter().map(|run| run["run"].as_str().expect("a name")).collect::<Vec<_>>(), ["a", "b"]);
    for run in runs {
        assert!(run["refused"].is_null(), "{run}");
        assert!(run["condition_number"].as_f64().expect("a number") > 1.0);
        assert_eq!(run["outside_training_range"], false);
        assert_eq!(run["sinkage_used"], true);
        assert_eq!(run["wheels"].as_array().expect("wheels").len(), 6);
        for key in ["cohesion_pa", "friction_angle_rad", "shear_modulus_m"] {
            check_parameter(&run[key]);
            check_parameter(&run["without_sinkage"][key]);
            check_parameter(&run["wheels"][3][key]);
        }
    }
    assert_eq!((runs[0]["instants"].as_u64(), runs[0]["rows_used"].as_u64()), (Some(1), Some(6)));
    assert_eq!((runs[1]["instants"].as_u64(), runs[1]["rows_used"].as_u64()), (Some(4), Some(24)));
    assert_eq!(runs[1]["wheels"][0]["rows"], 4, "each wheel is the mean over the four instants");
}

/// The noise that the networks are told of a run of so many instants.
fn told(instants: usize) -> WheelNoise {
    let csv = Made { runs: vec![("a", instants)], ..Made::default() }.csv();
    let campaign = Campaign::parse(Path::new("made.csv"), &csv, TOML).expect("a campaign");
    let identification = identify(&campaign, &mut |query| Ok(pipeline::answer(query))).expect("identified");
    *identification.runs[0].question.as_ref().expect("asked").noise()
}

#[test]
fn the_networks_are_told_of_averaging_down_to_the_least_noise_that_they_know() {
    let (one, hundred, thousand) = (told(1), told(100), told(1000));
    assert_eq!((one.drawbar_pull_n, one.torque_nm, one.slip), (0.5, 0.05, 0.01));
    assert!((hundred.drawbar_pull_n - 0.05).abs() < 1e-6 && (hundred.sinkage_m - 0.000_2).abs() < 1e-8);
    // A thousand instants are told as four hundred: 1/20 of the flight sensors' noise, 0.01 in slip.
    assert!((thousand.slip - 0.000_5).abs() < 1e-8, "{thousand:?}");
}

#[test]
fn the_truth_lies_in_the_95_percent_interval_of_noise_free_states() {
    let made = Made { runs: vec![("a", 1)], noisy: false, ..Made::default() };
    let document = document(&made.csv(), TOML).expect("identified");
    for (key, truth) in [
        ("cohesion_pa", made.soil.cohesion_pa),
        ("friction_angle_rad", made.soil.friction_angle_rad),
        ("shear_modulus_m", made.soil.shear_modulus_m),
    ] {
        let interval = &document["runs"][0][key]["interval_95"];
        let (low, high) = (interval[0].as_f64().expect("low"), interval[1].as_f64().expect("high"));
        assert!((low..=high).contains(&truth), "{key}: {truth} not in {interval}");
    }
}

#[test]
fn a_lacking_column_is_named_and_a_lacking_value_leaves_the_row_out() {
    let csv = "run,t_s,slip,load_n,drawbar_pull_n\na,0,0.1,65,1\n";
    let error = document(csv, TOML).expect_err("no torque");
    assert!(error.starts_with("made.csv:1:1: no column torque_nm: the method network needs"), "{error}");
    let csv = "run,t_s,Slip,load_n,drawbar_pull_n,torque_nm\na,0,0.1,65,1,2\n";
    let error = document(csv, TOML).expect_err("no slip");
    assert!(error.contains("no column slip") && error.contains("a column `Slip` and none `slip`"), "{error}");
    let csv = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm\na,0,0.1,65,1,\nb,0,0.1,65,-1,1.3\nb,0,0.2,0,-1,1.3\n";
    let document = document(csv, TOML).expect("identified");
    let runs = document["runs"].as_array().expect("runs");
    assert_eq!(runs[0]["refused"], "no row can be used: no torque_nm (line 2)");
    assert!(runs[0]["cohesion_pa"].is_null() && runs[0]["condition_number"].is_null());
    assert!(runs[1]["refused"].is_null());
    assert_eq!(runs[1]["rows_left_out"][0]["line"], 4);
    assert_eq!(runs[1]["without_sinkage"], Value::Null);
}

/// The networks have learned no wheel that is braked: beside others one would only spoil what they say.
#[test]
fn a_braked_wheel_is_left_out_and_told_where_there_are_others() {
    let csv =
        "run,t_s,slip,load_n,drawbar_pull_n,torque_nm\na,0,0.1,65,-1,1.3\na,0,-0.2,65,-19,-0.5\nb,0,-0.2,65,-19,-0.5\n";
    let document = document(csv, TOML).expect("identified");
    let runs = document["runs"].as_array().expect("runs");
    let left_out = runs[0]["rows_left_out"].as_array().expect("rows");
    assert_eq!((runs[0]["rows_used"].as_u64(), left_out.len()), (Some(1), 1));
    assert_eq!(left_out[0]["line"], 3);
    assert!(left_out[0]["reason"].as_str().expect("a reason").contains("slips so little"));
    assert_eq!(runs[0]["outside_training_range"], false);
    assert_eq!((runs[1]["rows_used"].as_u64(), &runs[1]["outside_training_range"]), (Some(1), &Value::Bool(true)));
}

#[test]
fn noise_comes_from_the_file_else_from_repeats_else_from_the_flight_sensors() {
    let stated = document(&Made::default().csv(), TOML).expect("identified");
    assert_eq!(stated["noise"]["drawbar_pull_n"]["from"], "campaign");
    let bare = TOML.split("[noise]").next().expect("the part before the noise");
    let few = document(&Made { runs: vec![("a", 1)], ..Made::default() }.csv(), bare).expect("identified");
    assert_eq!(few["noise"]["drawbar_pull_n"]["from"], "flight-sensors");
    // 0.5 N at 65.4 N of load, the sensors that the prior states.
    let assumed = few["noise"]["drawbar_pull_n"]["std"].as_f64().expect("a number");
    assert!((assumed - 0.5).abs() < 0.05, "{assumed}");
    let csv = Made { runs: vec![("a", 60)], ..Made::default() }.csv();
    let many = document(&csv, bare).expect("identified");
    assert_eq!(many["noise"]["torque_nm"]["from"], "repeats");
    // 180 pairs: the estimate of 0.05 N·m has a standard deviation of 5 %; the slip's own noise adds at most 7 %.
    let found = many["noise"]["torque_nm"]["std"].as_f64().expect("a number");
    assert!((0.0425..0.0615).contains(&found), "{found}");
    assert_eq!(many["noise"]["slip"]["from"], "flight-sensors");
}

#[test]
fn the_command_writes_json_and_refuses_in_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("made.csv"), Made::default().csv()).expect("written");
    let command = |method: &str| {
        let mut command = kapvik();
        command.current_dir(folder.path()).args(["identify", "made.csv", "--method", method, "--json", "out.json"]);
        command
    };
    refused(&mut command("network"), &["made.toml: no such file"]);
    std::fs::write(folder.path().join("made.toml"), TOML).expect("written");
    command("network").assert().success();
    let text = std::fs::read_to_string(folder.path().join("out.json")).expect("written");
    let document: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(document["runs"].as_array().expect("runs").len(), 2);
    command("guess").assert().failure();
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// Whatever is cut out, put in or repeated: a document or a message of one line, and no NaN in the document.
    #[test]
    fn mangled_files_never_panic(
        in_table in any::<bool>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12, "[-0-9.eE,\\n\"=\\[\\]{}a-z ∞é]{0,6}"), 1..5),
    ) {
        let (mut csv, mut toml) = (Made { runs: vec![("a", 2)], ..Made::default() }.csv(), TOML.to_owned());
        let text = if in_table { &mut csv } else { &mut toml };
        for (place, removed, put) in edits {
            let mut characters: Vec<char> = text.chars().collect();
            let start = place.index(characters.len() + 1);
            let end = (start + removed).min(characters.len());
            characters.splice(start..end, put.chars());
            *text = characters.into_iter().collect();
        }
        match document(&csv, &toml) {
            Ok(document) => prop_assert!(document["runs"].as_array().is_some_and(|runs| !runs.is_empty())),
            Err(message) => prop_assert!(!message.is_empty() && !message.contains('\n'), "{message:?}"),
        }
    }
}
