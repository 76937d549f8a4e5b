//! `kapvik simulate`: sensor frames of a drive, with truth.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use kapvik_firmware::rover::Side;
use kapvik_firmware::terramechanics::Soil;

use crate::data::atomic_write::write_atomically;
use crate::data::outputs;
use crate::data::rover_file::RoverFile;
use crate::data::truth_file::{truth_path, write_truth};
use crate::data::{frame_file, truth_file};
use crate::digits::counted;
use crate::error::HostError;
use crate::printable::on_one_line;
use crate::progress::bar;
use crate::simulate::effects::{EffectError, RoverEffects};
use crate::simulate::faults::{FAILURES, Failure, Fault, OF_FRAMES};
use crate::simulate::ground_soils::{Becomes, Change};
use crate::simulate::{Options, RATE_HZ, Scenario, SimulationError, Traverse};

use super::numbers::above_zero_at_most;
use super::soil_argument;

/// What to simulate, and where it goes.
#[derive(Args)]
pub struct Arguments {
    /// What all chance is drawn from: soil, ground, rim speeds, noise
    #[arg(long)]
    seed: u64,
    /// Where the frames go; the truth goes beside, to FRAMES.truth.csv
    #[arg(short, long, value_name = "FRAMES.csv")]
    output: PathBuf,
    /// The kind of drive
    #[arg(long, value_enum, default_value = "traverse")]
    scenario: Scenario,
    /// How long it takes, s, at most 10 million; without: the scenario's own length. When sensors fail or wheels are blocked does not change
    /// with it
    #[arg(long, value_name = "S", value_parser = duration)]
    duration: Option<f64>,
    /// Frames a second, at most 1000
    #[arg(long, value_name = "HZ", value_parser = rate, default_value_t = RATE_HZ)]
    rate: f64,
    /// The rover; without: the assumed set K0, which also stands in for keys that the file lacks
    #[arg(long, value_name = "R.toml")]
    rover: Option<PathBuf>,
    /// The soil, in place of one that is drawn: a name of `kapvik soils` or a file as of `kapvik forward`
    #[arg(long, value_name = "NAME|S.toml")]
    soil: Option<String>,
    /// Another soil under the wheels of the right side; where sides differ the truth of the soil is half-way between
    #[arg(long, value_name = "NAME|S.toml")]
    right_soil: Option<String>,
    /// Another soil from METRES on, in place of the scenario's; also ice-cemented or sublimated: the soil before it, changed
    #[arg(long, value_name = "SOIL@METRES")]
    then: Vec<String>,
    /// From then on every wheel turns the other way: the rover backs up over the ground that it came by
    #[arg(long, value_name = "S", value_parser = duration)]
    turn_back: Option<f64>,
    /// An effect or a fault, may be repeated
    ///
    /// Effects of the soil, each with the number of its first parameter: slip-sinkage, multi-pass, load-stiffening, rate,
    /// grouser-ripple, rear-contact, peak-stress-shift, grouser-thrust, interface-friction, shear-hump, bulldozing. Of sensors
    /// and drives: drive-friction (N·m), drive-viscosity (N·m·s/rad), torque-scale, force-bias (of the load cells, N),
    /// force-drift (of the load cells, N/h), crosstalk (of the force along the link into the load cells), guide-friction,
    /// rolling-radius (m), pitch-misalignment (of accelerometer and gyro, rad), velocity-scale, latency (s), rim-wander (share of
    /// its speed by which each wheel slowly departs from its command). Any parameter of an effect: ID.PARAMETER=VALUE.
    ///
    /// Faults: nan, inf, outlier (a million), stuck, zero, dropout, each with SENSOR@T1-T2: a column of the frames, or a pattern with
    /// `*`, and times in s. repeat-frames and skip-frames take @T1-T2.
    #[arg(long, value_name = "ID=VALUE")]
    effect: Vec<String>,
}

