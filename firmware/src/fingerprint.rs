//! Fingerprints of the arithmetic: a checksum over the output bits of a fixed sweep. Two machines that give the same
//! fingerprints compute the same bits.
//!
//! A result that is not a number counts as one and the same, because the hardware chooses sign and payload of a NaN.

use crate::checksum::Checksum;
use crate::filter::trial::{self, Scales, Trial};
use crate::filter::{Gate, Gaussian, SigmaPointFilter};
use crate::math;
use crate::network::fixed_point::{FixedLayer, Pair, gated, rounded};
use crate::terramechanics::{Soil, Wheel, sinkage_for_load, wheel_forces};

/// A function's name and the fingerprint of its outputs.
pub struct Fingerprint {
    /// What is fingerprinted.
    pub name: &'static str,
    /// Runs the sweep.
    pub compute: fn() -> u32,
}

/// The elementary functions, layers of whole numbers, equations 1–11, with which flight does not compute, and steps of the
/// filter: [`SigmaPointFilter::predict`], [`SigmaPointFilter::random_walk`] and [`SigmaPointFilter::update`].
///
/// Not all of flight: the other functions of the filter ([`Gaussian::take`] among them), [`math::octaves()`] and
/// [`math::of_octaves`] are not in it, and [`math::sin_cos_of_slope`] only where the equations call it.
pub const FINGERPRINTS: [Fingerprint; 12] = [
    Fingerprint {
        name: "sin_cos",
        compute: || sweep(|x, digest| digest.add_all([math::sin_cos(x).0, math::sin_cos(x).1])),
    },
    Fingerprint { name: "acos", compute: || sweep(|x, digest| digest.add(math::acos(x))) },
    Fingerprint { name: "exp", compute: || sweep(|x, digest| digest.add(math::exp(x))) },
    Fingerprint { name: "ln", compute: || sweep(|x, digest| digest.add(math::ln(x))) },
    Fingerprint { name: "powf", compute: || sweep(powers) },
    Fingerprint { name: "sqrt", compute: || sweep(|x, digest| digest.add(math::sqrt(x))) },
    Fingerprint { name: "tanh", compute: || sweep(|x, digest| digest.add(math::tanh(x))) },
    Fingerprint { name: "fixed_point", compute: || sweep(fixed_point) },
    Fingerprint { name: "wheel_forces", compute: || grid(forces) },
    Fingerprint { name: "sinkage_for_load", compute: || grid(sinkage) },
    Fingerprint { name: "filter_6_6", compute: filter::<6, 6> },
    Fingerprint { name: "filter_12_18", compute: filter::<12, 18> },
];

/// The checksum of a row of numbers.
pub(crate) struct Digest(Checksum);

impl Digest {
    pub(crate) fn new() -> Self {
        Self(Checksum::new())
    }

    pub(crate) fn finish(self) -> u32 {
        self.0.finish()
    }

    pub(crate) fn add(&mut self, value: f32) {
        let value = if value.is_nan() { f32::NAN } else { value };
        self.0.add(&value.to_bits().to_le_bytes());
    }

    fn add_word(&mut self, word: u32) {
        self.0.add(&word.to_le_bytes());
    }

    pub(crate) fn add_all<const N: usize>(&mut self, values: [f32; N]) {
        values.into_iter().for_each(|value| self.add(value));
    }
}

/// The distance between the bit patterns that a sweep tries. Odd, so that the low bits vary as well.
const STRIDE: usize = 65_537;

/// Calls `function` with bit patterns spread over all of `f32`, both signs, infinities and NaNs included.
fn sweep(function: fn(f32, &mut Digest)) -> u32 {
    let mut digest = Digest::new();
    for bits in (0..=u32::MAX).step_by(STRIDE) {
        function(f32::from_bits(bits), &mut digest);
    }
    digest.finish()
}

/// The exponents that the equations raise to.
fn powers(base: f32, digest: &mut Digest) {
    digest.add_all([0.2, 0.5, 1.0, 1.1, 1.7].map(|exponent| math::powf(base, exponent)));
}

/// The next of a row of numbers between −1 and 1 (a linear congruential generator).
fn even(state: &mut u32) -> f32 {
    *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    state.cast_signed() as f32 * (1.0 / 2_147_483_648.0)
}

/// Layers of whole numbers: as many quads of inputs as the target's loop has beginnings, and a gate. One input is
/// swept, all else are any numbers, so that sums wrap around and saturate now and then.
fn fixed_point(input: f32, digest: &mut Digest) {
    let mut state = input.to_bits();
    fixed_layer::<5, 1>(input, &mut state, digest);
    fixed_layer::<2, 2>(input, &mut state, digest);
    fixed_layer::<3, 1>(input, &mut state, digest);
    fixed_layer::<4, 1>(input, &mut state, digest);
}

