//! Neurons that remember: what they put out is the running mean of their activation.
//!
//! How far a filter may be believed hangs on what the ground was like for seconds, and on how long a sensor has said nothing; what is
//! known of one frame tells little of it. Such a neuron has no weights for what it remembers, only its share of what is new (a leaky
//! integrator: Jaeger et al. 2007, "Optimization and applications of echo state networks with leaky-integrator neurons", without their
//! recurrent weights).

use super::HIDDEN;
use crate::network::fixed_point::{Pair, Quad};

/// Quads of neurons that remember, the last of the hidden layer.
pub const SLOW_QUADS: usize = 4;
/// Neurons that remember.
pub const SLOW: usize = 4 * SLOW_QUADS;
/// Of what is new they take 2 to the power of minus this: half of them remember some thirty frames, the others some 250. A side's network
/// is run in every other frame.
pub const SHARE_BITS: [u32; SLOW_QUADS] = [4, 4, 7, 7];

/// Fraction bits that a remembered mean has more than an activation, so that the smallest change does not get lost.
const FINER: u32 = 14;

/// The running means of the neurons that remember.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DoubtMemory([[i32; 4]; SLOW_QUADS]);

impl DoubtMemory {
    /// Nothing was seen.
    pub const EMPTY: Self = Self([[0; 4]; SLOW_QUADS]);

    /// Takes the activations of a hidden layer, of which the last become their running means. Those stay within what an activation can be,
    /// and so no sum overflows.
    pub fn follow(&mut self, hidden: &mut [Quad; HIDDEN / 4]) {
        let Some(slow) = hidden.last_chunk_mut::<SLOW_QUADS>() else { return };
        for ((quad, means), bits) in slow.iter_mut().zip(&mut self.0).zip(SHARE_BITS) {
            let (pairs, _) = means.as_chunks_mut::<2>();
            for (pair, [first, second]) in quad.iter_mut().zip(pairs) {
                let [new_first, new_second] = pair.halves();
                *pair = Pair::new(followed(first, new_first, bits), followed(second, new_second, bits));
            }
        }
    }
}

/// Takes a share of what is new into a mean, which is returned as an activation is.
fn followed(mean: &mut i32, new: i16, share_bits: u32) -> i16 {
    *mean = mean.wrapping_add((i32::from(new) << FINER).wrapping_sub(*mean) >> share_bits);
    (*mean >> FINER) as i16
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(activation: i16) -> [Quad; HIDDEN / 4] {
        [[Pair::new(activation, activation); 2]; HIDDEN / 4]
    }

    #[test]
    fn the_last_neurons_follow_at_their_own_pace_and_the_others_at_once() {
        let mut memory = DoubtMemory::EMPTY;
        for step in 1..=40 {
            let mut hidden = layer(-20_000);
            memory.follow(&mut hidden);
            let (quick, slow) = hidden.split_at(HIDDEN / 4 - SLOW_QUADS);
            assert!(quick.iter().all(|quad| *quad == layer(-20_000)[0]));
            for (quad, bits) in slow.iter().zip(SHARE_BITS) {
                let expected = -20_000.0 * (1.0 - (1.0 - 0.5_f64.powi(bits as i32)).powi(step));
                for half in quad.iter().flat_map(|pair| pair.halves()) {
                    assert!((f64::from(half) - expected).abs() < 1.1, "{half}, {expected}");
                }
            }
        }
    }

    /// What does not change any more is reached to the last digit, and no change of the greatest activations overflows.
    #[test]
    fn means_reach_what_stays_and_stay_within_it() {
        let mut memory = DoubtMemory::EMPTY;
        for activation in [i16::MAX, i16::MIN, i16::MAX, 1, 0] {
            let mut hidden = layer(activation);
            for _ in 0..4_000 {
                hidden = layer(activation);
                memory.follow(&mut hidden);
            }
            for half in hidden.as_flattened().iter().flat_map(|pair| pair.halves()) {
                assert!((i32::from(half) - i32::from(activation)).abs() <= 1, "{half}, {activation}");
            }
        }
    }
}
