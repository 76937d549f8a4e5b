//! The elementary functions of the flight path against f64, over every f32 of their stated ranges.
//!
//! Meant for `cargo test --release`, where it takes about a minute on two cores. A debug build looks at one f32 in
//! `STRIDE`, which still meets every binade and every branch. Each test prints the worst error and where it is, and
//! fails where it exceeds what the function's documentation states.

#[path = "support/worse.rs"]
mod worse;

use std::ops::RangeInclusive;

use kapvik_firmware::math;
use rayon::prelude::*;
use worse::worse;

/// A prime, so that the low bits of the arguments take all values.
const STRIDE: u32 = if cfg!(debug_assertions) { 4099 } else { 1 };

/// Below this magnitude two terms of a Taylor series are exact to f64 as far as f32 can tell: the next one is less than
/// 2⁻⁴⁸ of the first.
const SMALL: f32 = 1.0 / 4096.0;

/// An error and the argument that it was found at.
#[derive(Clone, Copy, Debug)]
struct Worst<A> {
    error: f64,
    at: A,
}

impl<A> Worst<A> {
    /// The worse of two; an error that is not a number is the worst of all.
    fn or(self, other: Self) -> Self {
        if other.error > self.error || other.error.is_nan() { other } else { self }
    }
}

/// Worst error over all non-negative f32 between two, in parallel.
fn sweep(range: RangeInclusive<f32>, error_at: impl Fn(f32) -> f64 + Sync) -> Worst<f32> {
    const CHUNK: u32 = 1 << 18;
    let (first, last) = (range.start().to_bits(), range.end().to_bits());
    (first / CHUNK..=last / CHUNK)
        .into_par_iter()
        .map(|chunk| {
            let begin = (chunk * CHUNK).max(first).next_multiple_of(STRIDE);
            let end = (chunk * CHUNK + (CHUNK - 1)).min(last);
            (begin..=end)
                .step_by(STRIDE as usize)
                .map(f32::from_bits)
                .chain([f32::from_bits(end)])
                .fold(Worst { error: 0.0, at: *range.start() }, |worst, at| worst.or(Worst { error: error_at(at), at }))
        })
        .reduce_with(Worst::or)
        .expect("a range has at least one chunk")
}

/// Distance of `got` from `exact` in units in the last place of f32 at `exact`; that of the smallest normal number for
/// what is smaller. Where the nearest f32 is infinite, so must `got` be.
fn ulps(got: f32, exact: f64) -> f64 {
    const FIRST_THAT_ROUNDS_TO_INFINITY: f64 = 340_282_356_779_733_661_637_539_395_458_142_568_448.0;
    if exact.abs() >= FIRST_THAT_ROUNDS_TO_INFINITY {
        return if f64::from(got) == exact.signum() * f64::INFINITY { 0.0 } else { f64::INFINITY };
    }
    let exponent = ((exact.to_bits() >> 52) & 0x7ff).max(1023 - 126);
    let ulps_in_one = f64::from_bits((2 * 1023 + 23 - exponent) << 52);
    (f64::from(got) - exact).abs() * ulps_in_one
}

fn report<A: std::fmt::Display>(what: &str, worst: &Worst<A>, bound: f64) {
    println!("{what}: worst error {:.4e} at {}, stated {bound:.2e}", worst.error, worst.at);
    assert!(worst.error <= bound, "{what}: {:e} at {} is more than {bound:e}", worst.error, worst.at);
}

fn exact_sin_cos(x: f32) -> (f64, f64) {
    let wide = f64::from(x);
    if x.abs() < SMALL { (wide - wide * wide * wide / 6.0, 1.0 - wide * wide / 2.0) } else { wide.sin_cos() }
}

/// Greater of the errors of sine and cosine in ulp; infinite where a result leaves −1 … 1 or the symmetry is not exact.
fn sin_cos_error(x: f32) -> f64 {
    let (sine, cosine) = math::sin_cos(x);
    let (mirrored_sine, mirrored_cosine) = math::sin_cos(-x);
    let symmetric = mirrored_sine.to_bits() == (-sine).to_bits() && mirrored_cosine.to_bits() == cosine.to_bits();
    if !symmetric || sine.abs() > 1.0 || cosine.abs() > 1.0 {
        return f64::INFINITY;
    }
    let (exact_sine, exact_cosine) = exact_sin_cos(x);
    worse(ulps(sine, exact_sine), ulps(cosine, exact_cosine))
}

