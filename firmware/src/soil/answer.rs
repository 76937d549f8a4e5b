//! The answer to a query.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::wheel_state::WHEELS;

use super::{Refusal, SoilEstimate};

/// The answer to a [`crate::wheel_state::SoilQuery`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QueryAnswer {
    /// The soil under each wheel by itself, in the order of the query; the per-wheel network, which needs no sinkage.
    pub wheels: Vec<Result<SoilEstimate, Refusal>, WHEELS>,
    /// The soil under all wheels together; the rover network, which uses sinkage where every wheel has it.
    pub rover: Result<SoilEstimate, Refusal>,
}

impl QueryAnswer {
    /// The same refusal for the rover and for each of `wheels` wheels.
    pub fn refused(wheels: usize, reason: Refusal) -> Self {
        let mut answer = Self { wheels: Vec::new(), rover: Err(reason) };
        (0..wheels).for_each(|_| answer.push(Err(reason)));
        answer
    }

    /// Adds what the next wheel says. A query has no more wheels than an answer has room for.
    pub fn push(&mut self, wheel: Result<SoilEstimate, Refusal>) {
        // Not `collect`: heapless panics where it overflows.
        let _ = self.wheels.push(wheel);
    }
}