fn fixed_layer<const H: usize, const T: usize>(input: f32, state: &mut u32, digest: &mut Digest) {
    let mut layer = FixedLayer::<H, T>::ZERO;
    let weights = layer.weights.as_flattened_mut().as_flattened_mut().as_flattened_mut();
    weights.iter_mut().for_each(|place| *place = Pair(word(state)));
    layer.bias.as_flattened_mut().iter_mut().for_each(|place| *place = word(state).cast_signed());
    layer.fraction_bits = word(state) % 16;
    let swept = [input, even(state), even(state), even(state), even(state)];
    rounded::<2>(&swept, 12).as_flattened().iter().for_each(|pair| digest.add_word(pair.0));
    let mut inputs = rounded::<H>(&swept, 15);
    inputs.iter_mut().skip(2).for_each(|quad| *quad = [Pair(word(state)), Pair(word(state))]);
    let run = layer.run(&inputs);
    run.as_flattened().iter().for_each(|pair| digest.add_word(pair.0));
    let gate = [[Pair(word(state)), Pair(word(state))]; T];
    gated(&gate, &run).as_flattened().iter().for_each(|pair| digest.add_word(pair.0));
    digest.add_all(layer.outputs::<4>(&inputs));
}

/// The next of a row of 32-bit numbers; the lower half of the generator's is not even by itself.
fn word(state: &mut u32) -> u32 {
    even(state);
    *state ^ *state >> 16
}

/// A wheel on three soils, braking to spinning, barely sunk to deep.
fn grid(function: fn(&Wheel<f32>, &Soil<f32>, f32, f32, &mut Digest)) -> u32 {
    let mut digest = Digest::new();
    let wheel = Wheel { radius_m: 0.075, width_m: 0.07 };
    for soil in &SOILS {
        for slip in [-0.6, -0.2, 0.0, 0.05, 0.2, 0.4, 0.7, 0.95] {
            for depth in [0.01, 0.05, 0.15, 0.3, 0.6] {
                function(&wheel, soil, slip, depth, &mut digest);
            }
        }
    }
    digest.finish()
}

fn forces(wheel: &Wheel<f32>, soil: &Soil<f32>, slip: f32, depth: f32, digest: &mut Digest) {
    match wheel_forces(wheel, soil, slip, depth * wheel.radius_m) {
        Ok(forces) => digest.add_all([forces.drawbar_pull_n, forces.load_n, forces.torque_nm]),
        Err(_) => digest.add(f32::NAN),
    }
}

/// Loads from 2 N to 120 N for the depths of the grid.
fn sinkage(wheel: &Wheel<f32>, soil: &Soil<f32>, slip: f32, depth: f32, digest: &mut Digest) {
    digest.add(sinkage_for_load(wheel, soil, slip, 200.0 * depth).unwrap_or(f32::NAN));
}

/// Means, standard deviations and squared innovations of a run of the filter, predicted by the model and by drift in turn,
/// with a measurement missing now and then.
fn filter<const N: usize, const M: usize>() -> u32 {
    const STEPS: usize = 100;
    const MISSING: usize = 7;
    let mut digest = Digest::new();
    let scales = Scales::NOMINAL;
    let std = [scales.start_std; N];
    let Ok(mut filter) = Gaussian::independent([0.0; N], std).and_then(|start| SigmaPointFilter::new(start, std))
    else {
        return 0;
    };
    let mut trial = Trial::<N, M>::new(1, scales);
    for step in 0..STEPS {
        let noise = [scales.process_std; N];
        let _ = if step % 2 == 0 { filter.predict(trial::process, &noise) } else { filter.random_walk(&noise) };
        let mut place = step;
        let measured = trial.measure().map(|value| {
            place += 1;
            (place % MISSING != 0).then_some(value)
        });
        let told = filter.update(trial::measurement, &measured, &[scales.noise_std; M], Gate::one_in_a_thousand());
        digest.add_all(*filter.estimate().mean());
        digest.add_all(filter.estimate().stds());
        digest.add(told.normalised_square);
    }
    digest.finish()
}

/// Firm, loose and cohesive: they differ in exponent, in every modulus and in whether the soil rises behind the wheel.
pub const SOILS: [Soil<f32>; 3] = [
    soil(1.1, 15_600.0, 2_407_400.0, 250.0, 0.557, 0.0),
    soil(0.7, 9_900.0, 152_000.0, 100.0, 0.48, 0.2),
    soil(0.5, 13_190.0, 692_150.0, 4_140.0, 0.23, 0.5),
];

const fn soil(
    n: f32,
    k_c: f32,
    k_phi: f32,
    cohesion_pa: f32,
    friction_angle_rad: f32,
    rebound_ratio: f32,
) -> Soil<f32> {
    Soil {
        sinkage_exponent: n,
        cohesive_modulus: k_c,
        frictional_modulus: k_phi,
        cohesion_pa,
        friction_angle_rad,
        shear_modulus_m: 0.0114,
        peak_stress_c1: 0.18,
        peak_stress_c2: 0.32,
        rebound_ratio,
    }
}