#[test]
fn sine_and_cosine() {
    report("sin_cos, |x| <= 2 pi, ulp", &sweep(0.0..=std::f32::consts::TAU, sin_cos_error), 1.31);
    report("sin_cos, |x| <= 400, ulp", &sweep(std::f32::consts::TAU..=400.0, sin_cos_error), 1.44);
}

#[test]
fn sine_and_cosine_of_great_angles() {
    let relative_to_angle = |x: f32| {
        let (sine, cosine) = math::sin_cos(x);
        let (exact_sine, exact_cosine) = f64::from(x).sin_cos();
        let bounded = sine.abs() <= 1.0 && cosine.abs() <= 1.0;
        let error = (f64::from(sine) - exact_sine).abs().max((f64::from(cosine) - exact_cosine).abs());
        if bounded { error / f64::from(x) } else { f64::INFINITY }
    };
    report("sin_cos, 400 <= |x| <= 1e6, of |x|", &sweep(400.0..=1e6, relative_to_angle), 2.0_f64.powi(-22));
    let unbounded = |x: f32| {
        let (sine, cosine) = math::sin_cos(x);
        f64::from(u8::from(!(sine.abs() <= 1.0 && cosine.abs() <= 1.0)))
    };
    report("sin_cos, |x| > 1e6, outside -1 ... 1", &sweep(1e6..=f32::MAX, unbounded), 0.0);
}

#[test]
fn arc_cosine() {
    let error = |x: f32| {
        let wide = f64::from(x);
        let exact =
            if x.abs() < SMALL { std::f64::consts::FRAC_PI_2 - (wide + wide * wide * wide / 6.0) } else { wide.acos() };
        // Both signs from one reference: acos(-x) = pi - acos x.
        worse(ulps(math::acos(x), exact), ulps(math::acos(-x), std::f64::consts::PI - exact))
    };
    report("acos, |x| <= 1, ulp", &sweep(0.0..=1.0, error), 1.14);
}

#[test]
fn exponential() {
    let exact = |x: f32| {
        let wide = f64::from(x);
        if x.abs() < SMALL { 1.0 + (wide + wide * wide / 2.0 + wide * wide * wide / 6.0) } else { wide.exp() }
    };
    let error = |x: f32| worse(ulps(math::exp(x), exact(x)), ulps(math::exp(-x), exact(-x)));
    report("exp, |x| <= 110, ulp", &sweep(0.0..=110.0, error), 0.99);
    let not_saturated = |x: f32| f64::from(u8::from(math::exp(x) != f32::INFINITY || math::exp(-x) != 0.0));
    report("exp, |x| > 110, not saturated", &sweep(110.0..=f32::INFINITY, not_saturated), 0.0);
}

#[test]
fn logarithm() {
    let error = |x: f32| ulps(math::ln(x), f64::from(x).ln());
    report("ln, subnormal, ulp", &sweep(f32::from_bits(1)..=f32::MIN_POSITIVE, error), 0.84);
    report("ln, near 1, ulp", &sweep(0.5..=2.0, error), 0.84);
    // For all binades but those the logarithm of a mantissa serves for every exponent: the sum has no cancellation.
    let over_exponents = |mantissa: f32| {
        let exact = f64::from(mantissa).ln();
        let error = |exponent: i32| {
            let x = mantissa * f32::from_bits(((127 + exponent) as u32) << 23);
            ulps(math::ln(x), f64::from(exponent) * std::f64::consts::LN_2 + exact)
        };
        (-126..-1).chain(1..=127).map(error).fold(0.0, worse)
    };
    report("ln, worst of a mantissa, ulp", &sweep(1.0..=2.0_f32.next_down(), over_exponents), 0.84);
    let not_nan = |x: f32| f64::from(u8::from(!math::ln(-x).is_nan()));
    report("ln of a negative number, not NaN", &sweep(f32::from_bits(1)..=f32::INFINITY, not_nan), 0.0);
}

#[test]
fn square_root() {
    let error = |x: f32| ulps(math::sqrt(x), f64::from(x).sqrt());
    report("sqrt, ulp", &sweep(0.0..=f32::MAX, error), 0.5);
}

