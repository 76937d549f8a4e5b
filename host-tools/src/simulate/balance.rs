//! The forces on the rover at one instant, and what they leave unbalanced.

use kapvik_firmware::rover::{
    Axes, Axle, HubContact, PerAxle, PerSide, PerWheel, Planar, Rover, Side, SideLayout, body_moment_nm,
    bogie_moment_nm, rocker_moment_nm,
};
use kapvik_firmware::terramechanics::effects::{Conditions, Effects, Grousers};
use kapvik_firmware::terramechanics::{ForceError, Quadrature, Soil, WheelForces, WheelOnSoil};

use super::ground_soils::SoilsAlongTheWay;
use super::pose::{Coordinates, Pose};
use super::terrain::{Ground, Terrain};
use super::wheel_soil::WheelMotion;

/// Stiffness of a bogie's stop, N·m/rad.
const STOP_STIFFNESS_NM_RAD: f64 = 2000.0;

/// What stays the same over a drive.
#[derive(Debug, Clone)]
pub struct World {
    /// The rover, its wheel as large as it truly is.
    pub rover: Rover<f64>,
    /// The ground.
    pub terrain: Terrain,
    /// The soil.
    pub soils: SoilsAlongTheWay,
    /// The wheels' grousers, which act only through an effect.
    pub grousers: Grousers<f64>,
    /// What acts beside equations 1–11.
    pub effects: Effects<f64>,
    /// How far a bogie can turn against its rocker before a stop holds it, rad, both ways; infinite: no stop.
    pub bogie_stop_rad: f64,
}

/// How the rover is placed and moves; what the forces follow from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Where it is.
    pub pose: Pose,
    /// How the pose changes.
    pub rates: Pose,
    /// Acceleration of the centre of mass in the world, m/s².
    pub acceleration_m_s2: Axes<f64>,
    /// Rim speeds that the drives hold against the links, m/s.
    pub rim_speed_m_s: PerWheel<f64>,
    /// Way of the rims against the links since the start, m.
    pub rim_way_m: PerWheel<f64>,
    /// The slip that the soil under each wheel has felt, 0 … 1: it follows the size of the wheel's slip over the length of the
    /// contact.
    pub felt_slip: PerWheel<f64>,
}

/// One wheel at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelInstant {
    /// The hub in the body's axes, m.
    pub hub_m: Axes<f64>,
    /// The contact in the wheel's plane: x and z of the body.
    pub contact: HubContact<f64>,
    /// Slope of the terrain along the wheel's plane against the horizontal, rad, uphill.
    pub contact_angle_rad: f64,
    /// How it moves on the soil.
    pub motion: WheelMotion,
    /// What the soil does to it.
    pub forces: WheelForces<f64>,
    /// Force of the soil on it along its axle, N, to the left.
    pub side_force_n: f64,
}

/// The rover at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// How it is placed and moves.
    pub motion: Motion,
    /// Specific force at the centre of mass in the body's axes, m/s²: acceleration less gravity.
    pub specific_force_m_s2: Axes<f64>,
    /// The wheels.
    pub wheels: PerWheel<WheelInstant>,
    /// Moments of the bogies' stops on the bogies, N·m, nose-down.
    pub stops_nm: PerSide<f64>,
    /// What is left over, N and N·m: forward and upward force in the body's axes, moment about the body's x, each rocker
    /// about the differential axis, each bogie about its pivot.
    pub residual: Coordinates,
}

impl World {
    /// The forces of a motion.
    ///
    /// # Errors
    /// Where a wheel is beyond the wheel–soil equations.
    pub fn instant(&self, motion: &Motion) -> Result<Instant, ForceError> {
        let Motion { pose, rates, acceleration_m_s2, rim_speed_m_s, .. } = motion;
        let gravity = self.rover.gravity_m_s2;
        let felt = Axes { z: acceleration_m_s2.z + gravity, ..*acceleration_m_s2 };
        let specific_force = pose.into_body(felt);
        let layouts = Side::ALL.map(|side| SideLayout::new(&self.rover, side, &pose.joints(rates, side)));
        let mut wheels = PerSide {
            left: self.wheels_of(Side::Left, motion, &layouts.left, &rim_speed_m_s.left)?,
            right: self.wheels_of(Side::Right, motion, &layouts.right, &rim_speed_m_s.right)?,
        };
        self.share_side_force(&mut wheels, &specific_force);
        let stops_nm =
            PerSide { left: pose.bogie_left, right: pose.bogie_right }.map(|angle| self.stop_moment_nm(angle));
        let residual = self.residual(&layouts, &wheels, &stops_nm, &specific_force);
        Ok(Instant { motion: *motion, specific_force_m_s2: specific_force, wheels, stops_nm, residual })
    }

