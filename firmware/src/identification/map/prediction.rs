//! What the sensors of a wheel should read, and how that changes with every unknown.

use crate::scalar::Scalar;
use crate::terramechanics::Wheel;
use crate::terramechanics::effects::Conditions;

use super::unknowns::{Point, UNKNOWNS, Unknowns};

/// What is unknown of one observation.
pub(super) const LATENTS: usize = 2;
/// Columns of the slopes: ln z, slip, then the unknowns that are shared.
pub(super) const COLUMNS: usize = LATENTS + UNKNOWNS;
/// Channels: drawbar pull, load, torque, slip, sinkage.
pub(super) const CHANNELS: usize = 5;

/// The true sinkage and slip of an observation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Latents<S> {
    /// ln z, z in m.
    pub ln_sinkage: S,
    /// Slip, −1 … 1.
    pub slip: S,
}

/// Readings of drawbar pull, load, torque, slip and sinkage.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prediction<S> {
    /// The readings, in their units.
    pub readings: [S; CHANNELS],
    /// Their changes with ln z, the slip, and the coordinates of the unknowns.
    pub slopes: [[S; COLUMNS]; CHANNELS],
    /// Change of the true load with ln z, N.
    pub load_by_ln_sinkage: S,
}

/// What the readings follow from: equations 1–11, or these with effects. An image links only the one that it calls.
pub(super) trait Model<S> {
    /// The readings, with their slopes by the unknowns in the units of the beliefs; none where the equations do not hold.
    fn read(&self, at: &Asked<'_, S>) -> Option<Prediction<S>>;
}

/// What a model is asked.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked<'a, S> {
    pub wheel: &'a Wheel<S>,
    pub unknowns: &'a Unknowns<S>,
    pub conditions: &'a Conditions<S>,
    /// The load that effects of the load see, N.
    pub load_n: S,
    pub point: &'a Point<S>,
    pub latents: &'a Latents<S>,
}

/// A wheel on a soil as a function of the unknowns.
#[derive(Clone, Copy)]
pub(super) struct Forward<'a, S> {
    pub wheel: &'a Wheel<S>,
    pub unknowns: &'a Unknowns<S>,
    pub model: &'a dyn Model<S>,
}

impl<S: Scalar> Forward<'_, S> {
    /// The readings at a point, with their slopes by its coordinates; none where the equations do not hold.
    pub fn predict(
        &self,
        conditions: &Conditions<S>,
        load_n: S,
        point: &Point<S>,
        latents: &Latents<S>,
    ) -> Option<Prediction<S>> {
        let (wheel, unknowns) = (self.wheel, self.unknowns);
        let mut prediction = self.model.read(&Asked { wheel, unknowns, conditions, load_n, point, latents })?;
        let by_coordinate: Point<S> = core::array::from_fn(|place| unknowns.slope(place, point));
        for slopes in &mut prediction.slopes {
            for (slope, by_coordinate) in slopes.iter_mut().skip(LATENTS).zip(by_coordinate) {
                *slope = *slope * by_coordinate;
            }
        }
        let finite = prediction.readings.iter().chain(prediction.slopes.iter().flatten()).all(|n| n.is_finite());
        finite.then_some(prediction)
    }
}