#[test]
fn hyperbolic_tangent() {
    let exact = |x: f32| {
        let wide = f64::from(x);
        if x < SMALL { wide - wide * wide * wide / 3.0 } else { wide.tanh() }
    };
    let relative = |x: f32| {
        let got = math::tanh(x);
        let odd = math::tanh(-x).to_bits() == (-got).to_bits();
        let exact = exact(x);
        if odd && got.abs() <= 1.0 { (f64::from(got) - exact).abs() / exact } else { f64::INFINITY }
    };
    report("tanh, relative", &sweep(f32::from_bits(1)..=20.0, relative), 5.1e-7);
    // What is smaller has a smaller absolute error by the relative one.
    let absolute = |x: f32| (f64::from(math::tanh(x)) - exact(x)).abs();
    report("tanh, absolute", &sweep(0.5..=20.0, absolute), 3.6e-7);
    let step_back = |x: f32| f64::from(math::tanh(x)) - f64::from(math::tanh(x.next_up()));
    report("tanh, step back", &sweep(SMALL / 2.0..=8.0, step_back), 2.4e-7);
    let not_saturated = |x: f32| f64::from(u8::from(math::tanh(x) != 1.0 || math::tanh(-x) != -1.0));
    report("tanh, |x| >= 8, not saturated", &sweep(8.0..=f32::INFINITY, not_saturated), 0.0);
}

/// A pair of base and exponent.
struct Pair {
    base: f32,
    exponent: f32,
}

impl std::fmt::Display for Pair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:e}^{:e}", self.base, self.exponent)
    }
}

/// Point `index` of the additive low-discrepancy sequence of the plastic number, in the unit square.
fn low_discrepancy(index: u32) -> (f64, f64) {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let index = f64::from(index);
    ((0.5 + index / PLASTIC).fract(), (0.5 + index / (PLASTIC * PLASTIC)).fract())
}

/// Worst error of `powf` over a set of pairs, as a share of what `allowed` grants it in ulp.
fn power_sweep(pair_at: impl Fn(f64, f64) -> Pair + Sync, allowed: impl Fn(f64) -> f64 + Sync) -> Worst<Pair> {
    let error_at = |index: u32| {
        let (u, v) = low_discrepancy(index);
        let at = pair_at(u, v);
        let (base, exponent) = (f64::from(at.base), f64::from(at.exponent));
        let error = ulps(math::powf(at.base, at.exponent), base.powf(exponent)) / allowed(exponent * base.ln());
        Worst { error, at }
    };
    (1..40_000_000 / STRIDE).into_par_iter().map(error_at).reduce_with(Worst::or).expect("there are pairs")
}

#[test]
fn power_where_the_wheel_needs_it() {
    let pair = |u: f64, v: f64| Pair { base: 2.0 * u as f32, exponent: (0.1 + 1.9 * v) as f32 };
    report("powf, base in 0 ... 2, exponent in 0.1 ... 2, ulp", &power_sweep(pair, |_| 1.0), 1.0);
    let small_base = |u: f64, v: f64| Pair { base: (1.0 - 149.0 * u).exp2() as f32, exponent: (0.1 + 1.9 * v) as f32 };
    report("powf, logarithmic base, ulp", &power_sweep(small_base, |_| 1.0), 1.0);
    let base_near_one = |u: f64, v: f64| {
        let distance = (-24.0 * (2.0 * u - 1.0).abs()).exp2().copysign(u - 0.5);
        Pair { base: (1.0 + distance) as f32, exponent: (0.1 + 1.9 * v) as f32 }
    };
    report("powf, base near 1, ulp", &power_sweep(base_near_one, |_| 1.0), 1.0);
}

#[test]
fn power_everywhere() {
    let allowed = |logarithm: f64| 1.0 + logarithm.abs() / 3.0;
    let pair = |u: f64, v: f64| {
        let base = (277.0 * u - 149.0).exp2() as f32;
        // From the exponent that underflows to the one that overflows, and a little more.
        Pair { base, exponent: ((240.0 * v - 120.0) / f64::from(base).ln()) as f32 }
    };
    report("powf, every base, of what is stated", &power_sweep(pair, allowed), 1.0);
    let near_one = |u: f64, v: f64| {
        let base = (1.0 + 0.45 * (2.0 * u - 1.0) * (2.0 * u - 1.0).abs()) as f32;
        let exponent = ((240.0 * v - 120.0) / f64::from(base).ln()) as f32;
        Pair { base, exponent: exponent.clamp(-f32::MAX, f32::MAX) }
    };
    report("powf, bases around 1, of what is stated", &power_sweep(near_one, allowed), 1.0);
    let bits = |u: f64, v: f64| {
        let of = |share: f64, span: f64| f32::from_bits((share * span) as u32);
        Pair {
            base: of(u, 2_139_095_040.0),
            exponent: of((2.0 * v).fract(), 2_139_095_040.0) * (1.0 - 2.0 * v).signum() as f32,
        }
    };
    report("powf, every pattern of bits, of what is stated", &power_sweep(bits, allowed), 1.0);
}
