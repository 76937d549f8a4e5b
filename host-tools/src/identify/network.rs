//! Identification by the networks that fly.

use kapvik_firmware::soil::{QueryAnswer, Refusal, SoilEstimate};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{SoilQuery, WheelNoise, WheelState};

use crate::data::campaign::{Campaign, Channel, Ground};
use crate::error::HostError;
use crate::train::prior::{self, Range};

use super::combine::{MeanState, Sample, combine};
use super::condition::condition_number;
use super::{Answer, SensorNoise};

/// The columns without which there is no wheel state.
const NEEDED: [Channel; 4] = [Channel::Slip, Channel::Load, Channel::DrawbarPull, Channel::Torque];

/// A campaign, identified.
#[derive(Debug, Clone)]
pub struct Identification {
    /// The noise of one row, and where it comes from.
    pub noise: SensorNoise,
    /// The runs, in the order of the file.
    pub runs: Vec<IdentifiedRun>,
}

/// A run, identified.
#[derive(Debug, Clone)]
pub struct IdentifiedRun {
    /// Its name.
    pub run: String,
    /// Different times among the rows that were used.
    pub instants: usize,
    /// Rows that were used.
    pub rows_used: usize,
    /// Lines of the rows that were not, and why.
    pub rows_left_out: Vec<(u64, String)>,
    /// What the networks were asked about; its noise is that of means. None where no row could be used.
    pub question: Option<Question>,
}

/// What the networks were asked about a run, and what they said.
#[derive(Debug, Clone)]
pub struct Question {
    /// The wheels.
    pub states: Vec<MeanState>,
    /// What was sent: with sinkage where every wheel has one.
    pub query: SoilQuery,
    /// What came back.
    pub answer: QueryAnswer,
    /// What came back when the same was sent without sinkage; none where there was no sinkage to leave out.
    pub answer_without_sinkage: Option<QueryAnswer>,
    /// See [`condition_number`]; at the estimate of the rover network.
    pub condition_number: Option<f64>,
}

/// Identifies every run. `answer` is asked once for a run, twice where it has sinkage.
///
/// # Errors
/// Where the campaign lacks a column that the method needs, or nobody answers.
pub fn identify(campaign: &Campaign, answer: &mut Answer<'_>) -> Result<Identification, HostError> {
    let missing: Vec<&str> =
        NEEDED.map(Channel::name).into_iter().filter(|name| campaign.column(name).is_none()).collect();
    if !missing.is_empty() {
        return Err(campaign.error(format!(
            "no column {}: the method network needs {}",
            missing.join(", "),
            NEEDED.map(Channel::name).join(", ")
        )));
    }
    let noise = SensorNoise::of(campaign);
    let runs = campaign.runs().into_iter().map(|(run, rows)| identify_run(campaign, run, &rows, &noise, answer));
    Ok(Identification { noise, runs: runs.collect::<Result<_, _>>()? })
}

