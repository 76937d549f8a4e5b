//! What Gauss and Newton's matrix leaves out of the curvature: the model's own.
//!
//! Along a valley that bends, steps by the products of first derivatives alone overshoot from side to side. How the slope
//! changed over the last steps tells the missing part (a secant correction after Dennis, Gay & Welsch 1981, ACM Trans. Math.
//! Softw. 7:348, by the symmetric rank-one formula).

use nalgebra::{DMatrix, DVector};

use super::normal_equations::NormalEquations;

/// Cosine between the correction's direction and the step below which the rank-one formula says nothing.
const LEAST_COSINE: f64 = 1e-8;
/// Share of Gauss and Newton's curvature that a correction must leave in every direction.
const LEAST_SHARE: f64 = 0.2;

/// A correction to the curvature of the parameters, learned along the way.
#[derive(Default)]
pub(super) struct Curvature {
    correction: Option<DMatrix<f64>>,
    /// Where the last equations were made, and their pull.
    last: Option<(DVector<f64>, DVector<f64>)>,
}

impl Curvature {
    /// Learns from the slope at a new place.
    pub(super) fn see(&mut self, parameters: &DVector<f64>, equations: &NormalEquations) {
        let here = (parameters.clone(), equations.pull.clone());
        let Some((place, pull)) = self.last.replace(here) else { return };
        let step = parameters - place;
        if step.iter().all(|step| *step == 0.0) {
            return;
        }
        let mut correction = self.correction.take().unwrap_or_else(|| equations.information.map(|_| 0.0));
        let missing = pull - &equations.pull - (&equations.information + &correction) * &step;
        let along = missing.dot(&step);
        if along.abs() > LEAST_COSINE * missing.norm() * step.norm() {
            correction.ger(1.0 / along, &missing, &missing, 1.0);
        }
        self.correction = Some(correction);
    }

    /// The curvature with the correction, or without it where it would leave too little.
    pub(super) fn corrected(&self, information: &DMatrix<f64>) -> DMatrix<f64> {
        let Some(correction) = &self.correction else { return information.clone() };
        let enough = (information * (1.0 - LEAST_SHARE) + correction).cholesky().is_some();
        if enough { information + correction } else { information.clone() }
    }

    /// The slope is about to change at the same place: nothing is to be learned from that.
    pub(super) fn look_away(&mut self) {
        self.last = None;
    }

    /// Forgets the correction.
    pub(super) fn forget(&mut self) {
        self.correction = None;
    }
}
