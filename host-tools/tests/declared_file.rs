//! The model that a diagnosis ends with, as a file: read back, it is that model.

use std::path::Path;

use kapvik_host::data::campaign::{Campaign, Declared, Knowledge};
use kapvik_host::diagnose::declared_file;
use kapvik_host::diagnose::document::Diagnosis;

const CSV: &str = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m\n\
    a,0,0.1,65,5,1.2,0.010\na,0,0.3,66,12,1.9,0.014\nb,0,0.2,65,9,1.6,0.012\n";
const TOML: &str = "name = \"sand\"\nkind = \"measured\"\nsource = \"made up\"\ngravity_m_s2 = 9.81\n\
    [wheel]\nradius_m = 0.075\nwidth_m = 0.070\n";

/// What is declared once slip-sinkage, n1 = 0.30 ± 0.03, has been found in a campaign that declares this.
fn declared_after(declared: &str) -> Declared {
    let campaign = Campaign::parse(Path::new("sand.csv"), CSV, &format!("{TOML}{declared}")).expect("a campaign");
    let json = r#"{ "campaign": "sand", "declared": [], "verdict": "effect",
        "declared_effects": [ { "id": "load-stiffening", "form": "exponent", "parameters": {
            "exponent": {"value": 0.2, "std": 0.1}, "reference_load_n": {"value": 65.5, "std": 0.0} } } ],
        "effects": [ { "id": "slip-sinkage", "form": "exponent", "parameters": {"n1": {"value": 0.3, "std": 0.03}},
                       "gain_per_row": 1.2, "p_value": 1e-9 } ],
        "runner_up": null, "ambiguous_with": [], "unexplained": [], "channels": {},
        "soil_before": {}, "soil_after": {}, "held_out_runs": ["a"] }"#;
    let diagnosis: Diagnosis = serde_json::from_str(json).expect("a diagnosis");
    let text = declared_file(&campaign, &diagnosis);
    Declared::parse(Path::new("declared.toml"), &text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn n1(declared: &Declared) -> Option<Knowledge> {
    let effect = declared.effects.iter().find(|effect| effect.info.id == "slip-sinkage")?;
    effect.known.get("n1").copied()
}

#[test]
fn what_was_declared_stays_beside_what_was_found() {
    let declared = declared_after("[declared]\neffects = [\"rear-contact\"]\n[declared.rear-contact]\neta = 0.1\n");
    assert_eq!(declared.ids(), ["rear-contact", "slip-sinkage"]);
    assert_eq!(n1(&declared), Some(Knowledge::Value { value: 0.3, std: 0.03 }));
}

/// A campaign may have been told of an effect after its diagnosis: it stands in the file once, as it was found.
#[test]
fn what_was_declared_and_found_stands_there_once() {
    let declared = declared_after(
        "[declared]\neffects = [\"slip-sinkage\", \"rear-contact\"]\n[declared.slip-sinkage]\nstretch = 0.2\n",
    );
    assert_eq!(declared.ids(), ["rear-contact", "slip-sinkage"]);
    assert_eq!(n1(&declared), Some(Knowledge::Value { value: 0.3, std: 0.03 }));
    assert!(declared.effects.iter().all(|effect| !effect.known.contains_key("stretch")));
}

/// A declared effect whose form was open flies in the form that was diagnosed, about the load at which it does nothing there.
#[test]
fn what_was_declared_has_the_form_that_was_fitted() {
    let declared = declared_after("[declared]\neffects = [\"load-stiffening\"]\n");
    let effect = declared.effects.iter().find(|effect| effect.info.id == "load-stiffening").expect("it was declared");
    assert_eq!(effect.form.map(|form| form.name), Some("exponent"));
    assert_eq!(effect.known.get("reference_load_n"), Some(&Knowledge::Value { value: 65.5, std: 0.0 }));
    let stated = "[declared]\neffects = [\"load-stiffening\"]\n[declared.load-stiffening]\nform = \"stiffness\"\n\
        reference_load_n = 50.0\n";
    let declared = declared_after(stated);
    let effect = declared.effects.iter().find(|effect| effect.info.id == "load-stiffening").expect("it was declared");
    assert_eq!(effect.form.map(|form| form.name), Some("stiffness"), "what the campaign says stays");
    assert_eq!(effect.known.get("reference_load_n"), Some(&Knowledge::Value { value: 50.0, std: 0.0 }));
}
