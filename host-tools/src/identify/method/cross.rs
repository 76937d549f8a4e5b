//! The earlier network, trained for the wheel and the loads that it is asked about.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock, PoisonError};

use crate::train::cross::{CrossNetwork, Scope, train};

use super::{Evidence, Finding, method_refusal};

/// Of the network's examples and first weights.
const SEED: u64 = 1;
/// Loads of one network lie within this factor, up and down, of a middle; middles are such a factor apart.
const LOAD_FACTOR: f64 = 1.8;

/// Networks that have been trained, by wheel and middle of the loads.
type Trained = HashMap<[u64; 3], Arc<OnceLock<CrossNetwork>>>;

/// The mean of what the network says of each wheel.
///
/// # Errors
/// The refusal, in words.
pub fn cross(evidence: &Evidence) -> Result<Finding, String> {
    let scope = scope(evidence);
    let place = place(&scope);
    // Whoever waits here needs the same network.
    let network = place.get_or_init(|| train(&scope, SEED).network);
    let identified = network.identify(&evidence.observations);
    identified.map(|identified| Finding::from(&identified)).map_err(method_refusal)
}

/// Where the network of a scope stands once it is trained.
fn place(scope: &Scope) -> Arc<OnceLock<CrossNetwork>> {
    static TRAINED: LazyLock<Mutex<Trained>> = LazyLock::new(Mutex::default);
    let key = [scope.wheel.radius_m, scope.wheel.width_m, scope.load_n.low].map(f64::to_bits);
    TRAINED.lock().unwrap_or_else(PoisonError::into_inner).entry(key).or_default().clone()
}

fn scope(evidence: &Evidence) -> Scope {
    let loads = evidence.observations.iter().map(|seen| seen.state.load_n);
    let kapvik = Scope::KAPVIK;
    if evidence.wheel == kapvik.wheel
        && loads.clone().all(|load_n| kapvik.load_n.low <= load_n && load_n <= kapvik.load_n.high)
    {
        return kapvik;
    }
    let mean_load_n = loads.sum::<f64>() / evidence.observations.len().max(1) as f64;
    let middle_n = LOAD_FACTOR.powf(mean_load_n.max(f64::MIN_POSITIVE).log(LOAD_FACTOR).round());
    Scope::around(evidence.wheel, middle_n / LOAD_FACTOR, middle_n * LOAD_FACTOR)
}
