//! Whether rocker and bogies turn the way that is agreed: with a wrong sign the wheels of a side would not roll over the same ground.
//!
//! The hubs' paths are reckoned from velocimeter, gravity and joints, with each joint as it says and the other way round. The front hub's
//! path is the ground of the hubs behind it, give or take how deep they sink: the signs that make them agree are the right ones.

use kapvik_firmware::rover::{PerSide, Planar, Rover, Side, SideLayout};
use kapvik_firmware::sensor_frame::SensorFrame;

use super::hub_paths::HubPaths;
use super::raw_sensors::{LONGEST_FRAME_S, Steps, links_at, rockers, wide};

/// Fewest comparisons that tell, and the share of the rover's length by which hubs may differ by sinking, a root mean square.
const LEAST_COMPARED: f64 = 30.0;
const TOLERATED: f64 = 0.012;
/// What the other signs have to leave of the mean square, in all and for each joint that is turned.
const CLEARLY: f64 = 0.25;
const EACH_JOINT: f64 = 0.5;

/// The paths of the hubs, with joints as they say and the other way round.
#[derive(Debug, Clone)]
pub struct JointSigns {
    rover: Rover<f64>,
    length_m: f64,
    steps: Steps,
    velocity: HeldVelocity,
    /// Where the midpoint of the differential axis is, m from where it was at first.
    at_m: Planar<f64>,
    /// The first of a side has both joints as they say.
    candidates: PerSide<[Signs; 4]>,
}

/// Signs of a side's joints, and the paths that they make.
#[derive(Debug, Clone)]
struct Signs {
    rocker: f64,
    bogie: f64,
    paths: HubPaths,
}

/// What the velocimeter said last, and when, µs: it may speak in few of the frames.
#[derive(Debug, Clone, Copy, Default)]
struct HeldVelocity {
    last: Option<(u64, Planar<f64>)>,
}

/// How the body lies and goes, and how its joints stand.
struct Posture {
    velocity_m_s: Planar<f64>,
    /// Sine and cosine of the pitch, sine of the roll.
    pitch: (f64, f64),
    roll: f64,
    /// Rocker and bogie of each side.
    joints_rad: PerSide<(f64, f64)>,
}

impl JointSigns {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        let rover = rover.map(f64::from);
        let hubs = SideLayout::new(&rover, Side::Left, &links_at(0.0, 0.0)).hubs;
        let length_m = hubs.front.x - hubs.rear.x;
        let of_side = || {
            let signs = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
            signs.map(|(rocker, bogie)| Signs { rocker, bogie, paths: HubPaths::of_length(length_m) })
        };
        let candidates = PerSide { left: of_side(), right: of_side() };
        Self {
            rover,
            length_m,
            steps: Steps::default(),
            velocity: HeldVelocity::default(),
            at_m: Planar::default(),
            candidates,
        }
    }

    /// Takes a frame.
    pub fn take(&mut self, frame: &SensorFrame) {
        let step_s = self.steps.since_before_s(frame);
        let posture = self.velocity.at(frame).and_then(|velocity_m_s| Posture::of(frame, velocity_m_s));
        let Some((posture, step_s)) = posture.zip(step_s) else {
            self.candidates.as_array_mut().into_iter().flatten().for_each(|signs| signs.paths.begin_anew());
            return;
        };
        self.at_m = self.at_m + posture.velocity_m_s.turned(posture.pitch).scaled(step_s);
        for side in Side::ALL.as_array().map(|side| *side) {
            let (rocker_rad, bogie_rad) = *posture.joints_rad.of(side);
            for Signs { rocker, bogie, paths } in self.candidates.of_mut(side) {
                let links = links_at(*rocker * rocker_rad, *bogie * bogie_rad);
                let layout = SideLayout::new(&self.rover, side, &links);
                let side_m = self.at_m + Planar { x: 0.0, z: layout.y_m * posture.roll };
                paths.take(layout.hubs.map(|hub| side_m + hub.turned(posture.pitch)));
            }
        }
    }

    /// What came of it, without capital and stop.
    pub fn told(&self) -> Option<String> {
        let PerSide { left, right } = self.candidates.as_ref().map(|candidates| self.turned(candidates));
        let rocker = (left.0 || right.0).then_some("rocker_angle_rad");
        let bogies = [left.1.then_some("bogie_angle_l_rad"), right.1.then_some("bogie_angle_r_rad")];
        let columns: Vec<&str> = rocker.into_iter().chain(bogies.into_iter().flatten()).collect();
        (!columns.is_empty()).then(|| {
            let verb = if columns.len() == 1 { "has" } else { "have" };
            format!(
                "{} {verb} the wrong sign (nose-up is positive): only with the other do the wheels of a side roll over the same ground; contact \
                 angles, pulls and soil are wrong by it",
                columns.join(", ")
            )
        })
    }

    /// Whether a side's rocker and whether its bogie is clearly the other way round.
    fn turned(&self, candidates: &[Signs; 4]) -> (bool, bool) {
        let [as_said, ..] = candidates;
        let (compared, apart) = (as_said.paths.compared(), as_said.paths.apart());
        let best = candidates.iter().min_by(|a, b| a.weighed().total_cmp(&b.weighed()));
        let is_clear = |best: &&Signs| best.paths.apart() < CLEARLY * apart;
        let tolerated = compared * (TOLERATED * self.length_m).powi(2);
        let tells = compared >= LEAST_COMPARED && apart > tolerated;
        best.filter(|_| tells).filter(is_clear).map_or((false, false), |best| (best.rocker < 0.0, best.bogie < 0.0))
    }
}

impl Signs {
    /// How far the hubs' paths are apart, for comparison: each joint that is turned round has to pay for itself.
    fn weighed(&self) -> f64 {
        let turned = [self.rocker, self.bogie].into_iter().filter(|sign| *sign < 0.0);
        turned.fold(self.paths.apart(), |left, _| left / EACH_JOINT)
    }
}

impl HeldVelocity {
    /// That of a frame, or of one not long before it.
    fn at(&mut self, frame: &SensorFrame) -> Option<Planar<f64>> {
        if let Some((x, z)) = wide(frame.velocity_m_s.x).zip(wide(frame.velocity_m_s.z)) {
            self.last = Some((frame.time_us, Planar { x, z }));
        }
        let is_fresh = |time_us: u64| 1e-6 * frame.time_us.saturating_sub(time_us) as f64 <= LONGEST_FRAME_S;
        self.last.filter(|(time_us, _)| is_fresh(*time_us)).map(|(_, velocity_m_s)| velocity_m_s)
    }
}

impl Posture {
    /// Of a rover that goes at this velocity, where a frame tells it.
    fn of(frame: &SensorFrame, velocity_m_s: Planar<f64>) -> Option<Self> {
        let felt = frame.accel_m_s2.map(wide).all()?;
        let upright = felt.x.hypot(felt.z);
        let joints = rockers(frame).zip(frame.bogie_angle_rad.map(wide)).map(|(rocker, bogie)| rocker.zip(bogie));
        (upright > 0.0).then_some(Self {
            velocity_m_s,
            pitch: (felt.x / upright, felt.z / upright),
            roll: felt.y / upright.hypot(felt.y),
            joints_rad: PerSide { left: joints.left?, right: joints.right? },
        })
    }
}
