//! Where a fit starts.

use super::model::{Latent, Model};
use super::observation::{Reading, Row};
use super::state::Scales;

/// A true slip when no row of a campaign measures one.
const SLIP: f64 = 0.2;
/// A true load, N, when no row of a campaign measures one.
const LOAD_N: f64 = 50.0;
/// A sinkage, m, when no row of a campaign measures one.
const SINKAGE_M: f64 = 0.01;

/// Where a fit starts.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// One value per coordinate; what lies out of bounds is moved onto them.
    pub parameters: Vec<f64>,
    /// One per row of the campaign.
    pub latents: Vec<Latent>,
    /// Standard deviations of offsets and noise where there is a guess of them. Of those that are estimated.
    pub scales: Option<Scales>,
}

impl Start {
    /// At the model's own start, with the latents as they were measured.
    pub fn of(model: &dyn Model, rows: &[Row]) -> Self {
        Self::at(model.coordinates().iter().map(|coordinate| coordinate.start).collect(), rows)
    }

    /// At some parameters, with the latents as they were measured, or as they were in the mean where a row measures none.
    pub fn at(parameters: Vec<f64>, rows: &[Row]) -> Self {
        let mean = |reading: Reading, otherwise: f64| {
            let measured: Vec<f64> = rows.iter().filter_map(|row| row.readings[reading.index()]).collect();
            if measured.is_empty() { otherwise } else { measured.iter().sum::<f64>() / measured.len() as f64 }
        };
        let slip = mean(Reading::Slip, SLIP);
        let load_n = mean(Reading::Load, LOAD_N);
        let sinkage_m = mean(Reading::Sinkage, SINKAGE_M);
        let latent = |row: &Row| Latent {
            slip: row.readings[Reading::Slip.index()].unwrap_or(slip),
            load_n: row.readings[Reading::Load.index()].unwrap_or(load_n),
            sinkage_m: row.readings[Reading::Sinkage.index()].unwrap_or(sinkage_m),
        };
        Self { parameters, latents: rows.iter().map(latent).collect(), scales: None }
    }
}
