//! What a manoeuvre costs.

use serde::Serialize;

/// What things cost, in seconds of driving.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CostWeights {
    /// A second.
    pub per_second: f64,
    /// A joule at the wheels beyond those of the usual drive in the same time.
    pub per_joule: f64,
    /// A millimetre by which the deepest wheel sinks deeper than in the usual drive.
    pub per_millimetre: f64,
}

impl Default for CostWeights {
    fn default() -> Self {
        Self { per_second: 1.0, per_joule: 1.0, per_millimetre: 1.0 }
    }
}

/// What a manoeuvre takes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Expense {
    /// Time, s.
    pub time_s: f64,
    /// Energy at the wheels beyond that of the usual drive, J; never below zero.
    pub energy_j: f64,
    /// How much deeper the deepest wheel sinks than in the usual drive, m; never below zero.
    pub sinkage_m: f64,
}

impl CostWeights {
    /// The cost.
    pub fn cost(&self, expense: &Expense) -> f64 {
        self.per_second * expense.time_s
            + self.per_joule * expense.energy_j
            + self.per_millimetre * 1e3 * expense.sinkage_m
    }
}
