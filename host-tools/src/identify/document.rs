//! What `identify` prints: JSON.

use std::collections::BTreeMap;

use kapvik_firmware::soil::QueryAnswer;
use serde::Serialize;

use crate::data::campaign::{Campaign, Channel, Provenance};
use crate::digits::counted;

use super::followed;
use super::method::{Finding, Fit, Method, network_refusal, rebound};
use super::misfit::{ByMap, by_map, misfits_of};
use super::network::{Identification, IdentifiedRun, Question};
use super::run_states::{RunStates, reasons_in_words};
use super::sensor_noise::{NoiseSource, SensorNoise};
use super::soil_document::SoilDocument;

/// A campaign, identified.
#[derive(Debug, Clone, Serialize)]
pub struct Document {
    method: &'static str,
    campaign: String,
    kind: Provenance,
    source: String,
    /// Effects that the campaign declares.
    declared: Vec<String>,
    warnings: Vec<String>,
    /// Of one row, by channel.
    noise: BTreeMap<&'static str, NoiseDocument>,
    runs: Vec<RunDocument>,
}

/// One standard deviation of one row.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct NoiseDocument {
    std: f64,
    from: NoiseSource,
}

/// A run, identified.
#[derive(Debug, Clone, Serialize)]
pub struct RunDocument {
    /// Its name.
    pub run: String,
    /// Why there is no estimate.
    pub refused: Option<String>,
    condition_number: Option<f64>,
    /// The estimate.
    #[serde(flatten)]
    pub soil: SoilDocument,
    instants: usize,
    rows_used: usize,
    rows_left_out: Vec<LeftOutDocument>,
    /// Why the estimate is none that a soil can be; then nothing in it is called identifiable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub no_soil: Option<String>,
    /// Why no soil explains the run, where its residuals are no noise; then nothing in the estimate is called identifiable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub misfit: Option<String>,
    /// Why the soil is one that the networks have not learned, or may be one, or is another by `map`, or is moved by declared effects that
    /// they have not learned; then nothing in the estimate is called identifiable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_training: Option<String>,
    /// Which channels' noise is not independent from row to row, and how much less rows tell for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remembers: Option<String>,
    /// Which intervals are wider than the networks, or the method, state them, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub widened: Option<String>,
    /// What else the method says of the estimate.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// How well the method's model explains the run, where the method says.
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<FitDocument>,
    #[serde(flatten)]
    networks: Option<NetworksDocument>,
}

/// What the networks say beside the estimate.
#[derive(Debug, Clone, Serialize)]
struct NetworksDocument {
    /// Whether the estimate used the sinkage.
    sinkage_used: bool,
    /// The same without sinkage; null where there was none to leave out.
    without_sinkage: Option<SoilDocument>,
    wheels: Vec<WheelDocument>,
}

/// A row that was not used.
#[derive(Debug, Clone, Serialize)]
pub struct LeftOutDocument {
    line: u64,
    reason: String,
}

/// How well a model explains a run.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct FitDocument {
    chi_square: f64,
    degrees_of_freedom: f64,
    p_value: f64,
}

/// One wheel, identified by itself.
#[derive(Debug, Clone, Serialize)]
pub struct WheelDocument {
    slip: f64,
    load_n: f64,
    drawbar_pull_n: Option<f64>,
    torque_nm: Option<f64>,
    sinkage_m: Option<f64>,
    /// Rows in the mean.
    rows: usize,
    refused: Option<&'static str>,
    #[serde(flatten)]
    soil: SoilDocument,
}

impl Document {
    /// What is printed of an identification by the networks.
    pub fn of(campaign: &Campaign, identification: &Identification) -> Self {
        let runs = identification.runs.iter().map(RunDocument::of).collect();
        let misfit = |run: &IdentifiedRun| Some((run.states.run.clone(), run.misfit.clone()?));
        let misfits = identification.runs.iter().filter_map(misfit).collect();
        Self::new(Method::Network, campaign, &identification.noise, misfits, runs)
    }

