//! Where the rover is and how it moves: seven coordinates, heading and sideways motion held.

use kapvik_firmware::rover::{Axes, BodyMotion, Link, LinkAngles, Planar, Side};
use nalgebra::SVector;

/// The coordinates, or their rates, in the order of [`Pose`].
pub type Coordinates = SVector<f64, 7>;

/// The coordinates by name; in SI units, or SI units per second where they are rates.
///
/// The body is turned nose-up by the pitch about the world's y, then by the roll about its own x (right-handed: left side
/// up). Its midpoint of the differential axis moves in the plane y = 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pose {
    /// x of the midpoint of the differential axis, m.
    pub x: f64,
    /// Its height, m.
    pub z: f64,
    /// Pitch of the body, nose-up, rad.
    pub pitch: f64,
    /// Roll of the body, left side up, rad.
    pub roll: f64,
    /// Left rocker against the body, nose-up, rad; the right one is its negative.
    pub rocker: f64,
    /// Left bogie against its rocker, nose-up, rad.
    pub bogie_left: f64,
    /// Right bogie against its rocker, nose-up, rad.
    pub bogie_right: f64,
}

impl From<Coordinates> for Pose {
    fn from(coordinates: Coordinates) -> Self {
        let [x, z, pitch, roll, rocker, bogie_left, bogie_right] = coordinates.into();
        Self { x, z, pitch, roll, rocker, bogie_left, bogie_right }
    }
}

impl From<Pose> for Coordinates {
    fn from(pose: Pose) -> Self {
        let Pose { x, z, pitch, roll, rocker, bogie_left, bogie_right } = pose;
        Self::from([x, z, pitch, roll, rocker, bogie_left, bogie_right])
    }
}

impl Pose {
    /// The joints of a side, with their rates.
    pub fn joints(&self, rates: &Self, side: Side) -> LinkAngles<f64> {
        let (sign, bogie, bogie_rate) = match side {
            Side::Left => (1.0, self.bogie_left, rates.bogie_left),
            Side::Right => (-1.0, self.bogie_right, rates.bogie_right),
        };
        LinkAngles {
            rocker: Link { pitch_rad: sign * self.rocker, rate_rad_s: sign * rates.rocker },
            bogie: Link { pitch_rad: bogie, rate_rad_s: bogie_rate },
        }
    }

    /// How the body moves, in its own axes.
    pub fn motion(&self, rates: &Self) -> BodyMotion<f64> {
        let (sine, cosine) = libm::sincos(self.roll);
        BodyMotion {
            velocity_m_s: self.into_body(Axes { x: rates.x, y: 0.0, z: rates.z }),
            turn_rad_s: Axes { x: rates.roll, y: -rates.pitch * cosine, z: rates.pitch * sine },
        }
    }

    /// A vector of the world in the body's axes.
    pub fn into_body(&self, world: Axes<f64>) -> Axes<f64> {
        let ahead = Planar { x: world.x, z: world.z }.turned_back(libm::sincos(self.pitch));
        let (sine, cosine) = libm::sincos(self.roll);
        Axes { x: ahead.x, y: world.y * cosine + ahead.z * sine, z: ahead.z * cosine - world.y * sine }
    }

    /// A vector of the body in the world's axes.
    pub fn into_world(&self, body: Axes<f64>) -> Axes<f64> {
        let (sine, cosine) = libm::sincos(self.roll);
        let up = body.y * sine + body.z * cosine;
        let ahead = Planar { x: body.x, z: up }.turned(libm::sincos(self.pitch));
        Axes { x: ahead.x, y: body.y * cosine - body.z * sine, z: ahead.z }
    }
}
