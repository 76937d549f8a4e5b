//! Where a rover stands before it starts: what the search for the balance of its forces begins with.

use kapvik_firmware::rover::{Axes, Axle, PerAxle, Side, SideLayout};

use super::balance::World;
use super::newton::{Newton, Residual};
use super::pose::{Coordinates, Pose};
use super::wheel_soil::standing_conditions;

/// About where the rover stands: on the plane through the ground under its outer hubs, sunk as a wheel with its share of
/// the weight. The sinkage is also what tells that the soil can carry it.
pub fn about_standing(world: &World) -> Option<Pose> {
    let suspension = &world.rover.suspension;
    let sinkage_m = sinkage_at_rest_m(world)?;
    let rear = suspension.bogie_pivot + suspension.rear_hub;
    let height = |side, axle, x| world.terrain.at(side, axle, x).height_m;
    let front = Side::ALL.map(|side| height(side, Axle::Front, suspension.front_hub.x));
    let back = Side::ALL.map(|side| height(side, Axle::Rear, rear.x));
    let rise = 0.5 * (front.left + front.right - back.left - back.right);
    let pitch = libm::atan2(rise, suspension.front_hub.x - rear.x);
    let lean = 0.5 * (front.left + back.left - front.right - back.right);
    let roll = libm::atan2(lean, 2.0 * suspension.half_track_m);
    let mean = 0.25 * (front.left + front.right + back.left + back.right);
    let middle_x = 0.5 * (suspension.front_hub.x + rear.x);
    let up = world.rover.wheel.radius_m - sinkage_m - 0.5 * (suspension.front_hub.z + rear.z);
    let z = mean - middle_x * libm::tan(pitch) + up / libm::cos(pitch);
    Some(Pose { z, pitch, roll, ..Pose::default() })
}

/// With every hub as high over the ground below it as that of a wheel which bears its share of the weight: whatever the ground and wherever
/// the hubs are.
pub fn standing_on_hubs(world: &World) -> Option<Pose> {
    let above_m = world.rover.wheel.radius_m - sinkage_at_rest_m(world)?;
    let start = about_standing(world)?;
    let solved = Newton::default().solve(&OnHubs { world, above_m }, start.into())?;
    Some(Pose::from(solved.unknowns))
}

/// How deep a wheel sinks that bears its share of the weight, m.
fn sinkage_at_rest_m(world: &World) -> Option<f64> {
    let soil = world.soils.at(0.0);
    world.on(&soil).at_load(&standing_conditions(), 0.0, world.rover.load_at_rest_n()).ok().map(|truth| truth.sinkage_m)
}

/// The six hubs at one distance from the ground, and the differential axis at x = 0; what is left of each, m.
struct OnHubs<'a> {
    world: &'a World,
    above_m: f64,
}

impl Residual for OnHubs<'_> {
    type State = ();
    fn at(&self, unknowns: &Coordinates) -> Option<(Coordinates, ())> {
        let pose = Pose::from(*unknowns);
        let left_m = Side::ALL.map(|side| {
            let layout = SideLayout::new(&self.world.rover, side, &pose.joints(&Pose::default(), side));
            let hubs = layout.hubs.zip(Axle::ALL);
            hubs.map(|(hub, axle)| {
                let hub_m = Axes { x: hub.x, y: layout.y_m, z: hub.z };
                self.world.hub_over_ground((side, axle), &pose, hub_m).distance_m - self.above_m
            })
        });
        let [PerAxle { front, middle, rear }, right] = [left_m.left, left_m.right];
        Some((Coordinates::from([pose.x, front, middle, rear, right.front, right.middle, right.rear]), ()))
    }
}
