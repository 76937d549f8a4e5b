//! Rows and noises that a method cannot take: what is left out of a run, and what a run is refused for.

use std::path::Path;

use kapvik_host::data::campaign::Campaign;
use kapvik_host::identify::{Method, identify_by};
use kapvik_host::report::identified;
use serde_json::Value;

const TOML: &str = "name = \"made\"\nkind = \"simulated\"\nsource = \"\"\ngravity_m_s2 = 9.81\n[wheel]\nradius_m = 0.075\n\
                    width_m = 0.07\n[noise]\ndrawbar_pull_n = 0.4\nload_n = 1.0\ntorque_nm = 0.03\nslip = 0.004\nsinkage_m = 0.0003\n";
/// Wheels under 40, 65 and 90 N (equations 1–11: c = 500 Pa, φ = 0.55, K = 12 mm, n = 1, k = 2 MPa/m, c₁ = 0.3, c₂ = 0.15).
const ROWS: [&str; 6] = [
    "a,0,0.1,40,-2.82636,0.573829,0.0124454",
    "a,1,0.2,65,-0.32111,1.481086,0.0171022",
    "a,2,0.3,90,3.09673,2.564723,0.0211564",
    "a,3,0.4,40,3.53043,1.060977,0.0125272",
    "a,4,0.5,65,6.65112,2.030777,0.0172753",
    "a,5,0.6,90,9.13191,3.073887,0.0214829",
];

fn csv(more: &str) -> String {
    format!("run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m\n{}\n{more}", ROWS.join("\n"))
}

fn campaign(more: &str, toml: &str) -> Campaign {
    Campaign::parse(Path::new("made.csv"), &csv(more), toml).expect("a campaign")
}

fn run(method: Method, campaign: &Campaign) -> Value {
    serde_json::to_value(identify_by(method, campaign).expect("identified")).expect("JSON")["runs"][0].clone()
}

const OF_A_CONTACT: [Method; 4] = [Method::Ding, Method::DingBounded, Method::Iagnemma, Method::Hutangkabodee];

#[test]
fn a_row_without_contact_is_left_out_by_methods_that_need_one() {
    let with = campaign("a,6,0.15,50,30,0.3,0\n", TOML);
    let without = campaign("", TOML);
    for method in OF_A_CONTACT {
        let (with, without) = (run(method, &with), run(method, &without));
        assert_eq!(with["rows_left_out"][0]["line"], 8, "{with}");
        assert_eq!(with["friction_angle_rad"], without["friction_angle_rad"], "{}", method.name());
        assert_eq!(with["refused"], without["refused"], "{}", method.name());
    }
    let told = identified(&identify_by(Method::Iagnemma, &with).expect("identified"));
    assert!(told.contains("1 row left out: sinkage_m is not above 0"), "{told}");
}

#[test]
fn noise_of_zero_refuses_none_but_who_weighs_by_it() {
    let refused = |method: Method, channel: &str| {
        let toml: Vec<String> = TOML
            .lines()
            .map(|line| if line.starts_with(channel) { format!("{channel} = 0") } else { line.to_owned() })
            .collect();
        run(method, &campaign("", &(toml.join("\n") + "\n")))["refused"].as_str().map(str::to_owned)
    };
    for (method, channel) in [
        (Method::Iagnemma, "drawbar_pull_n"),
        (Method::Iagnemma, "torque_nm"),
        (Method::Ray, "sinkage_m"),
        (Method::Hutangkabodee, "torque_nm"),
        (Method::Map, "slip"),
        (Method::Ray, "load_n"),
        (Method::Ding, "slip"),
    ] {
        assert_eq!(refused(method, channel), refused(method, "none"), "{} at {channel} = 0", method.name());
    }
    for (method, channel) in [(Method::Map, "sinkage_m"), (Method::Hutangkabodee, "drawbar_pull_n")] {
        let said = refused(method, channel).expect("a reason");
        assert!(said.contains(&format!("the noise of {channel} is 0")), "{}: {said}", method.name());
    }
}
