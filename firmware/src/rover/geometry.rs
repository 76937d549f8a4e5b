//! The rover's dimensions.

use serde::{Deserialize, Serialize};

use super::{Axes, Planar, SensorNoise, Side};
use crate::scalar::Scalar;
use crate::terramechanics::Wheel;

/// Where the links are joined and the wheels are hung, m, in the straight position on level ground. The origin is the
/// midpoint of the differential axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Suspension<S> {
    /// Hub of the front wheel, on the rocker.
    pub front_hub: Planar<S>,
    /// Pivot of the bogie, on the rocker.
    pub bogie_pivot: Planar<S>,
    /// Hub of the middle wheel, relative to the bogie pivot.
    pub middle_hub: Planar<S>,
    /// Hub of the rear wheel, relative to the bogie pivot.
    pub rear_hub: Planar<S>,
    /// Distance of the wheels' mid-planes from the body's, m.
    pub half_track_m: S,
    /// Centre of mass, on the body: links and wheels count as massless.
    pub centre_of_mass: Axes<S>,
}

/// What stands between a motor and its wheel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Drive<S> {
    /// Inertia of rotor and gears as the wheel feels it, kg·m².
    pub reflected_inertia_kg_m2: S,
}

/// A rocker-bogie rover.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Rover<S> {
    /// Mass, kg.
    pub mass_kg: S,
    /// Gravity where it drives, m/s².
    pub gravity_m_s2: S,
    /// All six wheels.
    pub wheel: Wheel<S>,
    /// Both sides.
    pub suspension: Suspension<S>,
    /// All six drives.
    pub drive: Drive<S>,
    /// Its sensors.
    pub noise: SensorNoise<S>,
}

/// What is impossible about a rover.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum GeometryError {
    /// Mass or gravity is not a number above zero.
    Weight,
    /// Radius or width of the wheel is not a number above zero.
    Wheel,
    /// A coordinate of the suspension is not a number, or the half track is not above zero.
    Coordinate,
    /// The hubs are not in the order front, middle, rear, or closer than a thousandth of a wheel radius.
    HubOrder,
    /// The bogie pivot is not between its hubs: the bogie would not stand.
    BogiePivot,
    /// The bogie pivot is not above its hubs, or the differential axis not above the front hub, by a thousandth of a
    /// wheel radius: drawbar pull would have no lever arm.
    LeverArm,
    /// The centre of mass is not between front hub and bogie pivot and between the sides: the rover would not stand.
    CentreOfMass,
    /// The reflected inertia is not a number above zero.
    Inertia,
    /// A standard deviation is not a number above zero.
    Noise,
}

impl<S: Scalar> Rover<S> {
    /// The set K0, which is *assumed*: Kapvik's dimensions were not published. Mass and envelope are the Canadian Space
    /// Agency's figures, the rest is what fits between them.
    pub fn assumed() -> Self {
        let at = |x: f64, z: f64| Planar { x: S::constant(x), z: S::constant(z) };
        Self {
            mass_kg: S::constant(41.0),
            gravity_m_s2: S::constant(9.81),
            wheel: Wheel { radius_m: S::constant(0.075), width_m: S::constant(0.070) },
            suspension: Suspension {
                front_hub: at(0.35, -0.20),
                bogie_pivot: at(-0.175, -0.10),
                middle_hub: at(0.175, -0.10),
                rear_hub: at(-0.175, -0.10),
                half_track_m: S::constant(0.355),
                centre_of_mass: Axes { x: S::zero(), y: S::zero(), z: S::constant(0.05) },
            },
            drive: Drive { reflected_inertia_kg_m2: S::constant(2.1) },
            noise: SensorNoise::assumed(),
        }
    }

    /// A sixth of the rover's weight, N: what each wheel bears of a level rover at rest, more or less.
    pub fn load_at_rest_n(&self) -> S {
        self.mass_kg * self.gravity_m_s2 * S::constant(1.0 / 6.0)
    }

    /// Whether such a rover can stand and its forces be told apart.
    ///
    /// # Errors
    /// The first thing that is impossible.
    pub fn check(&self) -> Result<(), GeometryError> {
        let above_zero = |value: S| value > S::zero() && value.is_finite();
        let checks = [
            (above_zero(self.mass_kg) && above_zero(self.gravity_m_s2), GeometryError::Weight),
            (self.wheel.is_valid(), GeometryError::Wheel),
            (self.suspension.is_finite() && above_zero(self.suspension.half_track_m), GeometryError::Coordinate),
            (self.suspension.hubs_are_in_order(self.least_length()), GeometryError::HubOrder),
            (self.suspension.bogie_stands(), GeometryError::BogiePivot),
            (self.suspension.has_lever_arms(self.least_length()), GeometryError::LeverArm),
            (self.suspension.holds_the_centre_of_mass(), GeometryError::CentreOfMass),
            (above_zero(self.drive.reflected_inertia_kg_m2), GeometryError::Inertia),
            (self.noise.is_valid(), GeometryError::Noise),
        ];
        checks.into_iter().find(|(holds, _)| !holds).map_or(Ok(()), |(_, error)| Err(error))
    }

