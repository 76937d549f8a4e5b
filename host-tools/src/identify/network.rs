//! Identification by the networks that fly.

use kapvik_firmware::pipeline;
use kapvik_firmware::soil::{QueryAnswer, SoilEstimate};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{SoilQuery, WheelNoise, WheelState};

use crate::data::campaign::{Campaign, Ground};
use crate::error::HostError;
use crate::prior::Range;

use super::bend::Bends;
use super::beyond_training::{at_an_end, beyond};
use super::combine::MeanState;
use super::condition::condition_number;
use super::layout::Layout;
use super::logarithmic::{targets, widened};
use super::method::{Evidence, Finding, Method, network_refusal, networks};
use super::misfit::by_map;
use super::rehearsal::{Missing, OfTraining, missing};
use super::run_states::{RunStates, check_columns, run_states};
use super::{Answer, SensorNoise};

/// What is said of wheels that the networks have not learned.
pub const OUTSIDE: &str = "outside the range that the networks were trained on, and not to be relied on";

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
    /// Its wheel states.
    pub states: RunStates,
    /// What the networks were asked about; its noise is that of means. None where no row could be used.
    pub question: Option<Question>,
    /// Why no soil explains the run by equations that the networks know, where that was tried and its residuals are no noise.
    pub misfit: Option<String>,
    /// Why the soil is one that the networks have not learned, or may be one, or is another by `map`, or is moved by effects that they have
    /// not learned, or the wheels are in a state that they have not, where that was looked at.
    pub beyond_training: Option<String>,
}

/// What the networks were asked about a run, and what they said.
#[derive(Debug, Clone)]
pub struct Question {
    /// What was sent: with sinkage where every wheel has one.
    pub query: SoilQuery,
    /// What came back.
    pub answer: QueryAnswer,
    /// What came back when the same was sent without sinkage; none where there was no sinkage to leave out.
    pub answer_without_sinkage: Option<QueryAnswer>,
    /// See [`condition_number`]; at the estimate of the rover network.
    pub condition_number: Option<f64>,
    /// What the flight networks' intervals lack on runs of this layout, and what has been added to those of `answer`; none where
    /// they have not been rehearsed.
    pub missing: Option<Missing>,
    /// How the run is laid out.
    layout: Layout,
    /// What has brought means over different slips and loads onto the curve; none where there was none.
    bends: Option<Bends>,
}

/// Identifies every run. `answer` is asked once for a run, twice where it has sinkage.
///
/// # Errors
/// Where the campaign lacks a column that the method needs, or nobody answers.
pub fn identify(campaign: &Campaign, answer: &mut Answer<'_>) -> Result<Identification, HostError> {
    check_columns(campaign, Method::Network)?;
    let noise = SensorNoise::of(campaign);
    let identified = |states: RunStates| {
        let question =
            if states.states.is_empty() { None } else { Some(ask(campaign, &states.states, &noise, answer)?) };
        Ok(IdentifiedRun { states, question, misfit: None, beyond_training: None })
    };
    let runs = run_states(campaign, &noise, Method::Network).into_iter().map(identified);
    Ok(Identification { runs: runs.collect::<Result<_, HostError>>()?, noise })
}

/// As [`identify`], `answer` being what the flight networks say, which were trained with what the campaign declares (`know_effects`) or with
/// equations 1–11 alone. The intervals of all wheels together are widened where the networks are too sure of runs that are laid out as these:
/// see `rehearsal.rs`; not those of networks that know effects, for the soils that are drawn know none. And runs are noted that no soil
/// explains, or one that the networks have not learned.
///
/// # Errors
/// As [`identify`].
pub fn identify_rehearsed(
    campaign: &Campaign,
    know_effects: bool,
    answer: &mut Answer<'_>,
) -> Result<Identification, HostError> {
    let mut identification = identify(campaign, answer)?;
    if !know_effects || campaign.declared.effects.is_empty() {
        identification.runs.iter_mut().filter_map(|run| run.question.as_mut()).for_each(Question::rehearse);
    }
    let mut by_map = by_map(campaign, know_effects, &identification.noise);
    for run in &mut identification.runs {
        let by_map = by_map.remove(&run.states.run);
        let estimate = run.question.as_ref().and_then(|question| question.answer.rover.as_ref().ok());
        let beyond = by_map.as_ref().and_then(|by_map| beyond(&by_map.found));
        let denied = || by_map.as_ref()?.denies(&Finding::from(estimate?), campaign);
        let outside = || estimate?.outside_training_range.then(|| OUTSIDE.to_owned());
        run.beyond_training = beyond.or_else(|| at_an_end(estimate?)).or_else(denied).or_else(outside);
        run.misfit = by_map.and_then(|by_map| by_map.misfit);
    }
    Ok(identification)
}

