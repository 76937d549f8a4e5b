//! The rover weighed by its own load cells: whether together they bear what its mass and gravity say.

use std::fmt;

use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::{DRIVING_M_S, links, rockers, wide};
use crate::statistics::running::Running;

/// Frames of so long are taken as one number, µs: over rough ground the errors of one frame are those of the next.
const BLOCK_US: u64 = 5_000_000;
/// Fewest such numbers that tell how far they scatter.
const LEAST_BLOCKS: f64 = 4.0;
/// Share of the weight by which the cells may be off.
const TOLERATED: f64 = 0.01;
/// Standard errors of the mean beyond which that is no chance.
const BEYOND_CHANCE: f64 = 3.0;

/// What the load cells of a drive bear, frame by frame, in running sums.
#[derive(Debug, Clone)]
pub struct Weighing {
    weight_n: f64,
    block: Block,
    due_n: Running,
    /// What is borne beyond that.
    excess_n: Running,
}

/// The sums of some seconds.
#[derive(Debug, Clone, Copy, Default)]
struct Block {
    number: u64,
    frames: u32,
    borne_n: f64,
    due_n: f64,
}

/// Load cells that do not bear what they should.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// What they bear together, N.
    pub borne_n: f64,
    /// What mass and gravity make of it, N.
    pub due_n: f64,
}

impl Weighing {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        let weight_n = f64::from(rover.mass_kg) * f64::from(rover.gravity_m_s2);
        let [due_n, excess_n] = Default::default();
        Self { weight_n, block: Block::default(), due_n, excess_n }
    }

    /// Takes a frame: one in which the rover drives, and all that is needed says something.
    pub fn take(&mut self, frame: &SensorFrame) {
        let number = frame.time_us / BLOCK_US;
        if number != self.block.number {
            self.close_block();
            self.block.number = number;
        }
        if let Some((borne_n, due_n)) = is_driving(frame).then(|| self.borne_and_due_n(frame)).flatten() {
            self.block.frames += 1;
            self.block.borne_n += borne_n;
            self.block.due_n += due_n;
        }
    }

    /// What the wheels bear along the body's upright by the cells of a frame, and what they should, N.
    fn borne_and_due_n(&self, frame: &SensorFrame) -> Option<(f64, f64)> {
        let felt = frame.accel_m_s2.map(wide).all()?;
        let size = felt.x.hypot(felt.y).hypot(felt.z);
        if size <= 0.0 {
            return None;
        }
        let [ahead_n, due_n] = [felt.x, felt.z].map(|felt| self.weight_n * felt / size);
        let (upright_n, backward_n) = cells_n(frame)?;
        // What pulls along the links no cell feels: what balances the rest along the body, each wheel's in proportion to its load.
        let borne_n = upright_n + (ahead_n + backward_n) * backward_n / upright_n;
        borne_n.is_finite().then_some((borne_n, due_n))
    }

    fn close_block(&mut self) {
        let Block { frames, borne_n, due_n, .. } = std::mem::take(&mut self.block);
        if frames > 0 {
            let [borne_n, due_n] = [borne_n, due_n].map(|sum| sum / f64::from(frames));
            self.due_n.take(due_n);
            self.excess_n.take(borne_n - due_n);
        }
    }

    /// What came of it, where the cells are off by more than is tolerated and than chance does.
    pub fn misfit(mut self) -> Option<Misfit> {
        self.close_block();
        let (due_n, excess_n) = (self.due_n.mean, self.excess_n.mean);
        let is_off = self.excess_n.count >= LEAST_BLOCKS
            && excess_n.abs() > TOLERATED * due_n
            && excess_n.abs() > BEYOND_CHANCE * self.excess_n.standard_error();
        is_off.then_some(Misfit { borne_n: due_n + excess_n, due_n })
    }
}

impl fmt::Display for Misfit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { borne_n, due_n } = self;
        write!(
            formatter,
            "the load cells together bear {borne_n:.0} N where the rover's mass and gravity make {due_n:.0} N: mass, gravity or \
             the cells' zero is off, and loads, pulls and soil with it"
        )
    }
}

/// Forces along the links of a rover that stands are whatever friction left there.
fn is_driving(frame: &SensorFrame) -> bool {
    wide(frame.velocity_m_s.x).is_some_and(|speed| speed.abs() > DRIVING_M_S)
}

/// What the cells bear together along the body's upright and towards its tail, N. Each is square to its link.
fn cells_n(frame: &SensorFrame) -> Option<(f64, f64)> {
    let links = links(frame, rockers(frame));
    let mut sums = (0.0, 0.0);
    for (wheel, link) in frame.wheels.iter_wheels().zip(links.iter_wheels()) {
        let (cell_n, (sine, cosine)) = (wide(wheel.load_cell_n)?, (*link)?.sin_cos());
        sums = (sums.0 + cell_n * cosine, sums.1 + cell_n * sine);
    }
    Some(sums)
}
