//! Uneven ground: a height over distance for each side, smooth in height and slope.

use std::f64::consts::TAU;

use kapvik_firmware::rover::{Axle, PerSide, Side};

/// Height of the ground and its derivatives by x at one place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ground {
    /// Height, m.
    pub height_m: f64,
    /// Rise over run.
    pub slope: f64,
    /// Rate of change of the slope, 1/m.
    pub slope_change_1_m: f64,
}

/// Over how much of the way waves grow and fade, m.
const FADE_M: f64 = 0.5;

/// A piece of relief. Pieces add up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A sine wave between two places, fading in and out over half a metre so that its ends are smooth.
    Wave {
        /// Where it starts and ends, m.
        between_m: (f64, f64),
        /// Half of its height, m.
        amplitude_m: f64,
        /// Its length, m.
        wavelength_m: f64,
        /// Its phase, rad.
        phase_rad: f64,
    },
    /// A ramp of constant slope between two places, level before and behind, rounded over the given length.
    Ramp {
        /// Where it starts and ends, m: where half of the slope is reached.
        between_m: (f64, f64),
        /// Rise over run.
        slope: f64,
        /// Over how much the slope grows, m.
        rounding_m: f64,
    },
    /// A bump, or a hole where the height is negative: one period of a raised cosine, which a wheel can follow everywhere.
    Bump {
        /// Where it starts, m.
        from_m: f64,
        /// How long it is, m.
        length_m: f64,
        /// How high it is, m.
        height_m: f64,
    },
}

impl Shape {
    /// The ground that this piece adds at a distance.
    pub fn at(&self, x_m: f64) -> Ground {
        match *self {
            Self::Wave { between_m: (start, end), amplitude_m, wavelength_m, phase_rad } => {
                let share = faded_in(x_m, start, 1.0).times(faded_in(x_m, end, -1.0));
                let number_1_m = TAU / wavelength_m;
                let (sine, cosine) = libm::sincos(number_1_m * x_m + phase_rad);
                let wave =
                    Step { value: sine, slope: number_1_m * cosine, slope_change: -number_1_m * number_1_m * sine };
                share.times(wave).ground(amplitude_m)
            }
            Self::Ramp { between_m: (start, end), slope, rounding_m } => {
                let (up, down) = (corner(x_m - start, rounding_m), corner(x_m - end, rounding_m));
                Step {
                    value: up.value - down.value,
                    slope: up.slope - down.slope,
                    slope_change: up.slope_change - down.slope_change,
                }
                .ground(slope)
            }
            Self::Bump { from_m, length_m, height_m } => {
                let share = (x_m - from_m) / length_m;
                if !(0.0..=1.0).contains(&share) {
                    return Ground::default();
                }
                let number_1_m = TAU / length_m;
                let (sine, cosine) = libm::sincos(TAU * share);
                Step { value: 1.0 - cosine, slope: number_1_m * sine, slope_change: number_1_m * number_1_m * cosine }
                    .ground(0.5 * height_m)
            }
        }
    }
}

/// A function at one place, with its first and second derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub value: f64,
    pub slope: f64,
    pub slope_change: f64,
}

impl Step {
    fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
            slope_change: self.slope_change * other.value
                + 2.0 * self.slope * other.slope
                + self.value * other.slope_change,
        }
    }

    fn ground(self, factor: f64) -> Ground {
        let Self { value, slope, slope_change } = self;
        Ground { height_m: factor * value, slope: factor * slope, slope_change_1_m: factor * slope_change }
    }
}

/// A step from 0 to 1 over the unit interval: 10 x³ − 15 x⁴ + 6 x⁵.
pub(super) fn smooth_step(x: f64) -> Step {
    let x = x.clamp(0.0, 1.0);
    Step {
        value: x * x * x * (10.0 - x * (15.0 - 6.0 * x)),
        slope: 30.0 * x * x * (1.0 - x) * (1.0 - x),
        slope_change: 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
    }
}

/// Grows from 0 to 1 over [`FADE_M`] from `from_m` on in one direction of x.
fn faded_in(x_m: f64, from_m: f64, direction: f64) -> Step {
    let step = smooth_step(direction * (x_m - from_m) / FADE_M);
    Step {
        value: step.value,
        slope: direction / FADE_M * step.slope,
        slope_change: step.slope_change / (FADE_M * FADE_M),
    }
}

/// max(0, x), rounded over `rounding` around zero: there the integral of the step 3 s² − 2 s³.
fn corner(x: f64, rounding: f64) -> Step {
    let share = x / rounding + 0.5;
    if share <= 0.0 {
        return Step { value: 0.0, slope: 0.0, slope_change: 0.0 };
    }
    if share >= 1.0 {
        return Step { value: x, slope: 1.0, slope_change: 0.0 };
    }
    Step {
        value: rounding * share.powi(3) * (1.0 - 0.5 * share),
        slope: share * share * (3.0 - 2.0 * share),
        slope_change: 6.0 * share * (1.0 - share) / rounding,
    }
}

/// The ground under a rover that drives straight along x.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Terrain {
    /// Relief under all wheels of a side.
    pub sides: PerSide<Vec<Shape>>,
    /// Relief that one wheel alone meets, as if the others of its side stepped over it.
    pub under_one: Option<(Side, Axle, Shape)>,
}

impl Terrain {
    /// The ground under a wheel.
    pub fn at(&self, side: Side, axle: Axle, x_m: f64) -> Ground {
        let alone = self.under_one.iter().filter(|(s, a, _)| (*s, *a) == (side, axle)).map(|(_, _, shape)| shape);
        self.sides.of(side).iter().chain(alone).map(|shape| shape.at(x_m)).fold(Ground::default(), |sum, piece| {
            Ground {
                height_m: sum.height_m + piece.height_m,
                slope: sum.slope + piece.slope,
                slope_change_1_m: sum.slope_change_1_m + piece.slope_change_1_m,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Shape;

    #[test]
    fn slopes_and_their_changes_are_derivatives() {
        let shapes = [
            Shape::Wave { between_m: (0.5, 4.0), amplitude_m: 0.05, wavelength_m: 1.3, phase_rad: 0.4 },
            Shape::Ramp { between_m: (0.5, 2.0), slope: 0.2, rounding_m: 0.5 },
            Shape::Bump { from_m: 1.0, length_m: 0.5, height_m: -0.08 },
        ];
        let step = 1.0e-6;
        for shape in shapes {
            for place in 0..1000 {
                let x = 0.005 * f64::from(place) + 1.0e-4;
                let (here, before, after) = (shape.at(x), shape.at(x - step), shape.at(x + step));
                let slope = (after.height_m - before.height_m) / (2.0 * step);
                assert!((here.slope - slope).abs() < 1.0e-8, "{shape:?} at {x}");
                let change = (after.slope - before.slope) / (2.0 * step);
                assert!((here.slope_change_1_m - change).abs() < 1.0e-4, "{shape:?} at {x}: {here:?} {change}");
            }
        }
    }
}
