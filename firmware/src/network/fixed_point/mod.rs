//! Layers of 16-bit whole numbers: half the flash of single precision, and six tenths of its instructions.
//!
//! What goes between layers has 15 fraction bits: an activation a of −1 … 1 is the whole number a · 2¹⁵, within
//! ±32 767. Sums of 32 bits hold the products; shifted right they become sums of 12 fraction bits, −8 … 8, which the
//! activation takes. Host and target give the same bits.

mod activation;
mod gate;
mod layer;
mod multiply_accumulate;
mod pair;
mod rounding;

pub use activation::{ACTIVATION_BITS, SUM_BITS, bipolar_sigmoid};
pub use gate::gated;
pub use layer::{FixedLayer, MAX_WEIGHT_BITS};
pub use pair::{Pair, Quad};
pub use rounding::rounded;

use core::mem::MaybeUninit;

/// The places of a layer's numbers, which are about to be written: zeros ahead, and a copy of what replaced them,
/// would cost the target three instructions a neuron.
fn unwritten<const T: usize>(layer: &mut MaybeUninit<[Quad; T]>) -> &mut [MaybeUninit<Quad>] {
    // SAFETY: an array that may be unwritten and one of places that may be are laid out alike, and demand nothing of
    // what is in them; what is written through one is a `Quad` in the other.
    unsafe { &mut *layer.as_mut_ptr().cast::<[MaybeUninit<Quad>; T]>() }
}