    /// What is printed of an identification by another method: what it says of each run.
    pub fn by(
        method: Method,
        campaign: &Campaign,
        noise: &SensorNoise,
        runs: &[(RunStates, Result<Finding, String>)],
    ) -> Self {
        let fit = |(states, found): &(RunStates, Result<Finding, String>)| {
            Some((states.run.clone(), found.as_ref().ok()?.fit?))
        };
        if method == Method::Map {
            let misfits = misfits_of(campaign, noise, runs.iter().filter_map(fit));
            let runs = runs.iter().map(|(states, found)| RunDocument::of_finding(states, found)).collect();
            return Self::new(method, campaign, noise, misfits, runs);
        }
        let by_map = by_map(campaign, method.knows_effects(), noise);
        let of_run = |(states, found): &(RunStates, Result<Finding, String>)| {
            let mut document = RunDocument::of_finding(states, found);
            if let Some((found, by_map)) = found.as_ref().ok().zip(by_map.get(&states.run)) {
                document.hold_against(found, by_map, campaign);
            }
            document
        };
        let runs = runs.iter().map(of_run).collect();
        let misfits = by_map.iter().filter_map(|(run, by_map)| Some((run.clone(), by_map.misfit.clone()?))).collect();
        Self::new(method, campaign, noise, misfits, runs)
    }

    /// What is to be known of all runs.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The runs.
    pub fn runs(&self) -> &[RunDocument] {
        &self.runs
    }

    /// The runs alone.
    pub fn into_runs(self) -> Vec<RunDocument> {
        self.runs
    }

    fn new(
        method: Method,
        campaign: &Campaign,
        noise: &SensorNoise,
        mut misfits: BTreeMap<String, String>,
        mut runs: Vec<RunDocument>,
    ) -> Self {
        for (run, why) in runs.iter_mut().filter_map(|run| misfits.remove(&run.run).map(|why| (run, why))) {
            run.doubt(why);
        }
        let declared = campaign.declared.ids();
        let mut warnings = campaign.remarks();
        if !declared.is_empty() && !method.knows_effects() {
            let effects = declared.join(", ");
            warnings.push(format!("declared effects that the method {} does not know: {effects}", method.name()));
        }
        if method.knows_effects() {
            warnings.extend(followed::remarks(campaign).into_iter().chain(rebound::remark(campaign)));
        }
        warnings.extend(told_by_one_alone(method, campaign));
        Self {
            method: method.name(),
            campaign: campaign.name.clone(),
            kind: campaign.provenance,
            source: campaign.source.clone(),
            declared,
            warnings,
            noise: noise_document(noise),
            runs,
        }
    }
}

/// Of channels of which the method needs one, says of a campaign that has not all which is there alone.
fn told_by_one_alone(method: Method, campaign: &Campaign) -> Option<String> {
    let (there, lacking): (Vec<Channel>, Vec<Channel>) =
        method.needs_one_of().iter().partition(|channel| campaign.column(channel.name()).is_some());
    let ([there], [lacking]) = (&there[..], &lacking[..]) else { return None };
    Some(format!("no {}: the strength of the soil is told by {} alone", lacking.name(), there.name()))
}

fn noise_document(noise: &SensorNoise) -> BTreeMap<&'static str, NoiseDocument> {
    let of_channels = noise.by_channel().into_iter();
    of_channels.map(|(channel, one)| (channel.name(), NoiseDocument { std: one.std, from: one.source })).collect()
}

impl RunDocument {
    /// How many rows were left out of what was identified, and why; none where all were used, or none was, which then is why there is no
    /// estimate.
    pub fn left_out_in_words(&self) -> Option<String> {
        let left_out = &self.rows_left_out;
        (self.rows_used > 0 && !left_out.is_empty()).then(|| {
            let rows = counted(left_out.len() as u64, "row", "rows");
            format!("{rows} left out: {}", reasons_in_words(left_out.iter().map(|row| (row.line, row.reason.as_str()))))
        })
    }

