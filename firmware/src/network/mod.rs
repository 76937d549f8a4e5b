//! The multilayer perceptrons that map wheel states to soil: equations 12 and 13 of the seed over frozen weights.
//!
//! Nothing here knows what its inputs mean; [`crate::soil`] does. The build script compiles this folder, too, to
//! reproduce the golden pairs of a table before it is frozen in.

pub mod fixed_point;
mod golden;
mod layer;
mod multiply_accumulate;
mod normalisation;
mod parts;
mod posterior;
mod rover_network;
mod shape;
mod table;
mod wheel_network;

pub use golden::{FLOWN_PAIRS, GOLDEN_PAIRS, RoverGolden, WheelGolden};
pub use layer::{Layer, Weights};
pub use normalisation::Normalisation;
pub use parts::PartVisitor;
pub use posterior::{IntervalFactors, KNOTS, Marginal, Posterior, PosteriorScale};
pub use rover_network::RoverNetwork;
pub use shape::*;
pub use table::{RoverTable, WheelTable, checksum};
pub use wheel_network::WheelNetwork;

use crate::math;

/// Something made of numbers that a trainer sets, a file carries and a checksum covers.
pub trait Numbers {
    /// Calls `see` with each number, in an order that does not change.
    fn for_each(&self, see: &mut impl FnMut(f32));
    /// Calls `set` with a place for each number, in the same order.
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut f32));
}

impl Numbers for f32 {
    fn for_each(&self, see: &mut impl FnMut(f32)) {
        see(*self);
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut f32)) {
        set(self);
    }
}

impl<T: Numbers, const N: usize> Numbers for [T; N] {
    fn for_each(&self, see: &mut impl FnMut(f32)) {
        for_each_of(self, see);
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut f32)) {
        self.iter_mut().for_each(|part| part.for_each_mut(set));
    }
}

/// The numbers of arrays of any length. Unrolled through all layers of a table, the checksum's walk would take 5 KB of the
/// image.
#[cfg_attr(target_arch = "arm", inline(never))]
fn for_each_of<T: Numbers>(parts: &[T], see: &mut impl FnMut(f32)) {
    parts.iter().for_each(|part| part.for_each(see));
}

/// Writes [`Numbers`] for a struct: its fields in the order given.
macro_rules! numbers {
    ($name:ty $(where $size:ident)? : $($field:ident),+) => {
        impl$(<const $size: usize>)? $crate::network::Numbers for $name {
            fn for_each(&self, see: &mut impl FnMut(f32)) {
                $(self.$field.for_each(see);)+
            }
            fn for_each_mut(&mut self, set: &mut impl FnMut(&mut f32)) {
                $(self.$field.for_each_mut(set);)+
            }
        }
    };
}
use numbers;

/// Lists one behind the other; what lacks at the end is zero.
pub fn joined<const N: usize, const PARTS: usize>(parts: [&[f32]; PARTS]) -> [f32; N] {
    let mut all = [0.0; N];
    let mut places = all.iter_mut();
    // Loop in loop: a chained iterator that is asked for one value after the other costs the target three times as much.
    for part in parts {
        for (value, place) in part.iter().zip(&mut places) {
            *place = *value;
        }
    }
    all
}

/// The bipolar sigmoid of equation 13 on every neuron of a layer; `gradient` is its coefficient A.
fn activate<const N: usize>(sums: &mut [f32; N], gradient: f32) {
    let (tiles, rest) = sums.as_chunks_mut();
    activate_tiles(tiles, gradient);
    rest.iter_mut().for_each(|sum| *sum = math::bipolar_sigmoid(*sum, gradient));
}

/// Eight in a turn of the loop, which costs a tenth less than one.
// One copy in the image for layers of all sizes.
#[inline(never)]
fn activate_tiles(tiles: &mut [[f32; 8]], gradient: f32) {
    tiles.iter_mut().for_each(|tile| *tile = tile.map(|sum| math::bipolar_sigmoid(sum, gradient)));
}