/// Simulates the drive and writes frames and truth.
///
/// # Errors
/// Where an argument or a file is not what is expected, or the rover gets stuck: then nothing is written.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let truth = truth_path(&arguments.output);
    let [soil, right_soil] = [&arguments.soil, &arguments.right_soil].map(|soil| soil.as_deref().map(Path::new));
    let further_soils =
        arguments.then.iter().filter_map(|text| text.rsplit_once('@')).map(|(name, _)| Some(Path::new(name)));
    let inputs: Vec<_> = [arguments.rover.as_deref(), soil, right_soil].into_iter().chain(further_soils).collect();
    outputs::check(&[Some(&arguments.output), Some(&truth)], &inputs)?;
    if outputs::is_pipe(&arguments.output) {
        let output = arguments.output.display();
        return Err(HostError::Failed(format!("{output}: expected a file on disk: what was true goes beside it")));
    }
    let RoverFile { rover, grousers, .. } = RoverFile::read_or_assumed(arguments.rover.as_deref())?;
    let (effects, faults) = effects_and_faults(&arguments.effect)?;
    let soil = arguments.soil.as_deref().map(soil_argument::soil).transpose()?;
    let changes = arguments.then.iter().map(|text| change(text)).collect::<Result<Vec<_>, _>>()?;
    let options = Options {
        duration_s: arguments.duration,
        rate_hz: Some(arguments.rate),
        soil,
        right_soil: arguments.right_soil.as_deref().map(soil_argument::soil).transpose()?,
        changes: (!changes.is_empty()).then_some(changes),
        grousers: Some(grousers),
        turns_back_s: arguments.turn_back,
        effects,
        faults,
    };
    let traverse = Traverse::new(arguments.scenario, arguments.seed, &rover, &options).map_err(|error| {
        HostError::Failed(match (&arguments.rover, &error) {
            (Some(path), SimulationError::Standing) => format!("{}: {error}", path.display()),
            (_, SimulationError::NoRadius) => format!("--effect {error}"),
            _ => error.to_string(),
        })
    })?;
    check_times(&options.faults, traverse.frames(), arguments.rate)?;
    let told = write(&arguments.output, &truth, traverse)?;
    println!("{told}, seed {}", arguments.seed);
    println!("{} and {}", arguments.output.display(), truth.display());
    Ok(())
}

/// Refuses a fault that would do nothing: beyond the end of the drive, or between two of its frames.
fn check_times(faults: &[Fault], frames: u64, rate_hz: f64) -> Result<(), HostError> {
    let Some(fault) = faults.iter().find(|fault| !fault.acts_on_any(frames, rate_hz)) else { return Ok(()) };
    let ((start_s, until_s), end_s) = (fault.between_s, frames.saturating_sub(1) as f64 / rate_hz);
    Err(HostError::Failed(match start_s > end_s {
        true => {
            format!("--effect: a fault from {start_s} s on: expected one within the drive, which ends at {end_s} s")
        }
        false => format!(
            "--effect: a fault from {start_s} s to {until_s} s: expected one that a frame falls in, of {rate_hz} a second"
        ),
    }))
}

/// Writes both files, row by row, and gives what is to be told.
fn write(frames_path: &Path, truths_path: &Path, mut traverse: Traverse) -> Result<String, HostError> {
    let bar = bar("frames", traverse.frames() as usize);
    let (mut written, mut last_s, mut way_m) = (0_u64, 0.0, 0.0);
    write_atomically(frames_path, |frames| {
        write_atomically(truths_path, |truths| {
            frame_file::write_header(frames).map_err(HostError::file(frames_path))?;
            truth_file::write_header(truths).map_err(HostError::file(truths_path))?;
            for row in &mut traverse {
                let (frame, truth) = row.map_err(|error| HostError::Failed(error.to_string()))?;
                frame_file::write_frame(frames, &frame).map_err(HostError::file(frames_path))?;
                write_truth(truths, &truth).map_err(HostError::file(truths_path))?;
                (written, last_s, way_m) = (written + 1, 1.0e-6 * frame.time_us as f64, truth.x_m);
                bar.inc(1);
            }
            if written == 0 {
                return Err(HostError::Failed("--effect skip-frames: expected one that leaves a frame".to_owned()));
            }
            // Before the truth takes its place: it must not stand beside frames that could not be written.
            frames.flush().map_err(HostError::file(frames_path))
        })
    })?;
    bar.finish_and_clear();
    let soils = Side::ALL.map(|side| traverse.world().soils.under(side, 0.0));
    let on = match soils.left == soils.right {
        true => told(&soils.left),
        false => format!("{} (left), {} (right)", told(&soils.left), told(&soils.right)),
    };
    Ok(format!("{}, {last_s} s, {way_m:.2} m, on {on}", counted(written, "frame", "frames")))
}

