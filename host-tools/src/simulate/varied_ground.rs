//! Ground of any kind, so that nothing that learns from simulated drives takes one kind of hills and stones for the world.

use kapvik_firmware::rover::PerSide;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::course::{Hills, draw_hills};
use super::terrain::Shape;
use crate::prior::Range;

/// From where on the ground is uneven, m: the front wheels stand at 0.35 m.
const FROM_M: f64 = 0.4;
/// Beyond where any drive ends, m.
const BEYOND_M: f64 = 1.0e3;
/// How many waves a side has.
const WAVES: std::ops::RangeInclusive<usize> = 1..=12;
/// The shortest of the waves is drawn from these, m; from there on they are as long as [`LONGEST_M`].
const SHORTEST_M: Range = Range::logarithmic(0.15, 1.5);
const LONGEST_M: f64 = 4.0;
/// The steepest place of the waves, degrees.
const STEEPEST_DEG: Range = Range::logarithmic(0.5, 14.0);
/// Wheels that pull this much of their load meet all of the relief; any meet this share of it.
const FULL_RELIEF_PULL_RATIO: f64 = 0.16;
const LEAST_RELIEF: f64 = 0.05;
/// Shares of drives whose sides are alike, that have a ramp, and that have stones.
const SIDES_ALIKE: f64 = 0.3;
const WITH_RAMP: f64 = 0.3;
const WITH_STONES: f64 = 0.4;
/// The slope of a ramp and of the steepest place of a stone, degrees.
const RAMP_DEG: f64 = 12.0;
const STONE_DEG: (f64, f64) = (5.0, 28.0);
/// How long stones are, m, and how many lie under a side at most.
const STONE_M: (f64, f64) = (0.2, 0.7);
const STONES: usize = 2;

/// Both sides' relief for a rover whose wheels pull at most so much of their load: the less, the gentler.
pub fn draw_varied_ground(random: &mut ChaCha8Rng, pull_ratio: f64) -> PerSide<Vec<Shape>> {
    let share = (pull_ratio / FULL_RELIEF_PULL_RATIO).clamp(LEAST_RELIEF, 1.0);
    let left = draw_waves(random, share);
    let right = if random.random::<f64>() < SIDES_ALIKE { left.clone() } else { draw_waves(random, share) };
    let mut sides = PerSide { left, right };
    if random.random::<f64>() < WITH_RAMP {
        let ramp = draw_ramp(random, share);
        sides.as_array_mut().into_iter().for_each(|shapes| shapes.push(ramp));
    }
    if random.random::<f64>() < WITH_STONES {
        for shapes in sides.as_array_mut() {
            let stones = random.random_range(0..=STONES);
            shapes.extend((0..stones).map(|_| draw_stone(random, share)));
        }
    }
    sides
}

fn draw_waves(random: &mut ChaCha8Rng, share: f64) -> Vec<Shape> {
    let slope_rad = share * STEEPEST_DEG.at(random.random::<f64>()).to_radians();
    let hills = Hills {
        waves: random.random_range(WAVES),
        wavelengths_m: Range::logarithmic(SHORTEST_M.at(random.random::<f64>()), LONGEST_M),
        steepest_rad: (0.9 * slope_rad, slope_rad),
    };
    draw_hills(random, (FROM_M, BEYOND_M), &hills)
}

fn draw_ramp(random: &mut ChaCha8Rng, share: f64) -> Shape {
    let from_m = random.random_range(FROM_M..1.2);
    Shape::Ramp {
        between_m: (from_m, from_m + random.random_range(0.3..3.0)),
        slope: share * libm::tan(random.random_range(-RAMP_DEG..RAMP_DEG).to_radians()),
        rounding_m: random.random_range(0.15..1.0),
    }
}

/// The steepest place of a raised cosine of this height is π times height over length.
fn draw_stone(random: &mut ChaCha8Rng, share: f64) -> Shape {
    let length_m = random.random_range(STONE_M.0..STONE_M.1);
    let slope = share * libm::tan(random.random_range(STONE_DEG.0..STONE_DEG.1).to_radians());
    Shape::Bump {
        from_m: random.random_range(FROM_M..1.6),
        length_m,
        height_m: length_m * slope / std::f64::consts::PI,
    }
}
