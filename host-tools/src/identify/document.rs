//! What `identify` prints: JSON.

use std::collections::BTreeMap;

use kapvik_firmware::soil::{QueryAnswer, SoilEstimate};
use serde::Serialize;

use crate::data::campaign::{Campaign, Channel, Provenance};
use crate::digits::counted;
use crate::prior::{self, Range};

use super::followed;
use super::method::{Finding, Fit, Method, Statement, network_refusal, rebound};
use super::misfit::{misfits, misfits_of};
use super::network::{Identification, IdentifiedRun, Question, at_edge};
use super::run_states::{RunStates, reasons_in_words};
use super::sensor_noise::{ChannelStd, NoiseSource, SensorNoise};

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

/// A soil; null in everything where there is no estimate.
#[derive(Debug, Clone, Default, Serialize)]
pub struct SoilDocument {
    /// c, Pa.
    pub cohesion_pa: Option<ParameterDocument>,
    /// φ, rad.
    pub friction_angle_rad: Option<ParameterDocument>,
    /// K, m.
    pub shear_modulus_m: Option<ParameterDocument>,
    #[serde(skip_serializing_if = "Option::is_none")]
    outside_training_range: Option<bool>,
}

/// One parameter.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ParameterDocument {
    /// The value.
    pub value: f64,
    /// One standard deviation; null where neither the method nor the bootstrap gives one.
    pub std: Option<f64>,
    /// Whether the data tell it.
    pub identifiable: bool,
    /// Whether the method takes it as given.
    pub assumed: bool,
    /// At the end of what the networks were trained for, beyond which they cannot go: to be doubted, however narrow.
    #[serde(skip_serializing_if = "Option::is_none")]
    at_edge_of_training: Option<bool>,
    interval_68: [f64; 2],
    interval_95: [f64; 2],
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
        let misfits = match method {
            Method::Map => misfits_of(campaign, noise, runs.iter().filter_map(fit)),
            _ => misfits(&method.sees(campaign), noise),
        };
        let runs = runs.iter().map(|(states, found)| RunDocument::of_finding(states, found)).collect();
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
    let entry = |channel: Channel, std: ChannelStd| (channel.name(), NoiseDocument { std: std.std, from: std.source });
    BTreeMap::from([
        entry(Channel::DrawbarPull, noise.drawbar_pull),
        entry(Channel::Load, noise.load),
        entry(Channel::Torque, noise.torque),
        entry(Channel::Slip, noise.slip),
        entry(Channel::Sinkage, noise.sinkage),
    ])
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
        Self {
            refused: run.refused(),
            condition_number: question.and_then(|question| question.condition_number),
            soil: question.map(|question| estimate(&question.answer)).unwrap_or_default(),
            networks: Some(NetworksDocument {
                sinkage_used: question.is_some_and(Question::sinkage_used),
                without_sinkage: question.and_then(|question| question.answer_without_sinkage.as_ref()).map(estimate),
                wheels: question.map(|question| WheelDocument::all(&run.states, question)).unwrap_or_default(),
            }),
            widened: question.and_then(|question| question.missing.as_ref()?.in_words("networks'")),
            ..Self::empty(&run.states)
        }
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

impl SoilDocument {
    fn doubt(&mut self) {
        let parameters = [&mut self.cohesion_pa, &mut self.friction_angle_rad, &mut self.shear_modulus_m];
        parameters.into_iter().flatten().for_each(|parameter| parameter.identifiable = false);
    }

    fn of_method(found: &Finding) -> Self {
        let [cohesion, friction, shear] = found.statements().map(|statement| Some(ParameterDocument::of(statement)));
        Self {
            cohesion_pa: cohesion,
            friction_angle_rad: friction,
            shear_modulus_m: shear,
            outside_training_range: None,
        }
    }

    fn of_network(estimate: &SoilEstimate) -> Self {
        let mut soil = Self::of_method(&Finding::from(estimate));
        let at_edge_of = |parameter: &mut Option<ParameterDocument>, trained: Range| {
            if let Some(parameter) = parameter {
                parameter.at_edge_of_training = Some(at_edge(trained, parameter.value));
            }
        };
        at_edge_of(&mut soil.cohesion_pa, prior::COHESION_PA);
        at_edge_of(&mut soil.friction_angle_rad, prior::FRICTION_ANGLE_RAD);
        at_edge_of(&mut soil.shear_modulus_m, prior::SHEAR_MODULUS_M);
        Self { outside_training_range: Some(estimate.outside_training_range), ..soil }
    }
}

impl ParameterDocument {
    fn of(statement: &Statement) -> Self {
        Self {
            value: statement.value,
            std: Some(statement.std).filter(|std| std.is_finite()),
            identifiable: statement.identifiable,
            assumed: statement.assumed,
            at_edge_of_training: None,
            interval_68: statement.interval_68,
            interval_95: statement.interval_95,
        }
    }
}