fn told(soil: &Soil<f64>) -> String {
    let Soil { cohesion_pa, friction_angle_rad, shear_modulus_m, .. } = soil;
    let (degrees, mm) = (friction_angle_rad.to_degrees(), 1e3 * shear_modulus_m);
    format!("c = {cohesion_pa:.0} Pa, phi = {degrees:.1}°, K = {mm:.1} mm")
}

fn rate(text: &str) -> Result<f64, String> {
    above_zero_at_most(text, 1000.0)
}

fn duration(text: &str) -> Result<f64, String> {
    above_zero_at_most(text, 1.0e7)
}

fn change(text: &str) -> Result<Change, HostError> {
    let expected = || HostError::Failed(format!("--then {}: expected SOIL@METRES", on_one_line(text)));
    let (name, metres) = text.rsplit_once('@').ok_or_else(expected)?;
    let from_m = metres.parse::<f64>().ok().filter(|metres| metres.is_finite()).ok_or_else(expected)?;
    let becomes = match name {
        "ice-cemented" => Becomes::IceCemented,
        "sublimated" => Becomes::Sublimated,
        name => Becomes::Soil(soil_argument::soil(name)?),
    };
    Ok(Change { from_m, becomes })
}

fn effects_and_faults(texts: &[String]) -> Result<(RoverEffects, Vec<Fault>), HostError> {
    let mut effects = RoverEffects::default();
    let mut faults = Vec::new();
    // What was set, by which name.
    let mut given = BTreeMap::new();
    for text in texts {
        let refuse =
            |message: String| HostError::Failed(format!("--effect {}: {}", on_one_line(text), on_one_line(&message)));
        let (id, value) = text.split_once('=').ok_or_else(|| refuse("expected ID=VALUE".into()))?;
        if let Some((_, failure)) = FAILURES.iter().find(|(name, _)| *name == id) {
            faults.push(fault(*failure, id, value).map_err(refuse)?);
            continue;
        }
        effects = with_effect(effects, id, value).map_err(refuse)?;
        for part in RoverEffects::parts(id) {
            match given.insert(part, id) {
                Some(before) if before == id => return Err(refuse(format!("`{id}` is given twice: expected it once"))),
                Some(before) => {
                    return Err(refuse(format!("it sets what `{before}` has set: expected one of the two")));
                }
                None => {}
            }
        }
    }
    Ok((effects, faults))
}

fn fault(failure: Failure, id: &str, value: &str) -> Result<Fault, String> {
    if OF_FRAMES.contains(&id) && !value.starts_with('@') {
        return Err(format!("`{value}`: expected @T1-T2, which is of whole frames"));
    }
    Fault::parse(failure, value)
}

/// Effects with one more. A wrong name is told before a wrong number.
fn with_effect(mut effects: RoverEffects, id: &str, value: &str) -> Result<RoverEffects, String> {
    let in_words = |error: EffectError| match error {
        EffectError::Unknown(_) => format!("{error}, {}", FAILURES.map(|(name, _)| name).join(", ")),
        EffectError::Refused(reason) => reason,
    };
    RoverEffects::check_name(id).map_err(in_words)?;
    let number = value.parse::<f64>().ok().filter(|number| number.is_finite());
    let number = number.ok_or_else(|| format!("`{value}`: expected a number"))?;
    effects.set(id, number).map_err(in_words)?;
    Ok(effects)
}
