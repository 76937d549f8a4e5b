//! Three components along the axes of the body.

use serde::{Deserialize, Serialize};

/// One value along each axis of the body: x forward, y left, z up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(bound(serialize = "T: Serialize", deserialize = "T: Deserialize<'de>"))]
pub struct Axes<T> {
    /// Forward.
    #[serde(with = "crate::outlined")]
    pub x: T,
    /// Left.
    #[serde(with = "crate::outlined")]
    pub y: T,
    /// Up.
    #[serde(with = "crate::outlined")]
    pub z: T,
}

impl<T> Axes<T> {
    /// Each value converted.
    pub fn map<U>(self, mut convert: impl FnMut(T) -> U) -> Axes<U> {
        Axes { x: convert(self.x), y: convert(self.y), z: convert(self.z) }
    }

    /// References to the values.
    pub fn as_ref(&self) -> Axes<&T> {
        Axes { x: &self.x, y: &self.y, z: &self.z }
    }

    /// References to the values, to change them.
    pub fn as_mut(&mut self) -> Axes<&mut T> {
        Axes { x: &mut self.x, y: &mut self.y, z: &mut self.z }
    }

    /// The values in the order x, y, z.
    pub fn as_array(&self) -> [&T; 3] {
        [&self.x, &self.y, &self.z]
    }
}

impl<T> Axes<Option<T>> {
    /// All three values, if there are.
    pub fn all(self) -> Option<Axes<T>> {
        Some(Axes { x: self.x?, y: self.y?, z: self.z? })
    }
}
