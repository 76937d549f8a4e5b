//! `kapvik train`: trains the networks and writes the frozen table.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::data::atomic_write::write_text;
use crate::data::campaign::Declared;
use crate::data::outputs;
use crate::error::HostError;
use crate::prior::COMPARED_SLOPE_STD_RAD;
use crate::progress::with_progress;
use crate::train::comparison::{Row, compare_fifth_inputs, compare_trainers};
use crate::train::curve::{Curve, draw};
use crate::train::emit::{Provenance, table_file};
use crate::train::fifth_input::Candidate;
use crate::train::plan::Plan;
use crate::train::rover_training::{rover_scenes, train_rover};
use crate::train::scene::{Design, Scene, scenes_in};
use crate::train::wheel_training::train_wheel;
use crate::train::world::World;

/// Options of `kapvik train`.
#[derive(Args)]
pub struct Arguments {
    /// The table; `firmware/weights/kapvik.table` is the one that the next build freezes in.
    #[arg(short, long, value_name = "WEIGHTS")]
    output: PathBuf,
    /// Seed of every random draw; the same seed gives the same bytes.
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// A run of seconds, to see that everything works; its table is not worth flying.
    #[arg(long)]
    quick: bool,
    /// A file with a table `[declared]`, such as a campaign's NAME.toml: the effects of the world that is trained for
    #[arg(long, value_name = "D.toml")]
    declared: Option<PathBuf>,
    /// Also draw the validation curves.
    #[arg(long, value_name = "SVG")]
    picture: Option<PathBuf>,
}

/// Trains, prints both comparisons, writes the table.
///
/// # Errors
/// Where a file cannot be read or written, or does not declare effects as it should; where these leave next to no scene in which
/// the soil carries the wheels; and where a network cannot fly.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let Arguments { output, declared, picture, .. } = arguments;
    outputs::check(&[Some(output), picture.as_deref()], &[declared.as_deref()])?;
    let plan = if arguments.quick { Plan::quick(arguments.seed) } else { Plan::full(arguments.seed) };
    let world = match &arguments.declared {
        Some(path) => World::declared(&Declared::read_from(path)?),
        None => World::seed(),
    };
    let tell = |said: &str| outputs::tell(said, &[Some(output), picture.as_deref()]);
    tell(&format!("Effects: {world}\n"));
    let drawn = |count, seed| scenes_in(&world, Design::Training, count, seed);
    let training = with_progress("scenes", |_| drawn(plan.scenes, plan.seed))?;
    let held_out = with_progress("held-out scenes", |_| drawn(plan.held_out, !plan.seed))?;
    let six = |scenes: &[Scene]| -> Vec<Scene> {
        let six = scenes.iter().filter(|scene| scene.wheels.len() == scene.wheels.capacity()).cloned();
        let six = six.map(|scene| scene.with_slope_seen(COMPARED_SLOPE_STD_RAD));
        six.take(plan.comparison_scenes).collect()
    };
    let (few, few_held_out) = (six(&training), six(&held_out));
    let trainers = with_progress("trainers", |bar| compare_trainers(&plan, &few, &few_held_out, bar));
    tell(&table("Trainers (per-wheel network, sinkage as fifth input)", &trainers));
    let inputs = with_progress("fifth inputs", |bar| compare_fifth_inputs(&plan, &few, &few_held_out, bar));
    tell(&table("Fifth inputs (per-wheel network, Adam)", &inputs));
    best_fifth_input(&inputs).iter().for_each(|said| tell(said));
    let (wheel, wheel_curve) =
        with_progress("per-wheel network", |bar| train_wheel(&plan, Candidate::SHIPPED, &training, &held_out, bar));
    drop(training);
    let training = with_progress("scenes", |_| rover_scenes(&plan, &world))?;
    let (rover, rover_curve) = with_progress("rover network", |bar| train_rover(&plan, &training, &held_out, bar));
    tell(&format!("Held-out loss: per-wheel {:.4}, rover {:.4} nats", wheel_curve.last(), rover_curve.last()));
    let losses = [wheel_curve.last(), rover_curve.last()];
    let file = table_file(wheel, rover, &Provenance { plan: &plan, world: &world, fifth: Candidate::SHIPPED, losses })?;
    write_text(output, &file.to_text())?;
    picture.as_deref().map_or(Ok(()), |picture| write_curves(picture, trainers, &wheel_curve, &rover_curve))
}

fn write_curves(picture: &Path, trainers: Vec<Row>, wheel: &Curve, rover: &Curve) -> Result<(), HostError> {
    let trainers: Vec<_> = trainers.into_iter().map(|row| row.curve).collect();
    let panels = [
        ("Trainers", trainers.as_slice()),
        ("Per-wheel network", std::slice::from_ref(wheel)),
        ("Rover network", std::slice::from_ref(rover)),
    ];
    write_text(picture, &draw(&panels)?)
}

/// Which candidate without a sinkage sensor is best; a change of it is for people, since the flight side makes it.
fn best_fifth_input(rows: &[Row]) -> Option<String> {
    let loss = |fifth: Candidate| {
        rows.iter().find(|row| row.name == fifth.name()).map_or(f64::INFINITY, |row| row.curve.last())
    };
    let easier = Candidate::ALL.into_iter().filter(|&fifth| fifth != Candidate::Sinkage);
    let best = easier.min_by(|&a, &b| loss(a).total_cmp(&loss(b)))?;
    let (best, shipped) = (best.name(), Candidate::SHIPPED.name());
    Some(format!("Best without a sinkage sensor: {best}. Shipped: {shipped} (optional).\n"))
}

/// The candidates' scores under a title, with an empty line behind them.
fn table(title: &str, rows: &[Row]) -> String {
    let head = format!(
        "  {:28} {:>10} {:>9} {:>9} {:>9} {:>9} {:>12} {:>8}",
        "", "loss/nats", "φ RMSE/°", "K med./%", "R² ln c", "R² ln K", "presented", "s"
    );
    let line = |row: &Row| {
        let [c, phi, k] = &row.score;
        format!(
            "  {:28} {:>10.4} {:>9.3} {:>9.1} {:>9.3} {:>9.3} {:>12} {:>8.1}",
            row.name,
            row.curve.last(),
            phi.rmse.to_degrees(),
            100.0 * k.median_ratio_error,
            c.r_squared,
            k.r_squared,
            row.presentations,
            row.curve.points.last().map_or(0.0, |point| point.0)
        )
    };
    let lines: Vec<String> = [title.to_owned(), head].into_iter().chain(rows.iter().map(line)).collect();
    format!("{}\n", lines.join("\n"))
}