    fn wheels_of(
        &self,
        side: Side,
        motion: &Motion,
        layout: &SideLayout<f64>,
        rim_speeds: &PerAxle<f64>,
    ) -> Result<PerAxle<WheelInstant>, ForceError> {
        let joints = motion.pose.joints(&motion.rates, side);
        let body = motion.pose.motion(&motion.rates);
        let velocities = layout.hub_velocities_m_s(&body, &joints);
        let [rocker_rate, bogie_rate] = joints.inertial_rates_rad_s(&body);
        // A wheel held on its link turns back with it.
        let link_rates = PerAxle { front: rocker_rate, middle: bogie_rate, rear: bogie_rate };
        let place = |axle: Axle| {
            let rim_speed = *rim_speeds.of(axle) - self.rover.wheel.radius_m * *link_rates.of(axle);
            let hub = *layout.hubs.of(axle);
            let hub_m = Axes { x: hub.x, y: layout.y_m, z: hub.z };
            let conditions = self.conditions(side, axle, motion);
            self.wheel((side, axle), &conditions, &motion.pose, hub_m, *velocities.of(axle), rim_speed)
        };
        Ok(PerAxle { front: place(Axle::Front)?, middle: place(Axle::Middle)?, rear: place(Axle::Rear)? })
    }

    /// What the effects at a wheel follow. Front wheels meet fresh soil, the others that of the wheels before them.
    pub fn conditions(&self, side: Side, axle: Axle, motion: &Motion) -> Conditions<f64> {
        let pass = match axle {
            Axle::Front => 1.0,
            Axle::Middle => 2.0,
            Axle::Rear => 3.0,
        };
        Conditions {
            pass: Some(pass),
            wheel_angle_rad: Some(motion.rim_way_m.of_wheel(side, axle) / self.rover.wheel.radius_m),
            pitch_rad: Some(motion.pose.pitch),
            felt_slip: Some(*motion.felt_slip.of_wheel(side, axle)),
            ..Conditions::default()
        }
    }

    /// A wheel on a soil, with the effects.
    pub fn on<'a>(&'a self, soil: &'a Soil<f64>) -> WheelOnSoil<'a, f64> {
        WheelOnSoil {
            wheel: &self.rover.wheel,
            grousers: &self.grousers,
            soil,
            effects: &self.effects,
            gravity_m_s2: self.rover.gravity_m_s2,
            quadrature: Quadrature::for_scalar::<f64>(),
        }
    }

    /// Where a hub at this place in the body is over the ground.
    pub fn hub_over_ground(&self, (side, axle): (Side, Axle), pose: &Pose, hub_m: Axes<f64>) -> HubOverGround {
        let from_axis = pose.into_world(hub_m);
        let x_m = pose.x + from_axis.x;
        let ground = self.terrain.at(side, axle, x_m);
        let contact = contact_in_wheel_plane(pose, &ground);
        let normal = pose.into_world(Axes { x: contact.normal.x, y: 0.0, z: contact.normal.z });
        let above_m = pose.z + from_axis.z - ground.height_m;
        let distance_m = above_m / (normal.z - ground.slope * normal.x);
        HubOverGround { x_m, ground, contact, normal, above_m, distance_m }
    }

    fn wheel(
        &self,
        (side, axle): (Side, Axle),
        conditions: &Conditions<f64>,
        pose: &Pose,
        hub_m: Axes<f64>,
        velocity_m_s: Planar<f64>,
        rim_speed_m_s: f64,
    ) -> Result<WheelInstant, ForceError> {
        let HubOverGround { x_m, ground, contact, normal, above_m, distance_m } =
            self.hub_over_ground((side, axle), pose, hub_m);
        let in_world = |v: Planar<f64>| pose.into_world(Axes { x: v.x, y: 0.0, z: v.z });
        let velocity = in_world(velocity_m_s);
        // On ground that curves the tangent turns under the hub, which is no sinking.
        let turned_m_s = above_m * normal.x * normal.z * normal.z * ground.slope_change_1_m * velocity.x;
        let motion = WheelMotion {
            rim_speed_m_s,
            hub_speed_m_s: velocity_m_s.dot(contact.tangent),
            sinkage_m: self.rover.wheel.radius_m - distance_m,
            sinking_m_s: -velocity_m_s.dot(contact.normal) - turned_m_s,
        };
        let soil = self.soils.under(side, x_m);
        let forces = motion.forces(&self.on(&soil), conditions)?;
        let contact_angle_rad = libm::asin(in_world(contact.tangent).z.clamp(-1.0, 1.0));
        Ok(WheelInstant { hub_m, contact, contact_angle_rad, motion, forces, side_force_n: 0.0 })
    }

