//! What makes a rover impossible, beside what the flight library refuses.

use kapvik_firmware::rover::{GeometryError, Rover, Suspension};

use super::wheel_file::Grousers;

/// Gravity that no place has where a rover drives, m/s².
pub(super) const STRONGEST_M_S2: f64 = 30.0;

/// Why there is no such rover.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoverFault {
    /// The flight library refuses it.
    Geometry(GeometryError),
    /// Gravity is in other units.
    Gravity,
    /// Grousers are higher than the wheel's radius.
    Grousers,
    /// Two wheels of a side stand in the same place.
    WheelsOfASide,
    /// The wheels of the two sides stand in the same place.
    Sides,
    /// The centre of mass is below the ground, or further above the axis than the rover is long and wide together.
    Height,
}

impl RoverFault {
    /// The first that is there.
    pub fn of(rover: &Rover<f64>, grousers: Grousers) -> Option<Self> {
        let Rover { wheel, suspension, .. } = rover;
        // In the numbers of the flight computer, too, which are coarser and end earlier.
        let refused = rover.check().err().or_else(|| rover.map(|number| number as f32).check().err());
        let height = suspension.centre_of_mass.z;
        let faults = [
            (rover.gravity_m_s2 > STRONGEST_M_S2, Self::Gravity),
            (grousers.height_m > wheel.radius_m, Self::Grousers),
            (least_distance_m(suspension) < 2.0 * wheel.radius_m, Self::WheelsOfASide),
            (wheel.width_m > 2.0 * suspension.half_track_m, Self::Sides),
            (height < suspension.front_hub.z - wheel.radius_m || height > size_m(suspension), Self::Height),
        ];
        let implausible = || faults.into_iter().find(|(is_there, _)| *is_there).map(|(_, fault)| fault);
        refused.map(Self::Geometry).or_else(implausible)
    }

    /// What a person is told.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Geometry(error) => geometry_in_words(error),
            Self::Gravity => "no rover drives there: expected a gravity of at most 30 m/s²",
            Self::Grousers => "no wheel has such grousers: expected a height of at most the radius",
            Self::WheelsOfASide => {
                "two wheels of a side would stand in the same place: expected hubs at least two radii from each other"
            }
            Self::Sides => {
                "the wheels of both sides would stand in the same place: expected a half_track of at least half a width"
            }
            Self::Height => {
                "nothing is so heavy there: expected the z of centre_of_mass above the ground, at most the rover's length and width above \
                 the differential axis"
            }
        }
    }
}

/// Between hubs of a side that follow each other, with the bogie level.
fn least_distance_m(suspension: &Suspension<f64>) -> f64 {
    let middle = suspension.bogie_pivot + suspension.middle_hub;
    let rear = suspension.bogie_pivot + suspension.rear_hub;
    let distance = |one: [f64; 2], other: [f64; 2]| f64::hypot(one[0] - other[0], one[1] - other[1]);
    let [front, middle, rear] = [suspension.front_hub, middle, rear].map(|hub| [hub.x, hub.z]);
    distance(front, middle).min(distance(middle, rear))
}

/// Length and width together.
fn size_m(suspension: &Suspension<f64>) -> f64 {
    let rear = suspension.bogie_pivot + suspension.rear_hub;
    suspension.front_hub.x - rear.x + 2.0 * suspension.half_track_m
}

/// What a person is told of a rover that the flight library refuses.
pub fn geometry_in_words(error: GeometryError) -> &'static str {
    match error {
        GeometryError::Weight => "no rover weighs this: expected a mass and a gravity above 0",
        GeometryError::Wheel => "no wheel has this size: expected a radius and a width above 0 m",
        GeometryError::Coordinate => {
            "the suspension is nowhere: expected finite coordinates and a half_track above 0 m"
        }
        GeometryError::HubOrder => {
            "the hubs are out of order: expected front_hub, middle_hub, rear_hub from front to rear"
        }
        GeometryError::BogiePivot => {
            "the bogie would not stand: expected bogie_pivot behind front_hub, middle_hub ahead of it and rear_hub behind"
        }
        GeometryError::LeverArm => {
            "drawbar pull would have no lever arm: expected front_hub below the differential axis (z < 0), middle_hub and \
             rear_hub below the bogie pivot (z < 0)"
        }
        GeometryError::CentreOfMass => {
            "the rover would not stand: expected centre_of_mass between bogie_pivot and front_hub, and between the sides"
        }
        GeometryError::Inertia => "no drive has this inertia: expected reflected_inertia_kg_m2 above 0",
        GeometryError::Noise => "no sensor has this noise: expected standard deviations above 0",
    }
}
