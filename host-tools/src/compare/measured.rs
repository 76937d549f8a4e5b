//! One wheel at six slips, measured: the soil is known by direct tests.

use std::path::Path;

use rayon::prelude::*;
use serde::Serialize;

use crate::data::campaign::{Campaign, Carried, Declared};
use crate::error::HostError;
use crate::identify::{Method, RunDocument, identify_by};

/// What a method says of the measured figures.
#[derive(Debug, Clone, Serialize)]
pub struct MeasuredRow {
    /// The method.
    pub method: &'static str,
    /// The effects that it is told of.
    pub declared: Vec<String>,
    /// What it says.
    #[serde(flatten)]
    pub found: RunDocument,
}

/// What the diagnosis of these figures finds to be missing from equations 1–11.
const DECLARED: &str = "[declared]\neffects = [\"slip-sinkage\", \"interface-friction\"]\n";

/// What every method says of the figures of Ding et al. 2011. Plate tests tell n and the stiffness; c, φ and K are kept
/// from the methods.
///
/// # Errors
/// Never in practice: the figures are part of this program, and tested.
pub fn measured() -> Result<Vec<MeasuredRow>, HostError> {
    let mut campaign = Carried::Ding2011Smooth.campaign()?;
    let ground = &mut campaign.ground;
    (ground.cohesion_pa, ground.friction_angle_rad, ground.shear_modulus_m) = (None, None, None);
    let mut rows = rows(&campaign, &Method::ALL)?;
    campaign.declared = Declared::parse(Path::new("declared.toml"), DECLARED)?;
    let knowing: Vec<Method> = Method::ALL.into_iter().filter(|method| method.knows_effects()).collect();
    rows.extend(self::rows(&campaign, &knowing)?);
    Ok(rows)
}

fn rows(campaign: &Campaign, methods: &[Method]) -> Result<Vec<MeasuredRow>, HostError> {
    let row = |method: &Method| -> Result<Vec<MeasuredRow>, HostError> {
        let (method, declared) = (*method, campaign.declared.ids());
        let row = |found| MeasuredRow { method: method.name(), declared: declared.clone(), found };
        Ok(identify_by(method, campaign)?.into_runs().into_iter().map(row).collect())
    };
    let rows: Vec<_> = methods.par_iter().map(row).collect::<Result<_, HostError>>()?;
    Ok(rows.into_iter().flatten().collect())
}