fn ask(
    campaign: &Campaign,
    states: &[MeanState],
    noise: &SensorNoise,
    answer: &mut Answer<'_>,
) -> Result<Question, HostError> {
    let layout = Layout::new(&campaign.wheel, states, noise);
    let bends = Bends::of(&layout);
    let straight = bends.as_ref().map(|bends| bends.of_means(states));
    let states = straight.as_deref().unwrap_or(states);
    let query = networks::query(&Evidence::of_run(campaign, noise, states));
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
        condition_number(&campaign.wheel, &soil, states, &query.noise)
    });
    Ok(Question { query, answer: said, answer_without_sinkage, condition_number, missing: None, layout, bends })
}

/// Whether the rover network uses the sinkage: it does where every wheel has one.
fn has_sinkage(query: &SoilQuery) -> bool {
    query.wheels.iter().all(|state| state.sinkage_m.is_some())
}

/// The estimated c, φ and K, with all else as the campaign knows it, or else from the middle of the prior.
pub fn assumed_soil(ground: &Ground, campaign: &Campaign, estimate: &SoilEstimate) -> Soil<f64> {
    Soil {
        cohesion_pa: estimate.cohesion_pa.value.into(),
        friction_angle_rad: estimate.friction_angle_rad.value.into(),
        shear_modulus_m: estimate.shear_modulus_m.value.into(),
        ..ground.middle(&campaign.wheel)
    }
}

/// Whether a value lies within 3 % of the end of what the networks were trained for: the best soil may lie beyond it.
pub fn at_edge(trained: Range, value: f64) -> bool {
    !(0.03..=0.97).contains(&trained.share(value))
}

impl Question {
    fn rehearse(&mut self) {
        let Self { query, layout, bends, .. } = self;
        let ask = |states: &[WheelState<f64>], is_blind: bool| {
            let straight = bends.as_ref().map(|bends| bends.straightened(states));
            let seen = straight.as_deref().unwrap_or(states).iter().map(|state| state.map(|number| number as f32));
            let blind = |state: WheelState| WheelState { sinkage_m: state.sinkage_m.filter(|_| !is_blind), ..state };
            let answer = pipeline::answer(&SoilQuery { wheels: seen.map(blind).collect(), ..query.clone() });
            answer.rover.ok().map(|estimate| targets(&estimate))
        };
        let widen = |answer: &mut QueryAnswer, is_blind: bool| {
            // Of what is outside, the networks say themselves that nothing can be relied on.
            let estimate = answer.rover.as_mut().ok().filter(|estimate| !estimate.outside_training_range)?;
            let stated = targets(estimate);
            let widths = stated.map(|target| target.std);
            let missing = missing(layout, &OfTraining, &stated, widths, |states| ask(states, is_blind))?;
            *estimate = widened(estimate, &missing.errors);
            Some(missing)
        };
        self.missing = widen(&mut self.answer, false);
        self.answer_without_sinkage.iter_mut().for_each(|answer| {
            widen(answer, true);
        });
    }

    /// The rover network's estimate, with sinkage where there is one.
    pub fn rover(&self) -> Result<&SoilEstimate, &'static str> {
        self.answer.rover.as_ref().map_err(|refusal| network_refusal(*refusal))
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
            None => Some(format!("no row can be used: {}", self.states.reasons_in_words())),
        }
    }
}