fn identify_run(
    campaign: &Campaign,
    run: &str,
    rows: &[usize],
    noise: &SensorNoise,
    answer: &mut Answer<'_>,
) -> Result<IdentifiedRun, HostError> {
    let (mut samples, mut times, mut rows_left_out) = (Vec::new(), Vec::new(), Vec::new());
    for &row in rows {
        let id = &campaign.rows()[row];
        match sample(campaign, row) {
            Ok(sample) => {
                samples.push(sample);
                times.push(id.t_s);
            }
            Err(reason) => rows_left_out.push((id.line, reason)),
        }
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    let states = combine(&samples, noise.slip.std, noise.load.std);
    let question = if states.is_empty() { None } else { Some(ask(campaign, states, noise, answer)?) };
    Ok(IdentifiedRun { run: run.to_owned(), instants: times.len(), rows_used: samples.len(), rows_left_out, question })
}

/// The wheel state of a row, or what it lacks.
fn sample(campaign: &Campaign, row: usize) -> Result<Sample, String> {
    let value = |channel| campaign.value(row, channel);
    let needed = |channel: Channel| value(channel).ok_or_else(|| format!("no {}", channel.name()));
    let sample = Sample {
        slip: needed(Channel::Slip)?,
        load_n: needed(Channel::Load)?,
        drawbar_pull_n: needed(Channel::DrawbarPull)?,
        torque_nm: needed(Channel::Torque)?,
        sinkage_m: value(Channel::Sinkage),
    };
    if sample.load_n > 0.0 { Ok(sample) } else { Err("load_n is not above 0".to_owned()) }
}

fn ask(
    campaign: &Campaign,
    states: Vec<MeanState>,
    noise: &SensorNoise,
    answer: &mut Answer<'_>,
) -> Result<Question, HostError> {
    let query = SoilQuery {
        wheel: campaign.wheel.map(|length| length as f32),
        noise: noise.of_means(&states, campaign.wheel.radius_m),
        slope: None,
        wheels: states.iter().map(|state| wheel_state(&state.mean)).collect(),
    };
    let said = answer(&query)?;
    let answer_without_sinkage = if has_sinkage(&query) {
        let mut blind = query.clone();
        blind.wheels.iter_mut().for_each(|state| state.sinkage_m = None);
        Some(answer(&blind)?)
    } else {
        None
    };
    let condition_number = said.rover.as_ref().ok().and_then(|estimate| {
        let soil = assumed_soil(&campaign.ground, campaign, estimate);
        condition_number(&campaign.wheel, &soil, &states, &query.noise)
    });
    Ok(Question { states, query, answer: said, answer_without_sinkage, condition_number })
}

/// Whether the rover network uses the sinkage: it does where every wheel has one.
fn has_sinkage(query: &SoilQuery) -> bool {
    query.wheels.iter().all(|state| state.sinkage_m.is_some())
}

fn wheel_state(sample: &Sample) -> WheelState {
    WheelState {
        drawbar_pull_n: sample.drawbar_pull_n as f32,
        load_n: sample.load_n as f32,
        torque_nm: sample.torque_nm as f32,
        slip: sample.slip as f32,
        sinkage_m: sample.sinkage_m.map(|z| z as f32),
    }
}

/// The estimated c, φ and K, with all else as the campaign knows it, or else from the middle of the prior.
pub fn assumed_soil(ground: &Ground, campaign: &Campaign, estimate: &SoilEstimate) -> Soil<f64> {
    let or_middle = |known: Option<crate::data::campaign::Knowledge>, range: Range| {
        known.map_or_else(|| range.at(0.5), |known| known.middle())
    };
    Soil {
        sinkage_exponent: or_middle(ground.sinkage_exponent, prior::SINKAGE_EXPONENT),
        cohesive_modulus: 0.0,
        frictional_modulus: or_middle(ground.stiffness(&campaign.wheel), prior::STIFFNESS),
        cohesion_pa: estimate.cohesion_pa.value.into(),
        friction_angle_rad: estimate.friction_angle_rad.value.into(),
        shear_modulus_m: estimate.shear_modulus_m.value.into(),
        peak_stress_c1: or_middle(ground.peak_stress_c1, prior::PEAK_STRESS_C1),
        peak_stress_c2: or_middle(ground.peak_stress_c2, prior::PEAK_STRESS_C2),
        rebound_ratio: ground.rebound_ratio.map_or(0.0, |known| known.middle()),
    }
}

/// Whether a value lies within 3 % of the end of what the networks were trained for: the best soil may lie beyond it.
pub fn at_edge(trained: Range, value: f64) -> bool {
    !(0.03..=0.97).contains(&trained.share(value))
}

/// A refusal in words.
pub fn refusal_in_words(refusal: Refusal) -> &'static str {
    match refusal {
        Refusal::NoWheels => "there is no wheel",
        Refusal::NotFinite => "a number is not finite",
        Refusal::OutOfRange => "a number is outside the range that the networks take",
        Refusal::NotRolling => "no wheel rolls under load",
        Refusal::SelfTestFailed => "the flight computer's self-test failed",
    }
}

impl Question {
    /// The rover network's estimate, with sinkage where there is one.
    pub fn rover(&self) -> Result<&SoilEstimate, &'static str> {
        self.answer.rover.as_ref().map_err(|refusal| refusal_in_words(*refusal))
    }

    /// Whether the rover network's estimate used the sinkage.
    pub fn sinkage_used(&self) -> bool {
        has_sinkage(&self.query)
    }

    /// The noise that the networks were told.
    pub fn noise(&self) -> &WheelNoise {
        &self.query.noise
    }
}

impl IdentifiedRun {
    /// Why there is no estimate of the run's soil; none where there is one.
    pub fn refused(&self) -> Option<String> {
        match &self.question {
            Some(question) => question.rover().err().map(str::to_owned),
            None => Some(format!("no row can be used: {}", self.reasons_in_words())),
        }
    }

    /// Why rows were left out, each reason once with its lines.
    pub fn reasons_in_words(&self) -> String {
        let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
        for (line, reason) in &self.rows_left_out {
            match reasons.iter_mut().find(|(known, _)| known == reason) {
                Some((_, lines)) => lines.push(line.to_string()),
                None => reasons.push((reason, vec![line.to_string()])),
            }
        }
        let words = reasons.into_iter().map(|(reason, lines)| format!("{reason} (line {})", abbreviated(&lines)));
        words.collect::<Vec<_>>().join("; ")
    }
}

/// A list that stays readable.
fn abbreviated(lines: &[String]) -> String {
    const SHOWN: usize = 6;
    match lines.get(..SHOWN) {
        Some(first) if lines.len() > SHOWN => format!("{} and {} more", first.join(", "), lines.len() - SHOWN),
        _ => lines.join(", "),
    }
}
