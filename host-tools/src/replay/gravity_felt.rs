//! Whether the accelerometer feels the gravity that the rover file states: one that speaks in other units does not.

use std::fmt;

use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::wide;
use super::running_median::RunningMedian;

/// Share of gravity by which what is felt may be off: rovers on wheels hardly speed up, and no scale of a sensor errs by so much.
const TOLERATED: f64 = 0.1;
/// Fewest frames that tell.
const LEAST_FRAMES: u32 = 20;

/// What the accelerometer feels over a drive: its median, which outliers do not move.
#[derive(Debug, Clone)]
pub struct GravityFelt {
    stated_m_s2: f64,
    /// What is felt over what is stated.
    times: RunningMedian,
}

/// An accelerometer that feels another gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherGravity {
    /// What it feels, m/s².
    pub felt_m_s2: f64,
    /// Whether it is that or any more.
    pub is_least: bool,
    /// What the rover file states, m/s².
    pub stated_m_s2: f64,
}

impl GravityFelt {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self { stated_m_s2: rover.gravity_m_s2.into(), times: RunningMedian::of_none(1e-4, 1.001, 20_000) }
    }

    /// Takes a frame. Without the axis across, what leans to a side is felt a little lighter.
    pub fn take(&mut self, frame: &SensorFrame) {
        let felt = frame.accel_m_s2;
        let axes = [felt.x, felt.y.or(Some(0.0)), felt.z].map(wide);
        let [Some(x), Some(y), Some(z)] = axes else { return };
        let size_m_s2 = x.hypot(y).hypot(z);
        self.times.take(size_m_s2 / self.stated_m_s2);
    }

    /// What it feels, where that is not gravity.
    pub fn other(&self) -> Option<OtherGravity> {
        let stated_m_s2 = self.stated_m_s2;
        let (times, farthest) = (self.times.median()?, self.times.farthest());
        let felt_m_s2 = stated_m_s2 * times.min(farthest);
        let is_other = self.times.count() >= LEAST_FRAMES && (felt_m_s2 - stated_m_s2).abs() > TOLERATED * stated_m_s2;
        is_other.then_some(OtherGravity { felt_m_s2, is_least: times >= farthest, stated_m_s2 })
    }
}

impl fmt::Display for OtherGravity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { felt_m_s2, is_least, stated_m_s2 } = self;
        let more_than = if *is_least { "more than " } else { "" };
        write!(
            formatter,
            "the accelerometer feels {more_than}{felt_m_s2:.2} m/s² where gravity is {stated_m_s2:.2}: it speaks in other units, or gravity is \
             off, and contact angles and pulls with it"
        )
    }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::rover::Axes;

    use super::*;

    fn felt(z_m_s2: f32, frames: u32) -> Option<OtherGravity> {
        felt_beside(Some(0.0), z_m_s2, frames)
    }

    fn felt_beside(y_m_s2: Option<f32>, z_m_s2: f32, frames: u32) -> Option<OtherGravity> {
        let mut felt = GravityFelt::of(&Rover::<f64>::assumed().map(|value| value as f32));
        let accel_m_s2 = Axes { x: Some(0.3), y: Some(f32::NAN), z: Some(z_m_s2) };
        felt.take(&SensorFrame { accel_m_s2, ..SensorFrame::default() });
        let accel_m_s2 = Axes { y: y_m_s2, ..accel_m_s2 };
        (0..frames).for_each(|_| felt.take(&SensorFrame { accel_m_s2, ..SensorFrame::default() }));
        felt.other()
    }

    #[test]
    fn gravities_are_told_of_another() {
        assert_eq!(felt(9.7, 100), None);
        assert_eq!(felt(1.0, 10), None, "too few frames tell nothing");
        assert!(felt_beside(None, 1.0, 100).is_some() && felt_beside(None, 9.7, 100).is_none());
        let said = felt(1.0, 100).expect("in gravities").to_string();
        assert!(said.contains("feels 1.04 m/s² where gravity is 9.81"), "{said}");
        let said = felt(9810.0, 100).expect("in millimetres").to_string();
        assert!(said.contains("where gravity is 9.81: it speaks in other units"), "{said}");
        assert!(said.contains("feels 98"), "{said}");
        let said = felt(1e6, 100).expect("broken").to_string();
        assert!(said.contains("feels more than 4"), "{said}");
    }
}
