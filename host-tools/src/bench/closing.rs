//! What an undeclared effect costs the estimate of the soil, and what declaring it gives back.

use std::path::Path;

use clap::Args;
use kapvik_firmware::frozen;

use crate::close_loop::{Rovers, compare, errors_of_soil, train};
use crate::data::campaign::Declared;
use crate::error::HostError;
use crate::train::plan::Plan;
use crate::train::world::World;

/// The soil of the comparison: its exponent grows with slip, by an amount that is not known.
const FREE: &str = "{ min = 0.0, max = 0.7 }";
/// Amounts at which the errors are shown apart.
const AMOUNTS: [&str; 3] = ["0.0", "0.35", "0.7"];

/// Which networks, and which rovers.
#[derive(Args)]
pub struct ClosingArguments {
    /// Simulated rovers of each kind
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    cases: u32,
    /// Seed of the rovers; training uses 1, and 4294967294 for its check
    #[arg(long, default_value_t = 2026)]
    seed: u32,
    /// Train for seconds only, to see that everything works
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Train by the plan of the table that is shipped
    #[arg(long)]
    full: bool,
}

/// Trains the rover network without and with slip-sinkage declared, and prints the errors of both on soil that has it.
///
/// # Errors
/// Never in practice: rovers can drive on such soil.
pub fn run(arguments: &ClosingArguments) -> Result<(), HostError> {
    let plan = match (arguments.quick, arguments.full) {
        (true, _) => Plan::quick(1),
        (_, true) => Plan::full(1),
        _ => Plan::medium(1),
    };
    let after = slip_sinkage(FREE)?;
    let rovers = Rovers::draw(&after, arguments.cases as usize, arguments.seed)?;
    let (before, found) = (train(&World::seed(), &plan, false)?, train(&after, &plan, false)?);
    println!(
        "Six-wheel rovers on soil with slip-sinkage, n = n₀ + n₁ i with n₁ uniform in 0 … 0.7: {} of each kind, seed {}.\n\
         Rover network trained without (before) and with (after) slip-sinkage declared: {} scenes, {} epochs.\n",
        arguments.cases, arguments.seed, plan.scenes, plan.rover.epochs
    );
    println!("{}\n", errors_of_soil(&compare(&[&before.rover, &found.rover], &rovers)));
    for amount in AMOUNTS {
        let rovers = Rovers::draw(&slip_sinkage(amount)?, arguments.cases as usize, arguments.seed)?;
        println!("n₁ = {amount}\n{}\n", errors_of_soil(&compare(&[&before.rover, &found.rover], &rovers)));
    }
    println!("The network that is shipped, which knows no effect, with n₁ uniform in 0 … 0.7:\n");
    println!("{}", errors_of_soil(&compare(&[&frozen::ROVER], &rovers)));
    Ok(())
}

/// A world whose soils have slip-sinkage by `n1`, in the words of a declaration.
fn slip_sinkage(n1: &str) -> Result<World, HostError> {
    let text = format!("[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nn1 = {n1}\n");
    Ok(World::declared(&Declared::parse(Path::new("slip-sinkage"), &text)?))
}
