//! Vectors in the plane of one side of the rover.

use core::ops::{Add, Sub};

use serde::{Deserialize, Serialize};

use crate::scalar::Scalar;

/// A position, velocity or force in the plane of a side.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Planar<S> {
    /// Forward.
    pub x: S,
    /// Up.
    pub z: S,
}

impl<S> Planar<S> {
    /// The same vector in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> Planar<T> {
        Planar { x: convert(self.x), z: convert(self.z) }
    }
}

impl<S: Scalar> Planar<S> {
    /// The unit vector at an angle of which sine and cosine are given, nose-up from x.
    pub fn direction((sine, cosine): (S, S)) -> Self {
        Self { x: cosine, z: sine }
    }

    /// Turned nose-up by the angle of which sine and cosine are given.
    pub fn turned(self, (sine, cosine): (S, S)) -> Self {
        Self { x: self.x * cosine - self.z * sine, z: self.x * sine + self.z * cosine }
    }

    /// Turned nose-down by the angle of which sine and cosine are given: into the coordinates of a link at that angle.
    pub fn turned_back(self, (sine, cosine): (S, S)) -> Self {
        self.turned((-sine, cosine))
    }

    /// The velocity of a point at this place on a body that turns nose-up at `rate_rad_s`.
    pub fn swept(self, rate_rad_s: S) -> Self {
        Self { x: -self.z * rate_rad_s, z: self.x * rate_rad_s }
    }

    /// Moment about the origin of `force` at this place, N·m, positive about y: nose-down.
    pub fn moment_nm(self, force: Self) -> S {
        self.z * force.x - self.x * force.z
    }

    /// The scalar product.
    pub fn dot(self, other: Self) -> S {
        self.x * other.x + self.z * other.z
    }

    /// `factor` times as long.
    pub fn scaled(self, factor: S) -> Self {
        Self { x: self.x * factor, z: self.z * factor }
    }

    /// Length.
    pub fn length(self) -> S {
        self.dot(self).sqrt()
    }
}

impl<S: Scalar> Add for Planar<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, z: self.z + other.z }
    }
}

impl<S: Scalar> Sub for Planar<S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, z: self.z - other.z }
    }
}
