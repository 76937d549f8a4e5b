//! Least squares by rotations, row by row: no matrix is stored and no product of columns is formed, since the condition
//! number of such products is the square of that of the rows, and single precision has no digits for it.

mod bounds;
mod line;
mod rotation;
mod triangle;

pub use bounds::Bounds;
pub(super) use rotation::take_in;
pub(super) use triangle::Triangle;
