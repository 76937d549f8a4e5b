//! η of a soil that is not known exactly: the library fits it as what the effect of a rear contact adds to it.

use kapvik_firmware::identification::map::{FreeParameter, MapEstimate};
use kapvik_firmware::identification::{Belief, SoilPrior};

use crate::data::campaign::{Campaign, DeclaredEffect};
use crate::digits::significant;

use super::Evidence;

const EFFECT: &str = "rear-contact";
const PARAMETER: &str = "eta";

/// What is fitted in the place of η; none where it is known, and where a declared effect adds to it: what both add up to is then the effect's.
pub fn free_rebound(evidence: &Evidence) -> Option<FreeParameter<f64>> {
    let belief = Some(evidence.prior.rebound_ratio).filter(|belief| !belief.is_known())?;
    (!is_declared(&evidence.declared)).then_some(FreeParameter { effect: EFFECT, parameter: PARAMETER, belief })
}

/// The prior with nothing in the place of what is fitted.
pub fn without_rebound(prior: &SoilPrior<f64>) -> SoilPrior<f64> {
    SoilPrior { rebound_ratio: Belief::known(0.0), ..*prior }
}

/// Puts what was fitted last in its place in the soil.
pub fn put_back(estimate: &mut MapEstimate<f64>) {
    let Some(eta) = estimate.effects.last().map(|fitted| fitted.mean) else { return };
    [&mut estimate.soil, &mut estimate.mode].into_iter().for_each(|soil| soil.rebound_ratio = eta);
}

/// What is said where η is held though it is not known.
pub fn remark(campaign: &Campaign) -> Option<String> {
    let known = campaign.ground.rebound_ratio.filter(|known| known.std() > 0.0)?;
    is_declared(&campaign.declared.effects).then(|| {
        let middle = significant(known.middle(), 3);
        format!("eta of [soil] is held at {middle}: {EFFECT} is declared, and is what is added to it")
    })
}

fn is_declared(effects: &[DeclaredEffect]) -> bool {
    effects.iter().any(|effect| effect.info.id == EFFECT)
}
