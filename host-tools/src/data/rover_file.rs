//! The rover file: dimensions, drives and sensors of a rocker-bogie.

use std::ops::Range;
use std::path::Path;

use kapvik_firmware::rover::{Axes, Planar, Rover};
use serde::Deserialize;
use serde_aux::serde_introspection::serde_introspect;
use toml::Spanned;

use super::assumed_keys::AssumedKeys;
use super::rover_fault::RoverFault;
use super::toml_file::TomlFile;
use super::wheel_file::{Grousers, LARGEST_M};
use crate::error::HostError;

type Number = Option<Spanned<f64>>;
type Point<const N: usize> = Option<Spanned<Coordinates<N>>>;

/// As many numbers as there are axes. By way of a list, for an array takes the first of too many.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "Vec<f64>")]
struct Coordinates<const N: usize>([f64; N]);

impl<const N: usize> TryFrom<Vec<f64>> for Coordinates<N> {
    type Error = String;
    fn try_from(numbers: Vec<f64>) -> Result<Self, String> {
        let found = numbers.len();
        numbers.try_into().map(Self).map_err(|_| format!("{found} numbers: expected {N}"))
    }
}

/// A rover as a file describes it. A key that is absent takes the value of the assumed set K0.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
struct RoverTable {
    mass_kg: Number,
    gravity_m_s2: Number,
    wheel: WheelKeys,
    suspension: SuspensionKeys,
    drive: DriveKeys,
    noise: NoiseKeys,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WheelKeys {
    radius_m: Number,
    width_m: Number,
    grouser_height_m: Number,
    grouser_count: Option<u32>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct SuspensionKeys {
    front_hub: Point<2>,
    bogie_pivot: Point<2>,
    middle_hub: Point<2>,
    rear_hub: Point<2>,
    half_track: Number,
    centre_of_mass: Point<3>,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct DriveKeys {
    reflected_inertia_kg_m2: Number,
}

#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct NoiseKeys {
    wheel_rate_rad_s: Number,
    motor_torque_nm: Number,
    load_cell_n: Number,
    angle_rad: Number,
    accel_m_s2: Number,
    gyro_rad_s: Number,
    velocity_m_s: Number,
}

/// Mass that no rover exceeds, kg, and distance from the differential axis that no part of one has, m: beyond them a file is in
/// other units.
const HEAVIEST_KG: f64 = 20_000.0;
const FARTHEST_M: f64 = 20.0;
/// Grousers of K0.
const GROUSERS: Grousers = Grousers { height_m: 0.005, count: 24 };

/// A rover with what the equations leave out.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverFile {
    /// The rover.
    pub rover: Rover<f64>,
    /// The grousers of its wheels, which act only through an effect.
    pub grousers: Grousers,
    /// What of the rover it does not say; of its grousers nothing is told.
    pub assumed: AssumedKeys,
}

impl RoverFile {
    /// The assumed set K0, which an empty file describes.
    pub fn assumed() -> Self {
        RoverTable::default().described()
    }

    /// That of a file, or the assumed one where none is given.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_or_assumed(path: Option<&Path>) -> Result<Self, HostError> {
        path.map_or_else(|| Ok(Self::assumed()), Self::read)
    }

    /// Reads a rover file.
    ///
    /// # Errors
    /// Where the file cannot be read, a key is misspelt, unknown in its table or of the wrong kind, or no rover of that geometry can stand: at the
    /// key that is to blame.
    pub fn read(path: &Path) -> Result<Self, HostError> {
        Self::parse(&TomlFile::read(path)?)
    }

    /// The rover of a file that is in memory.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(file: &TomlFile) -> Result<Self, HostError> {
        let in_tables = [
            serde_introspect::<WheelKeys>(),
            serde_introspect::<SuspensionKeys>(),
            serde_introspect::<DriveKeys>(),
            serde_introspect::<NoiseKeys>(),
        ];
        let (table, unused): (RoverTable, _) = file.whole_and_more(&in_tables)?;
        table.check_units(file)?;
        if let Some(fault) = table.fault() {
            let place = table.to_blame(fault).map_or(0, |span| span.start);
            return Err(file.error_at_offset(place, fault.in_words()));
        }
        unused.tell();
        Ok(table.described())
    }
}

