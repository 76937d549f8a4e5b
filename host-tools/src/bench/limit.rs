//! How near an estimator comes to the posterior mean, which none can beat.

use clap::{Args, ValueEnum};
use kapvik_firmware::wheel_state::SoilQuery;

use crate::error::HostError;
use crate::limit::accuracy::Errors;
use crate::limit::calibration::{distance_bound, distance_from_uniform};
use crate::limit::case::{Case, KAPVIK_LOADS, cases};
use crate::limit::coordinates::Targets;
use crate::limit::summary::EFFORT;
use crate::progress::bar;
use crate::statistics::{Measured, root_mean_square};
use crate::train::dataset::prior_scale;
use crate::train::scene::Design;

/// An estimator of ln c (c in Pa), φ (rad) and ln K (K in m).
pub type Estimator<'a> = dyn Fn(&SoilQuery) -> Targets + 'a;

/// Options of `kapvik bench limit`.
#[derive(Debug, Clone, Args)]
pub struct LimitArguments {
    /// Observations at each noise level
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub cases: u32,
    /// Seed of soils, noise and sampling; training uses 1, and 4294967294 for its check
    #[arg(long, default_value_t = 2026)]
    pub seed: u32,
    /// Whether the sinkage is seen
    #[arg(long, value_enum, default_value_t = Sinkage::Seen)]
    pub sinkage: Sinkage,
}

/// Whether the sinkage is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Sinkage {
    /// It is.
    Seen,
    /// It is not.
    Unseen,
    /// One after the other.
    Both,
}

impl Sinkage {
    fn each(self) -> &'static [bool] {
        match self {
            Self::Seen => &[true],
            Self::Unseen => &[false],
            Self::Both => &[true, false],
        }
    }
}

/// A target as it is printed: name, factor on the number.
const TARGETS: [(&str, f64); 3] = [("ln c", 1.0), ("φ, °", 180.0 / std::f64::consts::PI), ("ln K", 1.0)];

/// How often a calibrated posterior is called so.
const CONFIDENCE: f64 = 0.99;

/// Prints the limit for one and for a mean of 100 instants, and beside it the estimator.
///
/// # Errors
/// Where the posterior of a case cannot be sampled.
pub fn run(arguments: &LimitArguments, estimator: &Estimator<'_>) -> Result<(), HostError> {
    for &sinkage in arguments.sinkage.each() {
        for instants in [1, 100] {
            let bar = bar(format!("posteriors, instants: {instants}"), arguments.cases as usize);
            let design = Design::Kapvik { instants, sinkage };
            let found = cases(design, arguments.cases as usize, arguments.seed, KAPVIK_LOADS, &EFFORT, || bar.inc(1));
            bar.finish_and_clear();
            let found = found.map_err(|error| HostError::Failed(format!("bench limit: {error}")))?;
            print(&found, instants, sinkage, estimator);
        }
    }
    Ok(())
}

fn print(cases: &[Case], instants: u32, sinkage: bool, estimator: &Estimator<'_>) {
    let seen = if sinkage { "seen" } else { "unseen" };
    println!("{} cases, mean of {instants} instant(s), sinkage {seen}", cases.len());
    let limit = Errors::new(cases.iter().map(|case| (case.summary.means(), case.truth)));
    let other = Errors::new(cases.iter().map(|case| (estimator(&case.query), case.truth)));
    println!(
        "  {:<6}{:>16}{:>14}{:>8}{:>10}{:>8}{:>18}{:>16}",
        "", "limit RMSE", "posterior std", "R²", "sampling", "rank", "estimator RMSE", "ratio"
    );
    let prior = prior_scale();
    for (target, (name, factor)) in TARGETS.iter().enumerate() {
        let rmse = limit.rmse(target);
        let std = root_mean_square(cases.iter().map(|case| case.summary.targets[target].std));
        let sampling = root_mean_square(cases.iter().map(|case| case.summary.targets[target].standard_error()));
        let ranks = cases.iter().map(|case| case.summary.ranks(&case.truth)[target]).collect();
        let explained = 1.0 - (rmse.value / f64::from(prior.std[target])).powi(2);
        print!("  {name:<6}{:>16}{:>14.3}{explained:>8.2}", text(rmse, *factor), std * factor);
        print!("{:>10.4}{:>8.3}", sampling * factor, distance_from_uniform(ranks));
        println!("{:>18}{:>16}", text(other.rmse(target), *factor), text(other.ratio(&limit, target), 1.0));
    }
    let of_modulus = |errors: &Errors| 100.0 * errors.median_relative(2);
    println!("  median error of K: {:.1} %, estimator {:.1} %", of_modulus(&limit), of_modulus(&other));
    print_trust(cases);
}

/// What the table can be trusted for.
fn print_trust(cases: &[Case]) {
    let converged = cases.iter().filter(|case| case.summary.converged).count();
    let worst = cases.iter().map(|case| case.summary.split_r_hat).fold(1.0, f64::max);
    let least = cases.iter().map(|case| case.summary.effective_size).fold(f64::INFINITY, f64::min);
    let evaluations = cases.iter().map(|case| case.summary.evaluations).sum::<usize>() / cases.len();
    println!(
        "  sampling: Monte-Carlo standard error of the posterior mean; {evaluations} evaluations a case, chains converged in \
         {converged} of {}, split-R̂ ≤ {worst:.3}, effective size ≥ {least:.0}",
        cases.len()
    );
    println!(
        "  rank: distance of the truth's ranks from uniform; below {:.3} in {:.0} of 100 sets of calibrated posteriors\n",
        distance_bound(cases.len(), 1.0 - CONFIDENCE),
        100.0 * CONFIDENCE
    );
}

fn text(measured: Measured, factor: f64) -> String {
    format!("{:.3} ± {:.3}", measured.value * factor, measured.standard_error * factor)
}
