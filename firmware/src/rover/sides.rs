//! Which wheel: a side and an axle. Collections by place have named fields, so that no index can miss.

use serde::{Deserialize, Serialize};

/// A side of the rover.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Side {
    /// y > 0.
    Left,
    /// y < 0.
    Right,
}

impl Side {
    /// Both sides.
    pub const ALL: PerSide<Self> = PerSide { left: Self::Left, right: Self::Right };
}

/// An axle of the rover.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Axle {
    /// On the rocker.
    Front,
    /// On the bogie, ahead.
    Middle,
    /// On the bogie, behind.
    Rear,
}

impl Axle {
    /// All axles.
    pub const ALL: PerAxle<Self> = PerAxle { front: Self::Front, middle: Self::Middle, rear: Self::Rear };
}

/// One value for each side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(bound(serialize = "T: Serialize", deserialize = "T: Deserialize<'de>"))]
pub struct PerSide<T> {
    /// Of the left side.
    #[serde(with = "crate::outlined")]
    pub left: T,
    /// Of the right side.
    #[serde(with = "crate::outlined")]
    pub right: T,
}

/// One value for each wheel of a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(bound(serialize = "T: Serialize", deserialize = "T: Deserialize<'de>"))]
pub struct PerAxle<T> {
    /// Of the front wheel.
    #[serde(with = "crate::outlined")]
    pub front: T,
    /// Of the middle wheel.
    #[serde(with = "crate::outlined")]
    pub middle: T,
    /// Of the rear wheel.
    #[serde(with = "crate::outlined")]
    pub rear: T,
}

/// One value for each wheel.
pub type PerWheel<T> = PerSide<PerAxle<T>>;

impl<T> PerSide<T> {
    /// The same value on both sides.
    pub fn both(value: T) -> Self
    where
        T: Clone,
    {
        Self { left: value.clone(), right: value }
    }

    /// The value of a side.
    pub fn of(&self, side: Side) -> &T {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// The value of a side, to be changed.
    pub fn of_mut(&mut self, side: Side) -> &mut T {
        match side {
            Side::Left => &mut self.left,
            Side::Right => &mut self.right,
        }
    }

    /// Left, then right.
    pub fn as_array(&self) -> [&T; 2] {
        [&self.left, &self.right]
    }

    /// Left, then right, to be changed.
    pub fn as_array_mut(&mut self) -> [&mut T; 2] {
        [&mut self.left, &mut self.right]
    }

    /// References to the values.
    pub fn as_ref(&self) -> PerSide<&T> {
        PerSide { left: &self.left, right: &self.right }
    }

    /// References to the values, to change them.
    pub fn as_mut(&mut self) -> PerSide<&mut T> {
        PerSide { left: &mut self.left, right: &mut self.right }
    }

    /// Each value converted, left first.
    pub fn map<U>(self, mut convert: impl FnMut(T) -> U) -> PerSide<U> {
        PerSide { left: convert(self.left), right: convert(self.right) }
    }

    /// The values of two collections side by side.
    pub fn zip<U>(self, other: PerSide<U>) -> PerSide<(T, U)> {
        PerSide { left: (self.left, other.left), right: (self.right, other.right) }
    }
}

impl<T> PerAxle<T> {
    /// The same value on each axle.
    pub fn all(value: T) -> Self
    where
        T: Clone,
    {
        Self { front: value.clone(), middle: value.clone(), rear: value }
    }

    /// The values of a front-to-rear array.
    pub fn from_array([front, middle, rear]: [T; 3]) -> Self {
        Self { front, middle, rear }
    }

    /// The value of an axle.
    pub fn of(&self, axle: Axle) -> &T {
        match axle {
            Axle::Front => &self.front,
            Axle::Middle => &self.middle,
            Axle::Rear => &self.rear,
        }
    }

    /// The value of an axle, to be changed.
    pub fn of_mut(&mut self, axle: Axle) -> &mut T {
        match axle {
            Axle::Front => &mut self.front,
            Axle::Middle => &mut self.middle,
            Axle::Rear => &mut self.rear,
        }
    }

    /// Front to rear.
    pub fn as_array(&self) -> [&T; 3] {
        [&self.front, &self.middle, &self.rear]
    }

    /// The values, front to rear.
    pub fn into_array(self) -> [T; 3] {
        [self.front, self.middle, self.rear]
    }

    /// Front to rear, to be changed.
    pub fn as_array_mut(&mut self) -> [&mut T; 3] {
        [&mut self.front, &mut self.middle, &mut self.rear]
    }

    /// References to the values.
    pub fn as_ref(&self) -> PerAxle<&T> {
        PerAxle { front: &self.front, middle: &self.middle, rear: &self.rear }
    }

    /// References to the values, to change them.
    pub fn as_mut(&mut self) -> PerAxle<&mut T> {
        PerAxle { front: &mut self.front, middle: &mut self.middle, rear: &mut self.rear }
    }

    /// Each value converted, front first.
    pub fn map<U>(self, mut convert: impl FnMut(T) -> U) -> PerAxle<U> {
        PerAxle { front: convert(self.front), middle: convert(self.middle), rear: convert(self.rear) }
    }

    /// The values of two collections side by side.
    pub fn zip<U>(self, other: PerAxle<U>) -> PerAxle<(T, U)> {
        PerAxle { front: (self.front, other.front), middle: (self.middle, other.middle), rear: (self.rear, other.rear) }
    }
}

impl<T> PerWheel<T> {
    /// The value of a wheel.
    pub fn of_wheel(&self, side: Side, axle: Axle) -> &T {
        self.of(side).of(axle)
    }

    /// The six values in the order fl, ml, rl, fr, mr, rr.
    pub fn iter_wheels(&self) -> impl Iterator<Item = &T> + Clone {
        self.left.as_array().into_iter().chain(self.right.as_array())
    }

    /// The six values in the order fl, ml, rl, fr, mr, rr, to be changed.
    pub fn iter_wheels_mut(&mut self) -> impl Iterator<Item = &mut T> {
        let PerSide { left, right } = self;
        left.as_array_mut().into_iter().chain(right.as_array_mut())
    }

    /// Each of the six values converted, in the order fl, ml, rl, fr, mr, rr.
    pub fn map_wheels<U>(self, mut convert: impl FnMut(T) -> U) -> PerWheel<U> {
        self.map(|side| side.map(&mut convert))
    }

    /// The values of two collections side by side.
    pub fn zip_wheels<U>(self, other: PerWheel<U>) -> PerWheel<(T, U)> {
        self.zip(other).map(|(a, b)| a.zip(b))
    }
}

#[cfg(test)]
mod tests {
    use super::{Axle, PerAxle, PerSide, Side};

    #[test]
    fn wheels_come_in_the_order_of_the_files() {
        let names = PerSide { left: ["fl", "ml", "rl"], right: ["fr", "mr", "rr"] }.map(PerAxle::from_array);
        assert!(names.iter_wheels().eq(&["fl", "ml", "rl", "fr", "mr", "rr"]));
        assert_eq!(*names.of_wheel(Side::Right, Axle::Middle), "mr");
        let paired = Side::ALL.map(|side| Axle::ALL.map(|axle| (side, axle)));
        assert_eq!(*paired.of_wheel(Side::Right, Axle::Rear), (Side::Right, Axle::Rear));
    }
}
