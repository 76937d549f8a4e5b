//! `identify --method map` on campaigns without torque, or without drawbar pull: what is left tells the soil less well, and says so.

mod described;
mod drawn;
#[path = "../../firmware/tests/support/six_slips.rs"]
mod six_slips;

use std::path::Path;

use described::{COLUMNS, description};
use drawn::{Held, KEYS, Plan};
use kapvik_host::data::campaign::Campaign;
use kapvik_host::identify::{Document, Method, identify_by};
use kapvik_host::prior::KAPVIK_INSTANT_NOISE;
use serde_json::Value;
use six_slips::SIX_SLIPS;

const SOILS: usize = 60;
/// Of sixty cases with a chance of 95 % each, fewer are in one of a thousand sets.
const LEAST: usize = 50;

/// How many of the runs tell c, φ and K, where such columns are not there.
fn told_without(lacking: &'static [&'static str], remark: &str) -> [usize; 3] {
    let plan = Plan { lacking, ..Plan::of(&SIX_SLIPS, &[45.0, 65.0, 90.0], 30) };
    let (campaign, soils) = plan.campaign(SOILS, 97);
    let document = identify_by(Method::Map, &campaign).expect("identified");
    let held = Held::of(&document, &soils);
    println!("without {lacking:?}, of {SOILS}: within 2 σ and 95 % {held:?}");
    for ([_, in_interval], key) in held.within.into_iter().zip(KEYS) {
        assert!(in_interval >= LEAST, "{key}: {in_interval} of {SOILS} in the 95 % interval");
    }
    assert_eq!(
        document.warnings().iter().filter(|warning| warning.as_str() == remark).count(),
        usize::from(!remark.is_empty())
    );
    let document = serde_json::to_value(&document).expect("JSON");
    let is_told = |run: &&Value, key: &str| run[key]["identifiable"] == true;
    let runs = document["runs"].as_array().expect("runs");
    KEYS.map(|key| runs.iter().filter(|run| is_told(run, key)).count())
}

#[test]
fn either_of_pull_and_torque_tells_the_soil_and_both_tell_more() {
    let all = told_without(&[], "");
    let by_pull =
        told_without(&["torque_nm"], "no torque_nm: the strength of the soil is told by drawbar_pull_n alone");
    let by_torque =
        told_without(&["drawbar_pull_n"], "no drawbar_pull_n: the strength of the soil is told by torque_nm alone");
    println!(
        "c, φ and K are told in {all:?} of {SOILS} runs, by pulls alone in {by_pull:?}, by torques alone in {by_torque:?}"
    );
    for one in [by_pull, by_torque] {
        assert!(one.iter().zip(all).all(|(one, all)| *one <= all), "{one:?} {all:?}");
        assert!(one[1] >= 1 && one[2] >= SOILS / 2, "{one:?}");
    }
}

fn identified(rows: &[&str]) -> Result<Document, String> {
    let toml = description("Made", "", Some(&KAPVIK_INSTANT_NOISE));
    let csv = format!("{COLUMNS}\n{}\n", rows.join("\n"));
    let campaign = Campaign::parse(Path::new("made.csv"), &csv, &toml).map_err(|error| error.to_string())?;
    identify_by(Method::Map, &campaign).map_err(|error| error.to_string())
}

/// A row without either is left out; one without one of them is a row.
#[test]
fn a_row_counts_that_has_either() {
    let document =
        identified(&["a,0,0.2,65,5.0,,0.010", "a,1,0.3,65,,2.6,0.012", "a,2,0.4,65,,,0.014"]).expect("identified");
    assert!(document.warnings().is_empty(), "both columns are there: {:?}", document.warnings());
    let document = serde_json::to_value(&document).expect("JSON");
    let run = &document["runs"][0];
    assert_eq!((&run["rows_used"], &run["refused"]), (&2.into(), &Value::Null), "{run}");
    assert_eq!(run["rows_left_out"][0]["line"], 4);
    assert_eq!(run["rows_left_out"][0]["reason"], "no drawbar_pull_n or torque_nm");
}

#[test]
fn a_campaign_without_both_is_refused_at_its_header() {
    let toml = description("Made", "", Some(&KAPVIK_INSTANT_NOISE));
    let campaign = Campaign::parse(Path::new("made.csv"), "run,t_s,slip,load_n,sinkage_m\na,0,0.2,65,0.01\n", &toml)
        .expect("a campaign");
    let error = identify_by(Method::Map, &campaign).expect_err("no strength is told").to_string();
    let expected = "made.csv:1:1: no column drawbar_pull_n or torque_nm: the method map needs slip, load_n, and drawbar_pull_n or torque_nm";
    assert_eq!(error, expected);
}
