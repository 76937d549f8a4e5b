//! `kapvik observe`: how to drive so that the soil shows.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use kapvik_firmware::terramechanics::Soil;

use super::numbers::{above_zero, not_negative};
use super::soil_argument;
use crate::data::atomic_write::{write_json, write_text};
use crate::data::outputs;
use crate::data::rover_file::RoverFile;
use crate::error::HostError;
use crate::identifiability::advice::Advice;
use crate::identifiability::beforehand::{Beforehand, Knowledge, middle_soil};
use crate::identifiability::cost::CostWeights;
use crate::identifiability::manoeuvre::RimSpeeds;
use crate::identifiability::map::{self, LOAD_CELLS, MapQuestion, SLIP_CELLS};
use crate::identifiability::rover_side::RoverMeasurement;
use crate::identifiability::search::{Question, SETTLING_S, SHORTEST_MANOEUVRE_S};
use crate::identifiability::sensors::{FRAMES_PER_SECOND, INSTANTS_PER_SECOND, LASTING_PITCH_DEG, LastingErrors};
use crate::identifiability::single_wheel::WheelMeasurement;
use crate::parameter::Parameter;
use crate::prior::KAPVIK_INSTANT_NOISE;
use crate::progress::bar;
use crate::report::identifiability::{Observability, page, picture, terminal};

/// The soil that stands for not knowing it.
const MIDDLE: &str = "prior";

/// What is to be known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Wanted {
    /// Cohesion
    C,
    /// Friction angle
    Phi,
    /// Shear modulus
    K,
    /// As many of them as can be
    All,
}

/// Options of `kapvik observe`.
#[derive(Args)]
pub struct Arguments {
    /// The soil: a name of `kapvik soils`, a file as of `kapvik forward`, or prior: the middle of what is believed beforehand
    #[arg(long, value_name = "NAME|S.toml", default_value = MIDDLE)]
    soil: String,
    /// The rover; without: the assumed set K0, which also stands in for keys that the file lacks
    #[arg(long, value_name = "R.toml")]
    rover: Option<PathBuf>,
    /// What is to be known
    #[arg(long, value_enum, ignore_case = true, default_value = "all")]
    target: Wanted,
    /// How well: one standard deviation, as a share of the value
    #[arg(long, value_name = "SHARE", default_value_t = 0.1, value_parser = above_zero)]
    accuracy: f64,
    /// The longest manoeuvre, s
    #[arg(long, value_name = "S", default_value_t = 120.0, value_parser = above_zero)]
    longest: f64,
    /// The steepest slope at hand, degrees; 0: level ground alone
    #[arg(long, value_name = "DEG", default_value_t = 0.0, value_parser = slope)]
    slope: f64,
    /// Rim speed of the usual drive, m/s
    #[arg(long, value_name = "M_S", default_value_t = RimSpeeds::default().usual_m_s, value_parser = above_zero)]
    speed: f64,
    /// Greatest rim speed, m/s
    #[arg(long, value_name = "M_S", default_value_t = RimSpeeds::default().top_m_s, value_parser = above_zero)]
    top_speed: f64,
    /// One standard deviation of a measured sinkage in one frame, m; without: sinkage is not measured
    #[arg(long, value_name = "M", value_parser = above_zero)]
    sinkage: Option<f64>,
    /// What uneven ground adds to a wheel's drawbar pull over one second, N, one standard deviation; on the hills of `kapvik
    /// simulate` it is about 2
    #[arg(long, value_name = "N", default_value_t = 0.5, value_parser = of_ordinary_size)]
    ground: f64,
    /// What is known beforehand of c, φ and K
    #[arg(long, value_enum, default_value = "prior")]
    beforehand: Knowledge,
    /// What is known beforehand of n and the stiffness
    #[arg(long, value_enum, default_value = "prior")]
    pressure: Knowledge,
    /// What is known beforehand of c1 and c2
    #[arg(long, value_enum, default_value = "prior")]
    peak: Knowledge,
    /// Lasting error of the velocimeter's scale, as a share
    #[arg(long, value_name = "SHARE", default_value_t = LastingErrors::default().speed_scale, value_parser = of_ordinary_size)]
    speed_bias: f64,
    /// Lasting error of each load cell, N
    #[arg(long, value_name = "N", default_value_t = LastingErrors::default().load_n, value_parser = of_ordinary_size)]
    load_bias: f64,
    /// Lasting error of each drive's torque, N·m
    #[arg(long, value_name = "N_M", default_value_t = LastingErrors::default().torque_nm, value_parser = of_ordinary_size)]
    torque_bias: f64,
    /// Lasting error of the pitch, degrees
    #[arg(long, value_name = "DEG", default_value_t = LASTING_PITCH_DEG, value_parser = of_ordinary_size)]
    pitch_bias: f64,
    /// Cost of a joule beyond the usual drive, in seconds of driving
    #[arg(long, value_name = "S", default_value_t = CostWeights::default().per_joule, value_parser = of_ordinary_size)]
    joule_cost: f64,
    /// Cost of a millimetre of sinkage beyond the usual drive, in seconds of driving
    #[arg(long, value_name = "S", default_value_t = CostWeights::default().per_millimetre, value_parser = of_ordinary_size)]
    sinkage_cost: f64,
    /// Where the advice goes as data
    #[arg(long, value_name = "OUT.json")]
    json: Option<PathBuf>,
    /// Where the report goes, to open in a browser
    #[arg(long, value_name = "OUT.html")]
    html: Option<PathBuf>,
    /// Where the map of identifiability goes
    #[arg(long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
}

