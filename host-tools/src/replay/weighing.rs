//! The rover weighed by its own load cells: whether together they bear what its mass and gravity say.

use std::fmt;

use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::{drives, links, rockers, wide};
use crate::statistics::running::Running;

/// Frames of so long are taken as one number, µs: over rough ground the errors of one frame are those of the next.
const BLOCK_US: u64 = 5_000_000;
/// Fewest such numbers that tell how far they scatter.
const LEAST_BLOCKS: f64 = 4.0;
/// Share of the weight by which the cells may be off.
const TOLERATED: f64 = 0.01;
/// Standard errors of the mean beyond which that is no chance.
const BEYOND_CHANCE: f64 = 3.0;
/// A cell that feels a smaller share than this of what its wheel bears tells nothing of it.
const LEAST_FELT: f64 = 0.5;

/// What the load cells of a drive bear, frame by frame, in running sums.
#[derive(Debug, Clone)]
pub struct Weighing {
    weight_n: f64,
    radius_m: f64,
    block: Block,
    borne_n: Running,
    /// What of it is more than is due.
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
        let [borne_n, excess_n] = Default::default();
        Self { weight_n, radius_m: rover.wheel.radius_m.into(), block: Block::default(), borne_n, excess_n }
    }

    /// Takes a frame: one in which the rover drives, and all that is needed says something. Forces along the links of one that stands are whatever
    /// friction left there.
    pub fn take(&mut self, frame: &SensorFrame) {
        let number = frame.time_us / BLOCK_US;
        if number != self.block.number {
            self.close_block();
            self.block.number = number;
        }
        if let Some((borne_n, due_n)) = drives(frame, self.radius_m).then(|| self.borne_and_due_n(frame)).flatten() {
            self.block.frames += 1;
            self.block.borne_n += borne_n;
            self.block.due_n += due_n;
        }
    }

    /// What the wheels bear by the cells of a frame along the force that is felt in the plane of the sides, and what they should, N.
    fn borne_and_due_n(&self, frame: &SensorFrame) -> Option<(f64, f64)> {
        let felt = frame.accel_m_s2.map(wide).all()?;
        let in_plane = felt.x.hypot(felt.z);
        if in_plane <= 0.0 {
            return None;
        }
        let due_n = self.weight_n * in_plane / in_plane.hypot(felt.y);
        Some((borne_n(frame, felt.x.atan2(felt.z))?, due_n))
    }

    fn close_block(&mut self) {
        let Block { frames, borne_n, due_n, .. } = std::mem::take(&mut self.block);
        if frames > 0 {
            let [borne_n, due_n] = [borne_n, due_n].map(|sum| sum / f64::from(frames));
            self.borne_n.take(borne_n);
            self.excess_n.take(borne_n - due_n);
        }
    }

    /// What came of it, where the cells are off by more than is tolerated and than chance does.
    pub fn misfit(mut self) -> Option<Misfit> {
        self.close_block();
        let (borne_n, excess_n) = (self.borne_n.mean, self.excess_n.mean);
        let due_n = borne_n - excess_n;
        let is_off = self.excess_n.count >= LEAST_BLOCKS
            && excess_n.abs() > TOLERATED * due_n
            && excess_n.abs() > BEYOND_CHANCE * self.excess_n.standard_error();
        is_off.then_some(Misfit { borne_n, due_n })
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

/// What the wheels bear together along a force that leans ahead of the body's upright by so much, rad, in N.
///
/// A cell feels what is square to its link, and nothing feels what pulls along it. Taken for what a wheel bears that goes along the force:
/// what there is beside it goes ahead on some wheels and back on others, and adds up to nothing.
fn borne_n(frame: &SensorFrame, ahead_rad: f64) -> Option<f64> {
    let links = links(frame, rockers(frame).map(|rocker| rocker.map(|angle| angle + ahead_rad)));
    let wheels = frame.wheels.iter_wheels().zip(links.iter_wheels());
    let each_n = wheels.map(|(wheel, link)| {
        let felt = (*link)?.cos();
        wide(wheel.load_cell_n).filter(|_| felt >= LEAST_FELT).map(|cell_n| cell_n / felt)
    });
    each_n.sum()
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::rover::Axes;

    use super::*;

    /// A frame of a rover that stands as it should and feels gravity from so far ahead, rad, whose wheels bear a sixth of 600 N each.
    fn leaning(ahead_rad: f32, rocker_rad: f32, bogie_rad: f32) -> SensorFrame {
        let mut frame = SensorFrame { rocker_angle_rad: Some(rocker_rad), ..SensorFrame::default() };
        frame.bogie_angle_rad.as_array_mut().into_iter().for_each(|angle| *angle = Some(bogie_rad));
        frame.accel_m_s2 = Axes { x: Some(9.81 * ahead_rad.sin()), y: Some(0.0), z: Some(9.81 * ahead_rad.cos()) };
        let angles = links(&frame, rockers(&frame));
        for (wheel, link) in frame.wheels.iter_wheels_mut().zip(angles.iter_wheels()) {
            wheel.load_cell_n = link.map(|link| 100.0 * (link as f32 + ahead_rad).cos());
        }
        frame
    }

    /// Nose-up is positive for pitch and links: a link of the opposite angle to the pitch is level.
    #[test]
    fn links_that_hang_askew_bear_what_they_should() {
        for (ahead_rad, rocker_rad, bogie_rad) in
            [(0.0, 0.0, 0.0), (0.2, -0.1, 0.0), (-0.2, 0.04, -0.2), (0.1, 0.1, 0.2)]
        {
            let frame = leaning(ahead_rad, rocker_rad, bogie_rad);
            let borne_n = borne_n(&frame, ahead_rad.into()).expect("all sensors speak");
            assert!((borne_n - 600.0).abs() < 1e-3, "{ahead_rad} {rocker_rad} {bogie_rad}: {borne_n} N");
        }
    }

    #[test]
    fn on_a_side_slope_less_is_due() {
        let weighing = Weighing::of(&Rover::<f64>::assumed().map(|value| value as f32));
        let mut frame = leaning(0.1, 0.0, 0.0);
        frame.accel_m_s2.y = Some(9.81 * 0.75);
        let (_, due_n) = weighing.borne_and_due_n(&frame).expect("all sensors speak");
        assert!((due_n - 0.8 * 41.0 * 9.81).abs() < 0.01, "{due_n} N");
    }

    #[test]
    fn links_that_no_rover_has_tell_nothing() {
        assert_eq!(borne_n(&leaning(0.0, 0.0, 9.9), 0.0), None);
        let mut silent = leaning(0.0, 0.0, 0.0);
        silent.wheels.left.middle.load_cell_n = None;
        assert_eq!(borne_n(&silent, 0.0), None);
    }
}
