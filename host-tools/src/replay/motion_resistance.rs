//! Whether front wheels and bogies meet a like resistance. What of a torque moves the soil and not the rover, T/r − DP, is alike under wheels of
//! one rover on one soil, as a share of their load; with another centre of mass than stated, pulls are taken from the one and given to the
//! others.

use kapvik_firmware::estimator::{WheelActivity, WheelEstimate};
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::Rover;

/// A wheel that slips by more digs rather than drives.
const DIGGING_SLIP: f32 = 0.8;
/// Fewest frames that tell.
const LEAST_FRAMES: u32 = 100;
/// Shares of the load by which the resistances may differ. Other slips, slopes and drive friction make up to 0.05, soil that is twice as
/// stiff behind the front wheels as well, and deep digging at one end 0.1.
const TOLERATED: f64 = 0.2;

/// Resistance and load of wheels that drive, in running sums.
#[derive(Debug, Clone, Copy, Default)]
struct Resistance {
    resistance_n: f64,
    load_n: f64,
}

/// What the wheels of a drive meet.
#[derive(Debug, Clone)]
pub struct MotionResistance {
    radius_m: f32,
    frames: u32,
    front: Resistance,
    bogies: Resistance,
}

impl Resistance {
    fn take(&mut self, wheel: &WheelEstimate, radius_m: f32) {
        self.resistance_n += f64::from(wheel.resistance_n(radius_m));
        self.load_n += f64::from(wheel.normal_load_n.value);
    }

    fn share(&self) -> f64 {
        self.resistance_n / self.load_n
    }
}

impl MotionResistance {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        let [front, bogies] = [Resistance::default(); 2];
        Self { radius_m: rover.wheel.radius_m, frames: 0, front, bogies }
    }

    /// Takes the estimates of a frame, where all wheels drive forward.
    pub fn take(&mut self, estimate: &FrameEstimate) {
        if !estimate.wheels.iter_wheels().all(drives) {
            return;
        }
        self.frames += 1;
        for side in estimate.wheels.as_array() {
            self.front.take(&side.front, self.radius_m);
            self.bogies.take(&side.middle, self.radius_m);
            self.bogies.take(&side.rear, self.radius_m);
        }
    }

    /// What came of it, without capital and stop.
    pub fn told(&self) -> Option<String> {
        let [front, bogies] = [self.front.share(), self.bogies.share()];
        let differ = (front - bogies).abs() > TOLERATED;
        (self.frames >= LEAST_FRAMES && differ).then(|| {
            format!(
                "of its load the soil takes (T/r − DP)/W = {front:.2} from the front wheels and {bogies:.2} from those of the bogies, which no soil does: \
                 the centre of mass, the suspension's geometry or the torques are not as the rover file says, and pulls and soil are wrong by it"
            )
        })
    }
}

/// Whether a wheel drives the rover forward.
fn drives(wheel: &WheelEstimate) -> bool {
    let slips = wheel.slip.is_some_and(|slip| slip.value > 0.0 && slip.value < DIGGING_SLIP);
    slips && wheel.activity == WheelActivity::Rolling && wheel.resistive_torque_nm.value > 0.0
}