/// Computes the advice and the map, and says what to do.
///
/// # Errors
/// Where a file is not as it should be or cannot be written, or the rover cannot drive on the soil.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let outputs = [&arguments.json, &arguments.html, &arguments.picture].map(|path| path.as_deref());
    outputs::check(&outputs, &[Some(arguments.soil.as_ref()), arguments.rover.as_deref()])?;
    check_manoeuvres(arguments)?;
    let told = observability(arguments)?;
    outputs::tell(&terminal(&told), &outputs);
    if let Some(path) = &arguments.json {
        write_json(path, &told.document())?;
    }
    if let Some(path) = &arguments.html {
        write_text(path, &page(&told))?;
    }
    if let Some(path) = &arguments.picture {
        write_text(path, &picture(&told))?;
    }
    Ok(())
}

fn check_manoeuvres(arguments: &Arguments) -> Result<(), HostError> {
    let Arguments { speed, top_speed, longest, .. } = arguments;
    if speed > top_speed {
        return Err(HostError::Failed(format!(
            "--speed {speed}: expected no more than --top-speed, {top_speed} m/s, for no rim turns faster"
        )));
    }
    if *longest < SHORTEST_MANOEUVRE_S {
        return Err(HostError::Failed(format!(
            "--longest {longest}: expected {SHORTEST_MANOEUVRE_S} s or more, for the first {SETTLING_S} s of each leg tell nothing"
        )));
    }
    Ok(())
}

fn observability(arguments: &Arguments) -> Result<Observability, HostError> {
    let (soil, soil_in_words) = soil(&arguments.soil)?;
    let rover = RoverFile::read_or_assumed(arguments.rover.as_deref())?.rover;
    let question = arguments.question(rover, soil);
    let map_question = arguments.map_question(&question);
    // The map is only computed where it is drawn.
    let draws = arguments.html.is_some() || arguments.picture.is_some();
    let cells = if draws { SLIP_CELLS * LOAD_CELLS } else { 0 };
    let bar = bar("drives", question.grid().len() + cells);
    let advice = Advice::new(&question, || bar.inc(1))
        .map_err(|reason| HostError::Failed(format!("{}: {reason}", arguments.soil)))?;
    let map = if draws { map::map(&map_question, || bar.inc(1)) } else { Vec::new() };
    bar.finish_and_clear();
    let rover_in_words = match &arguments.rover {
        Some(path) => format!("rover {}", path.display()),
        None => "assumed rover (set K0)".to_owned(),
    };
    Ok(Observability { soil: soil_in_words, rover: rover_in_words, question, advice, map_question, map })
}

impl Arguments {
    fn question(&self, rover: kapvik_firmware::rover::Rover<f64>, soil: Soil<f64>) -> Question {
        let targets = match self.target {
            Wanted::C => vec![Parameter::Cohesion],
            Wanted::Phi => vec![Parameter::FrictionAngle],
            Wanted::K => vec![Parameter::ShearModulus],
            Wanted::All => Parameter::ALL.to_vec(),
        };
        let lasting = LastingErrors {
            speed_scale: self.speed_bias,
            load_n: self.load_bias,
            torque_nm: self.torque_bias,
            pitch_rad: self.pitch_bias.to_radians(),
            ..LastingErrors::default()
        };
        let beforehand = Beforehand { targets: self.beforehand, pressure: self.pressure, peak: self.peak };
        Question {
            rover,
            soil,
            targets,
            accuracy: self.accuracy,
            longest_s: self.longest,
            steepest_rad: self.slope.to_radians(),
            speeds: RimSpeeds { usual_m_s: self.speed, top_m_s: self.top_speed },
            measurement: RoverMeasurement {
                sinkage_m: self.sinkage,
                ground_n: self.ground * FRAMES_PER_SECOND.sqrt(),
                lasting,
                beforehand,
            },
            weights: CostWeights {
                per_joule: self.joule_cost,
                per_millimetre: self.sinkage_cost,
                ..CostWeights::default()
            },
        }
    }

    fn map_question(&self, question: &Question) -> MapQuestion {
        let RoverMeasurement { lasting, beforehand, .. } = question.measurement;
        let rover = &question.rover;
        let measurement = WheelMeasurement { noise: KAPVIK_INSTANT_NOISE, sinkage_seen: false, lasting, beforehand };
        MapQuestion {
            wheel: rover.wheel,
            load_n: rover.load_at_rest_n(),
            soil: question.soil,
            measurement,
            instants_per_second: INSTANTS_PER_SECOND,
            accuracy: question.accuracy,
        }
    }
}

/// The soil, and what to call it.
fn soil(name: &str) -> Result<(Soil<f64>, String), HostError> {
    if name == MIDDLE {
        return Ok((middle_soil(), "the soil in the middle of the prior".to_owned()));
    }
    Ok((soil_argument::soil(name)?, format!("soil {name}")))
}

/// Of errors and costs: what is larger than any that matters tells nothing, and its squares overflow.
fn of_ordinary_size(text: &str) -> Result<f64, String> {
    const MOST: f64 = 1e6;
    not_negative(text)
        .ok()
        .filter(|number| *number <= MOST)
        .ok_or_else(|| format!("expected a number from 0 to {MOST}"))
}

fn slope(text: &str) -> Result<f64, String> {
    not_negative(text).ok().filter(|slope| *slope <= 30.0).ok_or_else(|| "expected degrees, 0 to 30".to_owned())
}
