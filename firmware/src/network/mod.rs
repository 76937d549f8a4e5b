//! The multilayer perceptrons that map wheel states to soil: equations 12 and 13 of the seed over frozen weights.
//!
//! Nothing here knows what its inputs mean; [`crate::soil`] does. The build script compiles this folder, too, to
//! reproduce the golden pairs of a table before it is frozen in.

mod golden;
mod layer;
mod normalisation;
mod parts;
mod posterior;
mod rover_network;
mod shape;
mod table;
mod wheel_network;

pub use golden::{GOLDEN_PAIRS, RoverGolden, WheelGolden};
pub use layer::{Layer, Weights};
pub use normalisation::Normalisation;
pub use parts::PartVisitor;
pub use posterior::{IntervalFactors, KNOTS, Marginal, Posterior, PosteriorScale};
pub use rover_network::{RoverActivations, RoverNetwork};
pub use shape::*;
pub use table::{RoverTable, WheelTable, checksum};
pub use wheel_network::{WheelActivations, WheelNetwork};

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
        self.iter().for_each(|part| part.for_each(see));
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut f32)) {
        self.iter_mut().for_each(|part| part.for_each_mut(set));
    }
}

/// Writes [`Numbers`] for a struct: its fields in the order given.
macro_rules! numbers {
    ($name:ty : $($field:ident),+) => {
        impl $crate::network::Numbers for $name {
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

/// The bipolar sigmoid of equation 13 on every neuron of a layer; `gradient` is its coefficient A.
fn activate<const N: usize>(mut sums: [f32; N], gradient: f32) -> [f32; N] {
    sums.iter_mut().for_each(|sum| *sum = math::bipolar_sigmoid(*sum, gradient));
    sums
}
