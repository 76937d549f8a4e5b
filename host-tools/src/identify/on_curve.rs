//! Means over different slips and loads, for methods that take the equations at their word.
//!
//! Forces bend with slip and load, so that their mean over rows is not what the wheel does at the mean slip under the mean load. A method
//! that takes a mean for one state of a wheel is off by that, which no number of rows averages away, and finds that no soil explains the run.
//! By how much, the soil tells that explains the means best, and then that which explains them once they have been moved. (For the networks,
//! see `bend.rs`: they know no soil of their own.)

use crate::data::campaign::Campaign;

use super::SensorNoise;
use super::bend::moved;
use super::combine::MeanState;
use super::layout::Layout;
use super::method::{Evidence, Method, most_probable_soil};

/// Times that the means are moved: what is left is the bend of a soil that is off by as much as the first bend does, squared.
const ROUNDS: usize = 2;

/// What a method is asked about the states of a run. With declared effects means stay where they are, for these bend forces otherwise.
pub fn evidence(method: Method, campaign: &Campaign, noise: &SensorNoise, states: &[MeanState]) -> Evidence {
    let as_measured = Evidence::of_run(campaign, noise, states);
    if !method.is_exact() || !campaign.declared.effects.is_empty() {
        return as_measured;
    }
    let layout = Layout::new(&campaign.wheel, states, noise);
    let moved = if layout.is_mixed() { on_the_curve(&as_measured, &layout) } else { None };
    moved.unwrap_or(as_measured)
}

/// None where no soil explains the means, or the one that does carries not all of the wheels.
fn on_the_curve(as_measured: &Evidence, layout: &Layout) -> Option<Evidence> {
    let mut evidence = as_measured.clone();
    for _ in 0..ROUNDS {
        let bends = layout.bends(&most_probable_soil(&evidence)?)?;
        let seen = as_measured.observations.iter().map(|seen| &seen.state);
        evidence = as_measured.seeing(seen.zip(bends).map(|(state, bend)| moved(state, bend)));
    }
    Some(evidence)
}
