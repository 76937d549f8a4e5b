//! What rover networks say of a campaign's own soil.

use kapvik_firmware::network::RoverTable;
use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate, answer};
use kapvik_firmware::wheel_state::SoilQuery;

use crate::data::campaign::Campaign;
use crate::identify::{IdentifiedRun, identify};
use crate::statistics::{quantile, sorted};
use crate::train::score::rover_posterior;

/// What one network says of a campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct CampaignSoil {
    /// Runs with an estimate.
    pub runs: usize,
    /// Why there is none, where no run has one.
    pub refused: Option<String>,
    /// Runs whose readings lie outside what the network was trained with.
    pub outside: usize,
    /// Of c (Pa), φ (rad) and K (m).
    pub parameters: [SoilColumn; 3],
}

/// What one network says of one parameter; medians over the runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoilColumn {
    /// The estimate.
    pub value: f64,
    /// The 68 % interval.
    pub interval_68: [f64; 2],
    /// Half the distance between the runs' 16th and 84th percentile: how far estimates scatter, of one soil or more.
    pub scatter: f64,
}

/// What each network says of the campaign's runs. Of a campaign that cannot be asked about, as it lacks a column that the networks need, it
/// says why.
pub fn on_campaign(campaign: &Campaign, tables: &[&RoverTable]) -> Vec<CampaignSoil> {
    tables.iter().map(|table| of_table(campaign, table)).collect()
}

fn of_table(campaign: &Campaign, table: &RoverTable) -> CampaignSoil {
    let identified = identify(campaign, &mut |query| {
        let mut said = answer(query);
        // What is refused is refused by its numbers alone, whatever network is asked.
        if said.rover.is_ok() {
            said.rover = Ok(estimate(table, query));
        }
        Ok(said)
    });
    let (runs, missing) = match identified {
        Ok(identification) => (identification.runs, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    let refused = missing.or_else(|| runs.iter().find_map(IdentifiedRun::refused));
    let soils: Vec<SoilEstimate> = runs.iter().filter_map(|run| run.question.as_ref()?.rover().ok().copied()).collect();
    let column =
        |pick: fn(&SoilEstimate) -> ParameterEstimate| SoilColumn::of(&soils.iter().map(pick).collect::<Vec<_>>());
    CampaignSoil {
        runs: soils.len(),
        refused: refused.filter(|_| soils.is_empty()),
        outside: soils.iter().filter(|soil| soil.outside_training_range).count(),
        parameters: [
            column(|soil| soil.cohesion_pa),
            column(|soil| soil.friction_angle_rad),
            column(|soil| soil.shear_modulus_m),
        ],
    }
}

fn estimate(table: &RoverTable, query: &SoilQuery) -> SoilEstimate {
    let (context, wheels) = query.rover_features();
    let inside = table.context.contains(&context) && wheels.iter().all(|wheel| table.wheel.contains(wheel));
    SoilEstimate::new(&rover_posterior(table, query), inside)
}

impl SoilColumn {
    fn of(estimates: &[ParameterEstimate]) -> Self {
        let quantile = |share: f64, pick: &dyn Fn(&ParameterEstimate) -> f32| {
            quantile(&sorted(estimates.iter().map(|estimate| f64::from(pick(estimate)))), share)
        };
        let value = |share| quantile(share, &|estimate| estimate.value);
        Self {
            value: value(0.5),
            interval_68: [0, 1].map(|end| quantile(0.5, &|estimate| estimate.interval_68[end])),
            scatter: 0.5 * (value(0.84) - value(0.16)),
        }
    }
}