impl RoverTable {
    /// Refuses numbers that are in other units than the format's, or below what they count from.
    fn check_units(&self, file: &TomlFile) -> Result<(), HostError> {
        let SuspensionKeys { front_hub, bogie_pivot, middle_hub, rear_hub, half_track, .. } = &self.suspension;
        let numbers = [
            ("mass_kg", &self.mass_kg, HEAVIEST_KG, "kg"),
            ("radius_m", &self.wheel.radius_m, LARGEST_M, "m"),
            ("width_m", &self.wheel.width_m, LARGEST_M, "m"),
            ("half_track", half_track, FARTHEST_M, "m"),
        ];
        for (name, number, most, unit) in numbers {
            if let Some(number) = number.as_ref().filter(|number| is_beyond(*number.get_ref(), most)) {
                let message = format!("{name} = {}: expected {unit}, at most {most}", number.get_ref());
                return Err(file.error_at(number, message));
            }
        }
        super::wheel_file::check_grouser_height(self.wheel.grouser_height_m.as_ref(), file)?;
        let points = [
            ("front_hub", front_hub),
            ("bogie_pivot", bogie_pivot),
            ("middle_hub", middle_hub),
            ("rear_hub", rear_hub),
        ];
        for (name, point) in points {
            let is_far =
                |point: &&Spanned<Coordinates<2>>| point.get_ref().0.iter().any(|place| is_beyond(*place, FARTHEST_M));
            if let Some(point) = point.as_ref().filter(is_far) {
                return Err(file.error_at(point, format!("{name}: expected metres, at most {FARTHEST_M}")));
            }
        }
        Ok(())
    }

    fn described(&self) -> RoverFile {
        let of_rover = KEYS.iter().filter(|(key, _)| *key != GROUSER_HEIGHT);
        let absent: Vec<_> = of_rover.map(|(key, take)| (*key, take(&mut self.clone()).is_none())).collect();
        RoverFile { rover: self.rover(), grousers: self.grousers(), assumed: AssumedKeys::of(&absent) }
    }

    fn rover(&self) -> Rover<f64> {
        let mut rover = Rover::assumed();
        let (suspension, noise) = (&mut rover.suspension, &mut rover.noise);
        let numbers = [
            (&self.mass_kg, &mut rover.mass_kg),
            (&self.gravity_m_s2, &mut rover.gravity_m_s2),
            (&self.wheel.radius_m, &mut rover.wheel.radius_m),
            (&self.wheel.width_m, &mut rover.wheel.width_m),
            (&self.suspension.half_track, &mut suspension.half_track_m),
            (&self.drive.reflected_inertia_kg_m2, &mut rover.drive.reflected_inertia_kg_m2),
            (&self.noise.wheel_rate_rad_s, &mut noise.wheel_rate_rad_s),
            (&self.noise.motor_torque_nm, &mut noise.motor_torque_nm),
            (&self.noise.load_cell_n, &mut noise.load_cell_n),
            (&self.noise.angle_rad, &mut noise.angle_rad),
            (&self.noise.accel_m_s2, &mut noise.accel_m_s2),
            (&self.noise.gyro_rad_s, &mut noise.gyro_rad_s),
            (&self.noise.velocity_m_s, &mut noise.velocity_m_s),
        ];
        for (given, place) in numbers {
            *place = given.as_ref().map_or(*place, |number| *number.get_ref());
        }
        let points = [
            (&self.suspension.front_hub, &mut suspension.front_hub),
            (&self.suspension.bogie_pivot, &mut suspension.bogie_pivot),
            (&self.suspension.middle_hub, &mut suspension.middle_hub),
            (&self.suspension.rear_hub, &mut suspension.rear_hub),
        ];
        for (given, place) in points {
            if let Some([x, z]) = given.as_ref().map(|point| point.get_ref().0) {
                *place = Planar { x, z };
            }
        }
        if let Some([x, y, z]) = self.suspension.centre_of_mass.as_ref().map(|point| point.get_ref().0) {
            suspension.centre_of_mass = Axes { x, y, z };
        }
        rover
    }

