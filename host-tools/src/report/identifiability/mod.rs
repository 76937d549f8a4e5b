//! What of a soil can be told: the map as a picture, the advice as a table for the terminal and as a page.

mod page;
mod picture;
mod terminal;

pub use page::page;
pub use picture::picture;
pub use terminal::terminal;

use crate::identifiability::advice::{Advice, Document};
use crate::identifiability::map::{Cell, MIDDLE_SLIP, MapQuestion};
use crate::identifiability::rover_side::RoverMeasurement;
use crate::identifiability::search::{Question, SETTLING_S};
use crate::identifiability::sensors::{FRAMES_PER_SECOND, LastingErrors};

/// How the map looks.
const MAP_CSS: &str = include_str!("map.css");

/// Everything that is told.
#[derive(Debug, Clone)]
pub struct Observability {
    /// The soil in words.
    pub soil: String,
    /// The rover in words.
    pub rover: String,
    /// What was asked of the rover.
    pub question: Question,
    /// What it should do.
    pub advice: Advice,
    /// What was asked of the map.
    pub map_question: MapQuestion,
    /// The map.
    pub map: Vec<Cell>,
}

impl Observability {
    /// The advice as a file says it.
    pub fn document(&self) -> Document {
        Document::new(&self.soil, &self.question, &self.advice)
    }
}

/// What the figures rest on.
fn assumptions(told: &Observability) -> Vec<String> {
    vec![
        of_soil(told),
        of_sensors(&told.question.measurement),
        of_lasting_errors(&told.question.measurement.lasting),
        format!(
            "The first {SETTLING_S:.0} s of every leg count for nothing: the drives come up to speed and the wheels roll over \
             the length of their contact."
        ),
        of_driving(&told.question),
        "Plane ground, one soil, equations 1–11: no slip-sinkage, no ruts, left and right alike. A wheel that spins in place \
         may dig itself in, which these equations do not know."
            .to_owned(),
        of_map(told),
    ]
}

fn of_soil(told: &Observability) -> String {
    let beforehand = &told.question.measurement.beforehand;
    format!(
        "To first order about {}. Beforehand, c, φ and K are known {}, n and the stiffness {}, c1 and c2 {}.",
        told.soil,
        beforehand.targets.in_words(),
        beforehand.pressure.in_words(),
        beforehand.peak.in_words()
    )
}

fn of_sensors(measurement: &RoverMeasurement) -> String {
    let sinkage = match measurement.sinkage_m {
        Some(std_m) => format!("the sinkage of every wheel to {:.1} mm", 1e3 * std_m),
        None => "no sinkage".to_owned(),
    };
    format!(
        "{FRAMES_PER_SECOND:.0} frames a second with the white noise of the rover's sensors, {sinkage}, and {:.1} N in each wheel's drawbar pull \
         over one second from uneven ground. Drawbar pulls are not measured: they follow from the balances of bogie, \
         rocker and rover.",
        measurement.ground_n / FRAMES_PER_SECOND.sqrt()
    )
}

fn of_lasting_errors(lasting: &LastingErrors) -> String {
    format!(
        "These errors last, however long the drive: velocimeter scale {:.1} %, each load cell {:.1} N, each drive torque \
         {:.2} N·m, pitch {:.1}°.",
        100.0 * lasting.speed_scale,
        lasting.load_n,
        lasting.torque_nm,
        lasting.pitch_rad.to_degrees()
    )
}

fn of_driving(question: &Question) -> String {
    format!(
        "Rims turn at {:.0} mm/s, and all of them slower where one would be faster than {:.0} mm/s. A joule beyond the \
         usual drive costs {} s, a millimetre of sinkage {} s.",
        1e3 * question.speeds.usual_m_s,
        1e3 * question.speeds.top_m_s,
        question.weights.per_joule,
        question.weights.per_millimetre
    )
}

fn of_map(told: &Observability) -> String {
    let noise = &told.map_question.measurement.noise;
    format!(
        "The map: {:.1} N, {:.1} N, {:.2} N·m and {:.3} of noise in drawbar pull, load, torque and slip of an instant, {} \
         independent instants a second (level ground; hills leave a tenth), no sinkage, the same lasting errors and \
         {:.2} N in each wheel's drawbar pull. Six stations of slip (about {MIDDLE_SLIP:.2}) and load; a wheel that goes through \
         several in turn shows its own lasting errors.",
        noise.drawbar_pull_n,
        noise.load_n,
        noise.torque_nm,
        noise.slip,
        told.map_question.instants_per_second,
        told.question.measurement.lasting.drawbar_pull_n
    )
}
