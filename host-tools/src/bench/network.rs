//! How good the frozen rover network is on cases that it has not seen, through the functions that fly.

use kapvik_firmware::frozen;
use kapvik_firmware::network::{Posterior, TARGETS};
use kapvik_firmware::wheel_state::SoilQuery;

use crate::error::HostError;
use crate::train::scene::{Design, scenes, scenes_in};
use crate::train::score::{
    Score, TargetScore, rover_posterior as rover_posterior_of, score_rover as score_rover_table,
};
use crate::train::world::World;

/// The posterior of ln c, φ, ln K that the frozen rover network gives for a query.
pub fn rover_posterior(query: &SoilQuery) -> Posterior {
    rover_posterior_of(&frozen::ROVER, query)
}

/// The mean of [`rover_posterior`].
pub fn rover_mean(query: &SoilQuery) -> [f64; TARGETS] {
    rover_posterior(query).map(|marginal| f64::from(marginal.mean))
}

/// The cases that are reported, by name.
const DESIGNS: [(&str, Design); 5] = [
    ("one instant", Design::Kapvik { instants: 1, sinkage: true }),
    ("one instant, no sinkage", Design::Kapvik { instants: 1, sinkage: false }),
    ("mean of 100", Design::Kapvik { instants: 100, sinkage: true }),
    ("mean of 100, no sinkage", Design::Kapvik { instants: 100, sinkage: false }),
    ("all wheels, loads, noises", Design::Training),
];

/// The cases on patchy ground that are reported, by name: what is to be told is the mean over the wheels.
const PATCHY_DESIGNS: [(&str, Design); 2] = [
    ("one instant, patches", Design::Kapvik { instants: 1, sinkage: true }),
    ("mean of 100, patches", Design::Kapvik { instants: 100, sinkage: true }),
];

/// Scores the frozen rover network on `cases` unseen cases of a design.
pub fn score_rover(design: Design, cases: usize, seed: u32) -> Score {
    score_rover_table(&frozen::ROVER, &scenes(design, cases, seed), seed)
}

/// The same where the wheels of every case stand on several soils.
///
/// # Errors
/// Where next to no soils carry the wheels.
pub fn score_rover_on_patches(design: Design, cases: usize, seed: u32) -> Result<Score, HostError> {
    let scenes = scenes_in(&World::seed().with_patches(1.0), design, cases, seed)?;
    Ok(score_rover_table(&frozen::ROVER, &scenes, seed))
}

/// Prints errors and coverage for every design.
///
/// # Errors
/// As [`score_rover_on_patches`].
pub fn print(cases: usize, seed: u32) -> Result<(), HostError> {
    println!("Rover network, {cases} unseen cases a row (seed {seed}); c log-uniform 50–3000 Pa, φ 22–42°, K 5–35 mm");
    println!(
        "  {:26} {:>8} {:>8} {:>9} {:>8} {:>8}   coverage of the 68 % | 95 % interval (c φ K)   within 1 | 1.96 σ (c φ K)",
        "", "φ RMSE/°", "K med./%", "ln K RMSE", "R² ln c", "R² φ"
    );
    for (name, design) in DESIGNS {
        print_row(name, &score_rover(design, cases, seed));
    }
    for (name, design) in PATCHY_DESIGNS {
        print_row(name, &score_rover_on_patches(design, cases, seed)?);
    }
    Ok(())
}

fn print_row(name: &str, scores: &Score) {
    let [c, phi, k] = scores;
    let covered = |pick: fn(&TargetScore) -> f64| {
        scores.iter().map(|target| format!("{:5.1}", 100.0 * pick(target))).collect::<Vec<_>>().join(" ")
    };
    println!(
        "  {:26} {:>8.2} {:>8.1} {:>9.3} {:>8.3} {:>8.3}   {} | {}   {} | {}",
        name,
        phi.rmse.to_degrees(),
        100.0 * k.median_ratio_error,
        k.rmse,
        c.r_squared,
        phi.r_squared,
        covered(|target| target.interval_coverage[0]),
        covered(|target| target.interval_coverage[1]),
        covered(|target| target.std_coverage[0]),
        covered(|target| target.std_coverage[1])
    );
}
