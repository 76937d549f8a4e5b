//! What a method says of the soil, or why it says nothing.

use crate::scalar::Scalar;

/// Where a value comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// From the observations.
    Estimated,
    /// The method takes it as given.
    Assumed,
}

/// What a method says of one parameter, in the parameter's own unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told<S> {
    /// The value.
    pub value: S,
    /// One standard deviation, where the method itself gives one; of an assumed value, what is believed of it.
    pub std: Option<S>,
    /// Whether the observations, by the method's own account, tell it: its variance is at most half of what is believed
    /// without any observation ([`super::SoilPrior::usual`]), and the value is not at the end of its range.
    pub identifiable: bool,
    /// Where the value comes from.
    pub origin: Origin,
}

/// A value that a method takes as given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Assumed<S> {
    /// The value.
    pub value: S,
    /// How well it is believed to be known: one standard deviation. The method does not look at it.
    pub std: S,
}

/// What a method says of the soil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Identified<S> {
    /// Cohesion c, Pa.
    pub cohesion_pa: Told<S>,
    /// Angle of internal friction φ, rad.
    pub friction_angle_rad: Told<S>,
    /// Shear deformation modulus K, m.
    pub shear_modulus_m: Told<S>,
    /// Greatest over least singular value of the method's own system of equations; its docs say which.
    pub condition_number: S,
}

/// Why a method gives no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// There are fewer observations that the method can use than it needs.
    TooFew {
        /// How many it needs.
        needed: u8,
    },
    /// There are more observations than the method has room for.
    TooMany {
        /// How many it can take.
        room: u8,
    },
    /// The method needs the sinkage of every wheel.
    NoSinkage,
    /// A number is NaN or infinite.
    NotFinite,
    /// Radius, width, load or a standard deviation that is weighed by is not above zero, the slip is outside −1 … 1, or the sinkage is
    /// outside what the method can take.
    OutOfRange,
    /// A stress that the method solves for comes out at zero or below.
    NegativeStress,
    /// The observations are too alike: the least singular value is below their noise.
    NotIdentifiable,
    /// The iteration did not settle.
    NotConverged,
    /// None of the soils that the method chooses from can carry the wheels.
    NoSoilFits,
}

impl<S: Scalar> Told<S> {
    /// An estimated value; `std_ratio` is its standard deviation over the one believed beforehand, both in the unit in
    /// which the belief is normal.
    pub fn estimated(value: S, std: Option<S>, std_ratio: S) -> Self {
        let identifiable = std_ratio * std_ratio <= S::constant(0.5);
        Self { value, std, identifiable, origin: Origin::Estimated }
    }

    /// A value that the method takes as given, and how well it is believed to be known.
    pub fn assumed(value: S, std: S) -> Self {
        Self { value, std: Some(std), identifiable: false, origin: Origin::Assumed }
    }
}
