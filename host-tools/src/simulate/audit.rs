//! Whether every body of the rover is in balance: a second computation, in the world's axes and three dimensions, that shares
//! no equation with the one that found the motion. It starts from the joint angles and the wheels' loads, pulls and torques.

use kapvik_firmware::rover::{Axle, PerSide, Side};
use nalgebra::{Rotation3, Vector3};

use super::balance::{Instant, WheelInstant, World};

/// What each body leaves unbalanced, the greatest component, N or N·m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Imbalance {
    /// Force on the whole rover, N.
    pub rover_n: f64,
    /// Moment on the whole rover about its centre of mass, N·m.
    pub rover_nm: f64,
    /// Moment on the body about the differential axis, N·m, from what its rockers hand on.
    pub body_nm: f64,
    /// What the differential hands to one rocker more than to the other, N·m.
    pub rockers_nm: f64,
    /// Moment on each bogie about its pivot's axis, N·m.
    pub bogies_nm: PerSide<f64>,
}

impl Imbalance {
    /// The greatest of all, N or N·m.
    pub fn worst(&self) -> f64 {
        let Self { rover_n, rover_nm, body_nm, rockers_nm, bogies_nm } = *self;
        [rover_n, rover_nm, body_nm, rockers_nm, bogies_nm.left, bogies_nm.right]
            .into_iter()
            .fold(0.0, |worst, value| if value.abs() > worst || value.is_nan() { value.abs() } else { worst })
    }
}

/// A force in the world and where it acts, with a moment beside it.
struct Load {
    at_m: Vector3<f64>,
    force_n: Vector3<f64>,
    moment_nm: Vector3<f64>,
}

impl Load {
    fn moment_about(&self, point: &Vector3<f64>) -> Vector3<f64> {
        (self.at_m - point).cross(&self.force_n) + self.moment_nm
    }
}

/// The links of a side as bodies in the world.
struct SideBodies {
    /// What the soil does to the front, middle and rear wheel: at the hub, and the side force at the rim.
    loads: [[Load; 2]; 3],
    pivot_m: Vector3<f64>,
}

/// What is left over at an instant.
pub fn imbalance(world: &World, instant: &Instant) -> Imbalance {
    let pose = &instant.motion.pose;
    let body = Rotation3::from_axis_angle(&Vector3::y_axis(), -pose.pitch)
        * Rotation3::from_axis_angle(&Vector3::x_axis(), pose.roll);
    let axle = body * Vector3::y();
    let middle_m = Vector3::new(pose.x, 0.0, pose.z);
    let sides = Side::ALL.map(|side| side_bodies(world, instant, &body, side));
    let mass = world.rover.mass_kg;
    let centre = world.rover.suspension.centre_of_mass;
    let centre_m = middle_m + body * Vector3::new(centre.x, centre.y, centre.z);
    let a = instant.motion.acceleration_m_s2;
    let needed_n = mass * Vector3::new(a.x, a.y, a.z + world.rover.gravity_m_s2);
    let (mut force_n, mut about_centre_nm) = (-needed_n, Vector3::zeros());
    for load in sides.as_array().into_iter().flat_map(|side| side.loads.iter().flatten()) {
        force_n += load.force_n;
        about_centre_nm += load.moment_about(&centre_m);
    }
    let stops = instant.stops_nm;
    // A massless bogie hands its forces on at its pivot, and its stop's moment back to the rocker.
    let bogies_nm = sides.as_ref().zip(stops).map(|(side, stop_nm)| {
        let moment: Vector3<f64> =
            side.loads.iter().skip(1).flatten().map(|load| load.moment_about(&side.pivot_m)).sum();
        moment.dot(&axle) + stop_nm
    });
    // What each massless rocker hands to the differential.
    let handed_nm = sides.as_ref().zip(stops).map(|(side, stop_nm)| {
        let front: Vector3<f64> = side.loads.iter().take(1).flatten().map(|load| load.moment_about(&middle_m)).sum();
        let bogie_n: Vector3<f64> = side.loads.iter().skip(1).flatten().map(|load| load.force_n).sum();
        (front + (side.pivot_m - middle_m).cross(&bogie_n)).dot(&axle) - stop_nm
    });
    let weight_nm = (centre_m - middle_m).cross(&-needed_n).dot(&axle);
    Imbalance {
        rover_n: force_n.amax(),
        rover_nm: about_centre_nm.amax(),
        body_nm: handed_nm.left + handed_nm.right + weight_nm,
        rockers_nm: handed_nm.left - handed_nm.right,
        bogies_nm,
    }
}

fn side_bodies(world: &World, instant: &Instant, body: &Rotation3<f64>, side: Side) -> SideBodies {
    let pose = &instant.motion.pose;
    let suspension = &world.rover.suspension;
    let (mirror, bogie_rad) = match side {
        Side::Left => (1.0, pose.bogie_left),
        Side::Right => (-1.0, pose.bogie_right),
    };
    let nose_up = |angle: f64| Rotation3::from_axis_angle(&Vector3::y_axis(), -angle);
    let rocker = body * nose_up(mirror * pose.rocker);
    let bogie = rocker * nose_up(bogie_rad);
    let flat = |point: kapvik_firmware::rover::Planar<f64>| Vector3::new(point.x, 0.0, point.z);
    let end_m = Vector3::new(pose.x, 0.0, pose.z) + body * Vector3::new(0.0, mirror * suspension.half_track_m, 0.0);
    let pivot_m = end_m + rocker * flat(suspension.bogie_pivot);
    let hubs_m = [
        end_m + rocker * flat(suspension.front_hub),
        pivot_m + bogie * flat(suspension.middle_hub),
        pivot_m + bogie * flat(suspension.rear_hub),
    ];
    let wheels = instant.wheels.of(side);
    let load = |axle: Axle, hub_m| wheel_loads(world, side, axle, wheels.of(axle), hub_m, &(body * Vector3::y()));
    let [front, middle, rear] = hubs_m;
    SideBodies { loads: [load(Axle::Front, front), load(Axle::Middle, middle), load(Axle::Rear, rear)], pivot_m }
}

fn wheel_loads(
    world: &World,
    side: Side,
    axle: Axle,
    wheel: &WheelInstant,
    hub_m: Vector3<f64>,
    axle_direction: &Vector3<f64>,
) -> [Load; 2] {
    let slope = world.terrain.at(side, axle, hub_m.x).slope;
    let up = Vector3::new(-slope, 0.0, 1.0).normalize();
    let tangent = axle_direction.cross(&up).normalize();
    let normal = tangent.cross(axle_direction);
    let force_n = wheel.forces.load_n * normal + wheel.forces.drawbar_pull_n * tangent;
    // The soil resists forward rotation, which is right-handed about the axle.
    let in_plane = Load { at_m: hub_m, force_n, moment_nm: -wheel.forces.torque_nm * axle_direction };
    let rim_m = hub_m - world.rover.wheel.radius_m * normal;
    let sideways = Load { at_m: rim_m, force_n: wheel.side_force_n * axle_direction, moment_nm: Vector3::zeros() };
    [in_plane, sideways]
}
