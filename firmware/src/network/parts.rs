//! The named parts of the tables: what the trainer writes to a file and the build script reads from it.

use super::shape::{ROVER_SHAPE, WHEEL_SHAPE};
use super::{RoverTable, WheelTable, Words};

/// Sees each part of a table in turn.
pub trait PartVisitor {
    /// A part of numbers in single precision: its name in the file, its layer sizes (empty for a plain list), the numbers.
    fn part(&mut self, name: &'static str, shape: &[usize], numbers: &mut impl Words);
    /// A part of whole numbers.
    fn whole_part(&mut self, name: &'static str, shape: &[usize], numbers: &mut impl Words);
}

impl WheelTable {
    /// Shows every part to the visitor.
    pub fn visit_parts(&mut self, visitor: &mut impl PartVisitor) {
        visitor.part("wheel.normalisation", &[], &mut self.normalisation);
        visitor.whole_part("wheel.network", &WHEEL_SHAPE, &mut self.network);
        visitor.part("wheel.posterior", &[], &mut self.posterior);
        visitor.part("wheel.golden", &[], &mut self.golden);
    }
}

impl RoverTable {
    /// Shows every part to the visitor.
    pub fn visit_parts(&mut self, visitor: &mut impl PartVisitor) {
        visitor.part("rover.context", &[], &mut self.context);
        visitor.part("rover.wheel", &[], &mut self.wheel);
        visitor.whole_part("rover.network", &ROVER_SHAPE, &mut self.network);
        visitor.part("rover.posterior", &[], &mut self.posterior);
        visitor.part("rover.golden", &[], &mut self.golden);
    }
}