    fn grousers(&self) -> Grousers {
        let WheelKeys { grouser_height_m, grouser_count, .. } = &self.wheel;
        Grousers {
            height_m: grouser_height_m.as_ref().map_or(GROUSERS.height_m, |height| *height.get_ref()),
            count: grouser_count.unwrap_or(GROUSERS.count),
        }
    }

    fn fault(&self) -> Option<RoverFault> {
        RoverFault::of(&self.rover(), self.grousers())
    }

    /// Where the key stands without which a fault would not be there; where it takes several, the last of these.
    fn to_blame(&self, fault: RoverFault) -> Option<Range<usize>> {
        let is_cause = |table: &Self| table.fault() != Some(fault);
        let alone = || {
            KEYS.iter().find_map(|(_, take)| {
                let mut without = self.clone();
                take(&mut without).filter(|_| is_cause(&without))
            })
        };
        let together = || {
            let mut without = self.clone();
            KEYS.iter().find_map(|(_, take)| take(&mut without).filter(|_| is_cause(&without)))
        };
        alone().or_else(together)
    }
}

/// Takes a key out of a table, and says where it stood.
type TakeKey = fn(&mut RoverTable) -> Option<Range<usize>>;

/// What moves no estimate: grousers act only through an effect.
const GROUSER_HEIGHT: &str = "wheel.grouser_height_m";
/// Each key with its table, in the order of the format.
const KEYS: [(&str, TakeKey); 19] = [
    ("mass_kg", |table| span(table.mass_kg.take())),
    ("gravity_m_s2", |table| span(table.gravity_m_s2.take())),
    ("wheel.radius_m", |table| span(table.wheel.radius_m.take())),
    ("wheel.width_m", |table| span(table.wheel.width_m.take())),
    (GROUSER_HEIGHT, |table| span(table.wheel.grouser_height_m.take())),
    ("suspension.front_hub", |table| span(table.suspension.front_hub.take())),
    ("suspension.bogie_pivot", |table| span(table.suspension.bogie_pivot.take())),
    ("suspension.middle_hub", |table| span(table.suspension.middle_hub.take())),
    ("suspension.rear_hub", |table| span(table.suspension.rear_hub.take())),
    ("suspension.half_track", |table| span(table.suspension.half_track.take())),
    ("suspension.centre_of_mass", |table| span(table.suspension.centre_of_mass.take())),
    ("drive.reflected_inertia_kg_m2", |table| span(table.drive.reflected_inertia_kg_m2.take())),
    ("noise.wheel_rate_rad_s", |table| span(table.noise.wheel_rate_rad_s.take())),
    ("noise.motor_torque_nm", |table| span(table.noise.motor_torque_nm.take())),
    ("noise.load_cell_n", |table| span(table.noise.load_cell_n.take())),
    ("noise.angle_rad", |table| span(table.noise.angle_rad.take())),
    ("noise.accel_m_s2", |table| span(table.noise.accel_m_s2.take())),
    ("noise.gyro_rad_s", |table| span(table.noise.gyro_rad_s.take())),
    ("noise.velocity_m_s", |table| span(table.noise.velocity_m_s.take())),
];

fn span<T>(key: Option<Spanned<T>>) -> Option<Range<usize>> {
    key.map(|key| key.span())
}

/// Whether a number is larger than can be; what is no number is refused as such elsewhere.
fn is_beyond(number: f64, most: f64) -> bool {
    number.is_finite() && number.abs() > most
}
