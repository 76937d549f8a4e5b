//! Whether the velocimeter sees the rover go where its wheels lead: one that is mounted askew does not.

use kapvik_firmware::rover::{Planar, Rover, Side, SideLayout};
use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::{DRIVING_M_S, Steps, links_at, rockers, wide};

/// The shortest way that tells, m: over it bumps under single wheels are made up for.
const LEAST_WAY_M: f64 = 0.5;
/// Degrees from which it is told. Wheels that sink deeper at one end than at the other make up to eight tenths.
const TOLERATED_DEG: f64 = 1.2;

/// The way of a drive in the body's plane, in running sums.
#[derive(Debug, Clone)]
pub struct CameraTilt {
    rover: Rover<f64>,
    steps: Steps,
    way_m: f64,
    /// How far up the velocimeter saw the body go, and how far the line through the wheels leads, m.
    seen_up_m: f64,
    led_up_m: f64,
}

impl CameraTilt {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self { rover: rover.map(f64::from), steps: Steps::default(), way_m: 0.0, seen_up_m: 0.0, led_up_m: 0.0 }
    }

    /// Takes a frame.
    pub fn take(&mut self, frame: &SensorFrame) {
        let Some(step_s) = self.steps.since_before_s(frame) else { return };
        let [ahead, up] = [frame.velocity_m_s.x, frame.velocity_m_s.z].map(wide);
        let Some((ahead_m_s, up_m_s)) = ahead.zip(up) else { return };
        if ahead_m_s.abs() <= DRIVING_M_S || up_m_s.abs() > ahead_m_s.abs() {
            return;
        }
        let Some(slope) = self.slope_of_wheels(frame) else { return };
        self.way_m += ahead_m_s.abs() * step_s;
        self.seen_up_m += ahead_m_s.signum() * up_m_s * step_s;
        self.led_up_m += slope * ahead_m_s.abs() * step_s;
    }

    /// The slope of the line through the hubs against the body: least squares, the mean of both sides.
    fn slope_of_wheels(&self, frame: &SensorFrame) -> Option<f64> {
        let rockers = rockers(frame);
        let slopes = Side::ALL.as_array().map(|side| {
            let (rocker, bogie) = ((*rockers.of(*side))?, wide(*frame.bogie_angle_rad.of(*side))?);
            let hubs = SideLayout::new(&self.rover, *side, &links_at(rocker, bogie)).hubs.into_array();
            let middle = hubs.iter().fold(Planar::default(), |sum, hub| sum + *hub).scaled(1.0 / hubs.len() as f64);
            let apart = hubs.map(|hub| hub - middle);
            let product: f64 = apart.iter().map(|hub| hub.x * hub.z).sum();
            Some(product / apart.iter().map(|hub| hub.x * hub.x).sum::<f64>())
        });
        let [left, right] = slopes;
        Some(0.5 * (left? + right?))
    }

    /// What came of it, without capital and stop.
    pub fn told(&self) -> Option<String> {
        if self.way_m < LEAST_WAY_M {
            return None;
        }
        let [seen, led] = [self.seen_up_m, self.led_up_m].map(|up_m| (up_m / self.way_m).atan().to_degrees());
        let tilt_deg = seen - led;
        (tilt_deg.abs() > TOLERATED_DEG).then(|| {
            format!(
                "the velocimeter sees the rover go {:.1}° {} than its wheels lead: it is mounted askew, velocity_z has a zero or a sign of its own, \
                 or wheels sink far deeper at one end; by as much contact angles are off, pulls and soil with them",
                tilt_deg.abs(),
                if tilt_deg > 0.0 { "higher" } else { "lower" }
            )
        })
    }
}
