//! How good the estimators of wheel forces are on simulated drives.

use std::path::PathBuf;

use clap::Args;

use super::estimators_soil;
use crate::data::rover_file::RoverFile;
use crate::error::HostError;
use crate::simulate::Scenario;
use crate::statistics::Measured;
use crate::trial::consistency::WILD;
use crate::trial::pulls_seen::MeanSquare;
use crate::trial::tally::Tally;
use crate::trial::{Quantity, Trial, trial};

/// Most drives of a scenario.
pub const MOST_DRIVES: u64 = 100_000;

/// Which drives.
#[derive(Args)]
pub struct EstimatorArguments {
    /// Drives of each scenario
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u64).range(2..=MOST_DRIVES))]
    drives: u64,
    /// Seed of the first drive; development has used those below 1000 and from 3000 to 3999, the network of doubt has learned from those from
    /// 20000 to 25999, and the README reports what came of those from 9500 on
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u64).range(..=u64::MAX - MOST_DRIVES))]
    seed: u64,
    /// Scenarios; without: those that the README reports
    #[arg(long, value_enum)]
    scenario: Vec<Scenario>,
    /// The rover that drives, which its estimators know [default: the assumed set K0]
    #[arg(long, value_name = "R.toml")]
    rover: Option<PathBuf>,
}

/// The scenarios that are reported.
pub const REPORTED: [Scenario; 6] =
    [Scenario::Level, Scenario::Hills, Scenario::Spread, Scenario::Slope, Scenario::Rock, Scenario::Dropout];

/// Those of them on plane ground.
const PLANE: [Scenario; 3] = [Scenario::Level, Scenario::Spread, Scenario::Slope];

/// Drives and prints.
///
/// # Errors
/// Where the rover file cannot be read or there is no such rover.
pub fn run(arguments: &EstimatorArguments) -> Result<(), HostError> {
    let RoverFile { rover, .. } = RoverFile::read_or_assumed(arguments.rover.as_deref())?;
    let scenarios = if arguments.scenario.is_empty() { REPORTED.to_vec() } else { arguments.scenario.clone() };
    for scenario in scenarios {
        let trial = trial(scenario, arguments.seed..arguments.seed + arguments.drives, &rover);
        print(&trial);
        estimators_soil::print(&trial);
    }
    Ok(())
}

fn print(trial: &Trial) {
    println!("\n{}, {} drives", trial.scenario, trial.drives.len());
    trial.failures.iter().for_each(|failure| println!("  no drive: {failure}"));
    println!("  {:16} {:>9} {:>9} {:>13} {:>9}   within 1 σ, 2 σ, %", "", "RMSE", "raw", "ratio", "bias");
    let errors = trial.errors();
    for quantity in Quantity::ALL {
        print_tally(trial, quantity, errors.of(quantity));
    }
    print_pulls(trial);
    let names = ["NEES filter 1", "NEES filter 2", "NIS filter 1", "NIS angles", "NIS forces"];
    for ((name, squares), mean) in names.into_iter().zip(trial.squares()).zip(trial.mean_squares()) {
        let Measured { value: mean, standard_error: error } = mean;
        let inside = 100.0 * squares.share_inside();
        print!("  {name:16} {mean:9.3} ±{error:5.3} of 1, inside 95 % bounds {inside:5.1} %");
        let (share, weight) = squares.wild();
        if name.starts_with("NEES") {
            print!(", squares above {WILD}: {:.2} % of all, {:.0} % of the sum", 100.0 * share, 100.0 * weight);
        }
        println!();
    }
    let white = trial.share_white().map(|share| format!("{:.0}", 100.0 * share)).join(" ");
    println!("  white at 5 %: share of drives, % (rate hub | vx vz rocker bogie pitch | cells moments): {white}");
}

/// The pulls without the errors of the contact angles; on plane ground what the sensors tell at the best.
fn print_pulls(trial: &Trial) {
    let [mut angle, mut front, mut bogie, mut front_told, mut bogie_told] = [MeanSquare::default(); 5];
    for pulls in trial.drives.iter().map(|drive| &drive.pulls) {
        angle.add(&pulls.angle_bound);
        front.add(&pulls.front_bound);
        bogie.add(&pulls.bogie_bound);
        front_told.add(&pulls.front_told);
        bogie_told.add(&pulls.bogie_told);
    }
    println!("  told the contact angles: front pull {:.4} N, bogie pull {:.4} N", front_told.root(), bogie_told.root());
    if PLANE.contains(&trial.scenario) {
        println!(
            "  Cramér–Rao bound where ground and forces are known to be steady: contact angle {:.4}°, front pull {:.4} N, bogie pull {:.4} N",
            angle.root().to_degrees(),
            front.root(),
            bogie.root()
        );
    }
}

/// Ratio and coverage come with their standard errors over drives.
fn print_tally(trial: &Trial, quantity: Quantity, tally: &Tally) {
    let name = match quantity {
        Quantity::Slip => "slip",
        Quantity::Torque => "torque, N·m",
        Quantity::ContactAngle => "contact angle, °",
        Quantity::Load => "load, N",
        Quantity::FrontPull => "front pull, N",
        Quantity::BogiePull => "bogie pull, N",
        Quantity::SplitPull => "split by torque",
        Quantity::LoadSplitPull => "split by load",
    };
    let Measured { value: ratio, standard_error: error } = trial.over_naive(quantity);
    let percent = |share: Measured| format!("{:5.1} ±{:.1}", 100.0 * share.value, 100.0 * share.standard_error);
    let covered = trial.coverage(quantity).map(percent);
    let covered = if quantity.states_std() { covered.join(", ") } else { "–".to_owned() };
    let [rmse, naive, bias] =
        [tally.rmse(), tally.naive_rmse(), tally.bias()].map(|value| quantity.kind().shown(value));
    println!("  {name:16} {rmse:9.4} {naive:9.4} {ratio:6.3} ±{error:5.3} {bias:9.4}   {covered}");
}
