//! How good the frozen rover network is on cases that it has not seen, through the functions that fly.

use kapvik_firmware::frozen;
use kapvik_firmware::network::{Posterior, TARGETS};
use kapvik_firmware::wheel_state::SoilQuery;

use crate::train::scene::{Design, scenes};
use crate::train::score::{
    Score, TargetScore, rover_posterior as rover_posterior_of, score_rover as score_rover_table,
};

/// The posterior of ln c, φ, ln K that the frozen rover network gives for a query.
pub fn rover_posterior(query: &SoilQuery) -> Posterior {
    rover_posterior_of(&frozen::ROVER, query)
}

/// The mean of [`rover_posterior`].
pub fn rover_mean(query: &SoilQuery) -> [f64; TARGETS] {
    rover_posterior(query).map(|marginal| f64::from(marginal.mean))
}

/// The cases that are reported, by name.
pub const DESIGNS: [(&str, Design); 5] = [
    ("one instant", Design::Kapvik { instants: 1, sinkage: true }),
    ("one instant, no sinkage", Design::Kapvik { instants: 1, sinkage: false }),
    ("mean of 100", Design::Kapvik { instants: 100, sinkage: true }),
    ("mean of 100, no sinkage", Design::Kapvik { instants: 100, sinkage: false }),
    ("all wheels, loads, noises", Design::Training),
];

/// Scores the frozen rover network on `cases` unseen cases of a design.
pub fn score_rover(design: Design, cases: usize, seed: u32) -> Score {
    score_rover_table(&frozen::ROVER, &scenes(design, cases, seed), seed)
}

/// Prints errors and coverage for every design.
pub fn print(cases: usize, seed: u32) {
    println!("Rover network, {cases} unseen cases a row (seed {seed}); c log-uniform 50–3000 Pa, φ 22–42°, K 5–35 mm");
    println!(
        "  {:26} {:>8} {:>8} {:>9} {:>8} {:>8}   coverage of the 68 % | 95 % interval (c φ K)   within 1 | 1.96 σ (c φ K)",
        "", "φ RMSE/°", "K med./%", "ln K RMSE", "R² ln c", "R² φ"
    );
    for (name, design) in DESIGNS {
        let scores = score_rover(design, cases, seed);
        let [c, phi, k] = &scores;
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
}