    fn least_length(&self) -> S {
        self.wheel.radius_m * S::constant(1.0e-3)
    }
}

impl<S: Scalar> Suspension<S> {
    /// Where the wheels of a side are across the rover, m, to the left.
    pub fn y_m(&self, side: Side) -> S {
        match side {
            Side::Left => self.half_track_m,
            Side::Right => -self.half_track_m,
        }
    }

    fn is_finite(&self) -> bool {
        let planar = [self.front_hub, self.bogie_pivot, self.middle_hub, self.rear_hub];
        let Axes { x, y, z } = self.centre_of_mass;
        // Without their signs, so that no infinity hides behind another.
        let sum = planar.iter().fold(x.abs() + y.abs() + z.abs(), |sum, point| sum + point.x.abs() + point.z.abs());
        sum.is_finite()
    }

    fn hubs_are_in_order(&self, gap: S) -> bool {
        let middle = self.bogie_pivot + self.middle_hub;
        let rear = self.bogie_pivot + self.rear_hub;
        self.front_hub.x > middle.x + gap && middle.x > rear.x + gap
    }

    fn bogie_stands(&self) -> bool {
        self.middle_hub.x > S::zero() && self.rear_hub.x < S::zero()
    }

    fn has_lever_arms(&self, least: S) -> bool {
        [self.front_hub.z, self.middle_hub.z, self.rear_hub.z].iter().all(|z| *z < -least)
    }

    /// The differential carries the body on its axis and halves its pitching moment between the rockers, so the centre of
    /// mass must be where both rockers can hold it.
    fn holds_the_centre_of_mass(&self) -> bool {
        let centre = self.centre_of_mass;
        centre.x < self.front_hub.x && centre.x > self.bogie_pivot.x && centre.y.abs() < self.half_track_m
    }
}

impl<S> Rover<S> {
    /// The same rover in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T + Copy) -> Rover<T> {
        let Suspension { front_hub, bogie_pivot, middle_hub, rear_hub, half_track_m, centre_of_mass } = self.suspension;
        Rover {
            mass_kg: convert(self.mass_kg),
            gravity_m_s2: convert(self.gravity_m_s2),
            wheel: self.wheel.map(convert),
            suspension: Suspension {
                front_hub: front_hub.map(convert),
                bogie_pivot: bogie_pivot.map(convert),
                middle_hub: middle_hub.map(convert),
                rear_hub: rear_hub.map(convert),
                half_track_m: convert(half_track_m),
                centre_of_mass: centre_of_mass.map(convert),
            },
            drive: Drive { reflected_inertia_kg_m2: convert(self.drive.reflected_inertia_kg_m2) },
            noise: self.noise.map(convert),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{GeometryError, Rover};

    #[test]
    fn the_assumed_rover_is_possible_and_others_are_not() {
        let assumed = Rover::<f64>::assumed();
        assert_eq!(assumed.check(), Ok(()));
        let with = |change: fn(&mut Rover<f64>)| {
            let mut rover = assumed;
            change(&mut rover);
            rover.check()
        };
        assert_eq!(with(|rover| rover.mass_kg = -41.0), Err(GeometryError::Weight));
        assert_eq!(with(|rover| rover.wheel.radius_m = f64::NAN), Err(GeometryError::Wheel));
        assert_eq!(with(|rover| rover.suspension.half_track_m = 0.0), Err(GeometryError::Coordinate));
        assert_eq!(with(|rover| rover.suspension.rear_hub.z = f64::NEG_INFINITY), Err(GeometryError::Coordinate));
        assert_eq!(with(|rover| rover.suspension.front_hub.x = -0.1), Err(GeometryError::HubOrder));
        assert_eq!(with(|rover| rover.suspension.rear_hub.x = 0.1), Err(GeometryError::BogiePivot));
        assert_eq!(with(|rover| rover.suspension.middle_hub.z = 0.0), Err(GeometryError::LeverArm));
        assert_eq!(with(|rover| rover.suspension.centre_of_mass.x = 1.0), Err(GeometryError::CentreOfMass));
        assert_eq!(with(|rover| rover.drive.reflected_inertia_kg_m2 = 0.0), Err(GeometryError::Inertia));
        assert_eq!(with(|rover| rover.noise.load_cell_n = 0.0), Err(GeometryError::Noise));
    }
}