    /// Heading and sideways motion are held by side forces. Each wheel takes a share in proportion to its load times a
    /// straight line along the rover: the line's two coefficients give the total force and the total moment about z.
    fn share_side_force(&self, wheels: &mut PerWheel<WheelInstant>, specific_force: &Axes<f64>) {
        let centre = self.rover.suspension.centre_of_mass;
        let mass = self.rover.mass_kg;
        let wanted_n = mass * specific_force.y;
        let mut wanted_nm = mass * (centre.x * specific_force.y - centre.y * specific_force.x);
        let [mut load, mut first, mut second] = [0.0; 3];
        for wheel in wheels.iter_wheels() {
            wanted_nm += wheel.hub_m.y * wheel.hub_force_n().x;
            let x = wheel.rim_m(self.rover.wheel.radius_m).x;
            load += wheel.forces.load_n;
            first += wheel.forces.load_n * x;
            second += wheel.forces.load_n * x * x;
        }
        let determinant = load * second - first * first;
        if determinant <= 0.0 {
            return;
        }
        let constant = (second * wanted_n - first * wanted_nm) / determinant;
        let slope = (load * wanted_nm - first * wanted_n) / determinant;
        for wheel in wheels.iter_wheels_mut() {
            let x = wheel.rim_m(self.rover.wheel.radius_m).x;
            wheel.side_force_n = wheel.forces.load_n * (constant + slope * x);
        }
    }

    /// Moment of a stop on its bogie, N·m, nose-down.
    fn stop_moment_nm(&self, bogie_rad: f64) -> f64 {
        let beyond = bogie_rad - bogie_rad.clamp(-self.bogie_stop_rad, self.bogie_stop_rad);
        STOP_STIFFNESS_NM_RAD * beyond
    }

    fn residual(
        &self,
        layouts: &PerSide<SideLayout<f64>>,
        wheels: &PerWheel<WheelInstant>,
        stops_nm: &PerSide<f64>,
        specific_force: &Axes<f64>,
    ) -> Coordinates {
        let mass = self.rover.mass_kg;
        let centre = self.rover.suspension.centre_of_mass;
        let mut forward_n = -mass * specific_force.x;
        let mut upward_n = -mass * specific_force.z;
        let mut roll_nm = mass * (centre.z * specific_force.y - centre.y * specific_force.z);
        for wheel in wheels.iter_wheels() {
            let force = wheel.hub_force_n();
            forward_n += force.x;
            upward_n += force.z;
            // The side force acts on the rim, the others through the hub.
            roll_nm += wheel.hub_m.y * force.z - wheel.rim_m(self.rover.wheel.radius_m).z * wheel.side_force_n;
        }
        let half_body_nm = 0.5 * body_moment_nm(&self.rover, specific_force);
        let links_nm = layouts.zip(wheels.as_ref()).zip(*stops_nm).map(|((layout, wheels), stop_nm)| {
            let forces = wheels.as_ref().map(WheelInstant::hub_force_n);
            let torques = wheels.as_ref().map(|wheel| wheel.forces.torque_nm);
            let rocker_nm = rocker_moment_nm(&layout, &forces, &torques) + half_body_nm - stop_nm;
            (rocker_nm, bogie_moment_nm(&layout, &forces, &torques) + stop_nm)
        });
        let (left, right) = (links_nm.left, links_nm.right);
        Coordinates::from([forward_n, upward_n, roll_nm, left.0, right.0, left.1, right.1])
    }
}

impl WheelInstant {
    /// The soil's force on the hub in the plane of the side, N, in the body's axes.
    pub fn hub_force_n(&self) -> Planar<f64> {
        self.contact.hub_force_n(self.forces.load_n, self.forces.drawbar_pull_n)
    }

    /// The point of the rim that the normal meets, where the side force acts, m in the body's axes.
    pub fn rim_m(&self, radius_m: f64) -> Axes<f64> {
        let down = self.contact.normal.scaled(-radius_m);
        Axes { x: self.hub_m.x + down.x, y: self.hub_m.y, z: self.hub_m.z + down.z }
    }
}

/// A hub over the ground.
#[derive(Debug, Clone, Copy)]
pub struct HubOverGround {
    /// Where along the way, m.
    pub x_m: f64,
    /// The ground there.
    pub ground: Ground,
    /// The ground in the plane of the wheel, in the body's axes.
    pub contact: HubContact<f64>,
    /// Its normal in the world's axes.
    pub normal: Axes<f64>,
    /// How far the hub is above the ground, m, straight up.
    pub above_m: f64,
    /// How far it is from the terrain's tangent, m, along that normal.
    pub distance_m: f64,
}

/// Tangent and normal of the ground in the plane of the wheels (x and z of the body). The ground rises along the world's x
/// and is level across; the tangent is where that surface cuts the wheel's plane.
fn contact_in_wheel_plane(pose: &Pose, ground: &Ground) -> HubContact<f64> {
    let (sine, cosine) = libm::sincos(pose.pitch);
    let along = Planar { x: libm::cos(pose.roll) * (cosine + ground.slope * sine), z: ground.slope * cosine - sine };
    HubContact::along(along.scaled(1.0 / along.length()))
}