    fn of(run: &IdentifiedRun) -> Self {
        let question = run.question.as_ref();
        let estimate = |answer: &QueryAnswer| answer.rover.as_ref().map(SoilDocument::of_network).unwrap_or_default();
        let mut document = Self {
            refused: run.refused(),
            condition_number: question.and_then(|question| question.condition_number),
            soil: question.map(|question| estimate(&question.answer)).unwrap_or_default(),
            networks: Some(NetworksDocument {
                sinkage_used: question.is_some_and(Question::sinkage_used),
                without_sinkage: question.and_then(|question| question.answer_without_sinkage.as_ref()).map(estimate),
                wheels: question.map(|question| WheelDocument::all(&run.states, question)).unwrap_or_default(),
            }),
            widened: question.and_then(|question| question.missing.as_ref()?.in_words("networks'")),
            beyond_training: run.beyond_training.clone(),
            ..Self::empty(&run.states)
        };
        if document.beyond_training.is_some() {
            document.tell_nothing();
        }
        document
    }

    fn of_finding(states: &RunStates, found: &Result<Finding, String>) -> Self {
        let found = found.as_ref();
        Self {
            refused: found.err().cloned(),
            condition_number: found.ok().and_then(|found| found.condition_number),
            soil: found.map(SoilDocument::of_method).unwrap_or_default(),
            no_soil: found.ok().and_then(|found| found.no_soil.clone()),
            widened: found.ok().and_then(|found| found.widened.clone()),
            remarks: found.map_or_else(|_| Vec::new(), |found| found.remarks.clone()),
            fit: found.ok().and_then(|found| found.fit).map(FitDocument::of),
            ..Self::empty(states)
        }
    }

    fn doubt(&mut self, why: String) {
        self.misfit = Some(why);
        self.tell_nothing();
    }

    /// Calls nothing identifiable where `map` denies what was found.
    fn hold_against(&mut self, found: &Finding, by_map: &ByMap, campaign: &Campaign) {
        if let Some(why) = by_map.denies(found, campaign) {
            self.remarks.push(why);
            self.tell_nothing();
        }
    }

    /// Calls nothing identifiable.
    fn tell_nothing(&mut self) {
        let without_sinkage = self.networks.as_mut().and_then(|networks| networks.without_sinkage.as_mut());
        std::iter::once(&mut self.soil).chain(without_sinkage).for_each(SoilDocument::doubt);
    }

    fn empty(states: &RunStates) -> Self {
        let left_out = |(line, reason): &(u64, String)| LeftOutDocument { line: *line, reason: reason.clone() };
        Self {
            run: states.run.clone(),
            refused: None,
            condition_number: None,
            soil: SoilDocument::default(),
            instants: states.instants,
            rows_used: states.rows_used,
            rows_left_out: states.rows_left_out.iter().map(left_out).collect(),
            no_soil: None,
            misfit: None,
            beyond_training: None,
            remembers: states.states.first().and_then(|state| state.rows_per_reading.in_words()),
            widened: None,
            remarks: Vec::new(),
            fit: None,
            networks: None,
        }
    }
}

impl FitDocument {
    fn of(fit: Fit) -> Self {
        Self { chi_square: fit.chi_square, degrees_of_freedom: fit.degrees_of_freedom, p_value: fit.p_value }
    }
}

impl WheelDocument {
    fn all(states: &RunStates, question: &Question) -> Vec<Self> {
        let wheels = states.states.iter().zip(&question.answer.wheels);
        wheels
            .map(|(state, answer)| Self {
                slip: state.mean.slip,
                load_n: state.mean.load_n,
                drawbar_pull_n: state.mean.drawbar_pull_n,
                torque_nm: state.mean.torque_nm,
                sinkage_m: state.mean.sinkage_m,
                rows: state.rows,
                refused: answer.as_ref().err().map(|refusal| network_refusal(*refusal)),
                soil: answer.as_ref().map(SoilDocument::of_network).unwrap_or_default(),
            })
            .collect()
    }
}
