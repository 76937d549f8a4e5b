//! The residuals of one observation, and how its own unknowns are taken out of them.

use crate::scalar::Scalar;

use super::prediction::{CHANNELS, COLUMNS, LATENTS, Prediction};
use super::unknowns::{Point, UNKNOWNS};
use crate::identification::Observation;
use crate::identification::least_squares::{Triangle, take_in};

/// Residuals of an observation over their standard deviations, and their slopes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rows<S> {
    residuals: [S; CHANNELS],
    slopes: [[S; COLUMNS]; CHANNELS],
    load_by_ln_sinkage: S,
}

/// Two rows that tell the latents of an observation where the shared unknowns are known.
#[derive(Debug, Clone, Copy)]
pub(super) struct LatentRows<S> {
    rows: [[S; COLUMNS]; LATENTS],
    right: [S; LATENTS],
}

impl<S: Scalar> Rows<S> {
    /// What was predicted less what was measured. A channel that was not measured has nothing to say.
    pub fn new(observation: &Observation<S>, prediction: &Prediction<S>, blur: S) -> Self {
        let (state, noise) = (&observation.state, &observation.noise);
        let measured =
            [state.drawbar_pull_n, state.load_n, state.torque_nm, state.slip, state.sinkage_m.unwrap_or(S::zero())];
        let stds = [noise.drawbar_pull_n, noise.load_n, noise.torque_nm, noise.slip, noise.sinkage_m];
        let seen = [true, true, true, true, state.sinkage_m.is_some()];
        let weights: [S; CHANNELS] = core::array::from_fn(|channel| match (seen.get(channel), stds.get(channel)) {
            (Some(true), Some(std)) => S::one() / (*std * blur),
            _ => S::zero(),
        });
        let mut rows = Self {
            residuals: prediction.readings,
            slopes: prediction.slopes,
            load_by_ln_sinkage: prediction.load_by_ln_sinkage,
        };
        for ((residual, measured), weight) in rows.residuals.iter_mut().zip(measured).zip(weights) {
            *residual = (*residual - measured) * weight;
        }
        for (slopes, weight) in rows.slopes.iter_mut().zip(weights) {
            *slopes = slopes.map(|slope| slope * weight);
        }
        rows
    }

    /// Sum of the squares.
    pub fn chi_squared(&self) -> S {
        let mut sum = S::zero();
        for residual in self.residuals {
            sum += residual * residual;
        }
        sum
    }

    /// Takes the latents out: what is left of the rows goes into `shared`; the two rows that tell the latents are returned.
    /// `damping` holds the latents to where they are.
    pub fn eliminate(&self, damping: S, shared: &mut Triangle<S, UNKNOWNS>) -> LatentRows<S> {
        let mut latent = LatentRows { rows: [[S::zero(); COLUMNS]; LATENTS], right: [S::zero(); LATENTS] };
        let lengths = self.latent_lengths();
        for (place, row) in latent.rows.iter_mut().enumerate() {
            if let (Some(slot), Some(length)) = (row.get_mut(place), lengths.get(place)) {
                *slot = damping * *length;
            }
        }
        for (slopes, residual) in self.slopes.iter().zip(self.residuals) {
            let (mut row, mut right) = (*slopes, residual);
            take_in(&mut latent.rows, &mut latent.right, &mut row, &mut right);
            let [_, _, rest @ ..] = row;
            shared.add(rest, -right);
        }
        latent
    }

    /// Length of the columns of the latents.
    fn latent_lengths(&self) -> [S; LATENTS] {
        let mut squares = [S::zero(); LATENTS];
        for slopes in &self.slopes {
            for (square, slope) in squares.iter_mut().zip(slopes) {
                *square += *slope * *slope;
            }
        }
        squares.map(Scalar::sqrt)
    }

    /// Logarithm of the factor that turns a density over (slip, load) into one over (slip, ln z): flat beliefs of the
    /// latents are of slip and load, which do not depend on the soil.
    pub fn ln_load_slope(&self) -> S {
        self.load_by_ln_sinkage.abs().max(S::constant(1e-6)).ln()
    }
}

impl<S: Scalar> LatentRows<S> {
    /// The step of the latents that goes with a step of the shared unknowns.
    pub fn step(&self, shared: &Point<S>) -> [S; LATENTS] {
        let mut small = Triangle::<S, LATENTS>::new();
        for (place, (row, right)) in self.rows.iter().zip(self.right).enumerate() {
            let [first, second, rest @ ..] = row;
            let mut moved = right;
            for (slope, step) in rest.iter().zip(shared) {
                moved += *slope * *step;
            }
            if let (Some(slot), Some(slot_right)) = (small.root.get_mut(place), small.right.get_mut(place)) {
                *slot = [*first, *second];
                *slot_right = -moved;
            }
        }
        small.told_solution()
    }

    /// Sum of squares that the latents alone would take away.
    pub fn square(&self) -> S {
        let [first, second] = self.right;
        first * first + second * second
    }

    /// ln |det| of the latents' block.
    pub fn ln_determinant(&self) -> S {
        let [[first, ..], [_, second, ..]] = self.rows;
        (first * second).abs().max(S::constant(1e-30)).ln()
    }
}
