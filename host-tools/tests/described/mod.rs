//! Simulated campaigns of Kapvik's wheel as text.

#[path = "../columns/mod.rs"]
mod columns;

use kapvik_firmware::wheel_state::{WheelNoise, WheelState};

pub use columns::COLUMNS;

/// The description, with what else is known, in tables of TOML, and the noise where it is stated.
pub fn description(name: &str, tables: &str, noise: Option<&WheelNoise<f64>>) -> String {
    let noise = noise.map_or(String::new(), |noise| {
        let WheelNoise { drawbar_pull_n, load_n, torque_nm, slip, sinkage_m } = noise;
        format!(
            "[noise]\ndrawbar_pull_n = {drawbar_pull_n:?}\nload_n = {load_n:?}\ntorque_nm = {torque_nm:?}\nslip = {slip:?}\n\
             sinkage_m = {sinkage_m:?}\n"
        )
    });
    format!(
        "name = \"{name}\"\nkind = \"simulated\"\nsource = \"equations 1–11\"\ngravity_m_s2 = 9.81\n\
         [wheel]\nradius_m = 0.075\nwidth_m = 0.070\n{tables}{noise}"
    )
}

/// What is read of a state whose sinkage is seen: [`COLUMNS`] from the slip on.
pub fn readings(state: &WheelState<f64>) -> String {
    let WheelState { slip, load_n, drawbar_pull_n, torque_nm, sinkage_m } = state;
    let sinkage_m = sinkage_m.expect("simulated");
    format!("{slip:.6},{load_n:.4},{drawbar_pull_n:.5},{torque_nm:.6},{sinkage_m:.7}")
}
