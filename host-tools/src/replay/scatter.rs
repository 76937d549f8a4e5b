//! Whether sensors scatter from frame to frame by more than the rover file states of their noise.

use std::fmt;

use kapvik_firmware::estimator::Sensor;
use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::running_median::RunningMedian;
use crate::data::sensor_channels::{noise_key, sensor_name, sensors, standard_deviations, values};
use crate::digits::significant;
use crate::statistics::PER_MEDIAN;

/// A sensor is told of where it scatters by so many times what is stated.
const TOLERATED: f64 = 1.5;
/// Fewest differences that tell.
const LEAST_DIFFERENCES: u32 = 200;
/// Times what is stated from which sizes are not told from greater ones.
const FARTHEST: f64 = 10_000.0;
/// Share of the time between two frames by which that between the next may be longer or shorter.
const UNEVEN: f64 = 0.25;
/// The standard deviation of x₀ − 3x₁ + 3x₂ − x₃ over that of white noise in x: √(1 + 9 + 9 + 1).
const OF_DIFFERENCE: f64 = 4.472_135_954_999_58;

/// The scatter of every sensor over a drive.
#[derive(Debug, Clone)]
pub struct Scatter {
    /// One standard deviation as stated, in the order of [`values`].
    stated: Vec<f64>,
    /// Of each sensor the sizes of its third differences, as multiples of what is stated.
    ///
    /// A difference of third order leaves nothing of what goes smoothly from frame to frame, and a median little of what comes seldom: a
    /// step, a stone, an outlier. What is left is white noise; noise that lasts from frame to frame does not show.
    sizes: Vec<RunningMedian>,
    /// The three frames before, the first of them first.
    before: [Row; 3],
}

/// What the sensors of a frame said.
#[derive(Debug, Clone, Default)]
struct Row {
    time_us: u64,
    values: Vec<Option<f32>>,
}

/// Sensors that scatter more than stated, or a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct Noisier {
    /// The key of `[noise]` in a rover file, where all of its sensors do, else the column of the one that does.
    pub name: String,
    /// One standard deviation as they show it, in the unit of the name.
    pub shown: f64,
    /// The same as stated.
    pub stated: f64,
}

impl Scatter {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        let stated = values(&standard_deviations(&rover.noise));
        let stated: Vec<f64> = stated.into_iter().map(|std| std.map_or(f64::NAN, f64::from)).collect();
        let sizes = vec![RunningMedian::of_none(0.01, 1.02, 700); stated.len()];
        Self { stated, sizes, before: Default::default() }
    }

    /// Takes the next frame.
    pub fn take(&mut self, frame: &SensorFrame) {
        let row = Row { time_us: frame.time_us, values: values(frame) };
        let [first, second, third] = &self.before;
        let rows = [first, second, third, &row];
        if is_even(rows.map(|row| row.time_us as f64)) {
            for (place, sizes) in self.sizes.iter_mut().enumerate() {
                let value = |row: &Row| row.values.get(place).copied().flatten().map(f64::from);
                let [first, second, third, fourth] = rows.map(value);
                let difference = || Some(fourth? - 3.0 * third? + 3.0 * second? - first?);
                let size = difference().map(|difference| difference.abs() / (OF_DIFFERENCE * self.stated[place]));
                size.into_iter().for_each(|size| sizes.take(size));
            }
        }
        self.before.rotate_left(1);
        self.before[2] = row;
    }

    /// The sensors that scatter more than stated.
    pub fn noisier(&self) -> Vec<Noisier> {
        let mut keys: Vec<&str> = Vec::new();
        for key in sensors().into_iter().map(noise_key) {
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        keys.into_iter().flat_map(|key| self.noisier_of(key)).collect()
    }

    /// Those of a key: the key itself, where all that can be told of do.
    fn noisier_of(&self, key: &str) -> Vec<Noisier> {
        let told = |(place, sensor): (usize, Sensor)| {
            let stated = self.stated[place];
            let sizes = Some(&self.sizes[place]).filter(|sizes| sizes.count() >= LEAST_DIFFERENCES)?;
            let shown = stated * PER_MEDIAN * sizes.median()?;
            Some(Noisier { name: sensor_name(sensor), shown, stated })
        };
        let of_key = sensors().into_iter().enumerate().filter(|(_, sensor)| noise_key(*sensor) == key);
        let of_key: Vec<Noisier> = of_key.filter_map(told).collect();
        let count = of_key.len();
        let noisier: Vec<Noisier> =
            of_key.into_iter().filter(|sensor| sensor.shown > TOLERATED * sensor.stated).collect();
        match noisier.first() {
            Some(&Noisier { stated, .. }) if noisier.len() == count => {
                let shown = noisier.iter().map(|sensor| sensor.shown).sum::<f64>() / count as f64;
                vec![Noisier { name: key.to_owned(), shown, stated }]
            }
            _ => noisier,
        }
    }
}

/// Whether times follow each other at even distances.
fn is_even([first, second, third, fourth]: [f64; 4]) -> bool {
    let (between, then, last) = (second - first, third - second, fourth - third);
    let is_alike = |other: f64| (other - between).abs() <= UNEVEN * between;
    between > 0.0 && is_alike(then) && is_alike(last)
}

impl fmt::Display for Noisier {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, shown, stated } = self;
        let times = shown / stated;
        // Greater sizes are counted as the greatest.
        let scatters = if times < FARTHEST { "" } else { "more than " };
        write!(
            formatter,
            "{name} scatters by {scatters}{} from frame to frame, {times:.1} times the {} that the rover file states: what rests on it \
             is less certain than is said",
            significant(*shown, 2),
            significant(*stated, 2),
        )
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::data::sensor_channels::values_mut;

    /// What is said of frames whose sensors rise smoothly and scatter by so many times what is stated, a place at a time.
    fn said(frames: u64, times: impl Fn(usize) -> f32) -> Vec<String> {
        let rover = Rover::<f64>::assumed().map(|value| value as f32);
        let stated = values(&standard_deviations(&rover.noise));
        let mut scatter = Scatter::of(&rover);
        let mut random = ChaCha8Rng::seed_from_u64(5);
        for index in 0..frames {
            let mut frame = SensorFrame { time_us: 100_000 * index, ..SensorFrame::default() };
            for (place, (value, std)) in values_mut(&mut frame).zip(&stated).enumerate() {
                let normal: f32 = StandardNormal.sample(&mut random);
                *value = std.map(|std| libm::sinf(0.01 * index as f32) + times(place) * std * normal);
            }
            scatter.take(&frame);
        }
        scatter.noisier().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn nothing_is_said_where_sensors_are_as_stated() {
        assert_eq!(said(1000, |_| 1.0), Vec::<String>::new());
        assert_eq!(said(100, |_| 5.0), Vec::<String>::new(), "too few frames tell nothing");
    }

    #[test]
    fn all_sensors_of_a_kind_are_told_of_by_their_key() {
        // The second of each wheel's three sensors is its torque.
        let said = said(1000, |place| if place < 18 && place % 3 == 1 { 2.5 } else { 1.0 });
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].starts_with("motor_torque_nm scatters by 0.1") && said[0].contains("2.5 times the 0.05"),
            "{said:?}"
        );
    }

    #[test]
    fn a_single_sensor_is_told_of_by_its_column() {
        let said = said(1000, |place| if place == 2 { 3.0 } else { 1.0 });
        assert!(said.len() == 1 && said[0].starts_with("load_cell_fl_n scatters by 1.5"), "{said:?}");
    }
}
