//! A layer's sums for a block of examples at once, one example a lane.
//!
//! Every sum runs in a fixed order and every product is rounded before it is added, so that the bits are the same however
//! many lanes a register of the machine has.

use kapvik_firmware::math::bipolar_sigmoid;
use pulp::Simd;

use super::layer::{Layer, Weights};
use super::trainable::GRADIENT;

/// Examples in a block.
pub const LANES: usize = 16;

/// One number of each example of a block.
pub type Lane = [f32; LANES];

/// Zero in every example.
pub const ZERO: Lane = [0.0; LANES];

/// Sums that are worked on at once: as many as stay in registers.
const TILE: usize = 8;

/// Adds the weighted inputs to `sums`.
#[inline(always)]
fn add_weighted<S: Simd, const I: usize, const O: usize>(
    simd: S,
    weights: &Weights<I, O>,
    input: &[Lane; I],
    sums: &mut [Lane; O],
) {
    add_in_tiles(simd, sums, input, |i, o| weights.0[i][o]);
}

/// Adds to `back`, the slope against the first inputs of a layer, what the slope behind the weights makes of it.
#[inline(always)]
pub fn add_input_slope<S: Simd, const I: usize, const O: usize>(
    simd: S,
    weights: &Weights<I, O>,
    slope: &[Lane; O],
    back: &mut [Lane],
) {
    add_in_tiles(simd, back, slope, |o, i| weights.0[i][o]);
}

/// Adds to each sum s the products of the inputs k with `weight(k, s)`.
#[inline(always)]
fn add_in_tiles<S: Simd>(simd: S, sums: &mut [Lane], input: &[Lane], weight: impl Fn(usize, usize) -> f32) {
    let (tiles, rest) = sums.as_chunks_mut::<TILE>();
    let done = TILE * tiles.len();
    for (place, tile) in tiles.iter_mut().enumerate() {
        add_products(simd, tile, input, |k, t| weight(k, place * TILE + t));
    }
    for (place, sum) in rest.iter_mut().enumerate() {
        add_products(simd, std::array::from_mut(sum), input, |k, _| weight(k, done + place));
    }
}

/// Adds to each sum t of a tile the products of the inputs k with `weight(k, t)`.
#[inline(always)]
fn add_products<S: Simd, const T: usize>(
    simd: S,
    tile: &mut [Lane; T],
    input: &[Lane],
    weight: impl Fn(usize, usize) -> f32,
) {
    let registers = LANES / S::F32_LANES;
    let input = S::as_simd_f32s(input.as_flattened()).0;
    let tile = S::as_mut_simd_f32s(tile.as_flattened_mut()).0;
    for register in 0..registers {
        let mut sums: [S::f32s; T] = std::array::from_fn(|t| tile[t * registers + register]);
        for (k, input) in input.iter().skip(register).step_by(registers).enumerate() {
            for (t, sum) in sums.iter_mut().enumerate() {
                // Not fused: machines that cannot would give other bits.
                *sum = simd.add_f32s(*sum, simd.mul_f32s(simd.splat_f32s(weight(k, t)), *input));
            }
        }
        for (t, sum) in sums.into_iter().enumerate() {
            tile[t * registers + register] = sum;
        }
    }
}

/// Adds to a layer's gradient that of a block.
#[inline(always)]
pub fn add_layer_gradient<S: Simd, const I: usize, const O: usize>(
    simd: S,
    input: &[Lane; I],
    slope: &[Lane; O],
    gradient: &mut Layer<I, O>,
) {
    add_gradient(simd, input, slope, &mut gradient.weights);
    gradient.bias.iter_mut().zip(slope).for_each(|(sum, slope)| *sum += slope.iter().sum::<f32>());
}

/// Adds to the gradient of weights that of a block.
#[inline(always)]
fn add_gradient<S: Simd, const I: usize, const O: usize>(
    simd: S,
    input: &[Lane; I],
    slope: &[Lane; O],
    gradient: &mut Weights<I, O>,
) {
    for (place, slope) in slope.chunks(LANES).enumerate() {
        // Examples in rows, so that the sums over them run in parallel.
        let mut turned = [ZERO; LANES];
        for (o, slope) in slope.iter().enumerate() {
            turned.iter_mut().zip(slope).for_each(|(row, s)| row[o] = *s);
        }
        let (tiles, rest) = input.as_chunks::<TILE>();
        let (tile_rows, rest_rows) = gradient.0.as_chunks_mut::<TILE>();
        for (tile, rows) in tiles.iter().zip(tile_rows) {
            add_tile_gradient(simd, tile, &turned, rows, place * LANES);
        }
        for (input, row) in rest.iter().zip(rest_rows) {
            add_tile_gradient(simd, std::array::from_ref(input), &turned, std::array::from_mut(row), place * LANES);
        }
    }
}

/// The same for a few inputs and, from column `first` on, as many sums as there are lanes.
#[inline(always)]
fn add_tile_gradient<S: Simd, const T: usize, const O: usize>(
    simd: S,
    input: &[Lane; T],
    turned: &[Lane; LANES],
    rows: &mut [[f32; O]; T],
    first: usize,
) {
    let mut sums = [ZERO; T];
    add_products(simd, &mut sums, turned, |example, t| input[t][example]);
    for (row, sums) in rows.iter_mut().zip(&sums) {
        row[first..].iter_mut().zip(sums).for_each(|(g, sum)| *g += sum);
    }
}

/// What the neurons of a layer put out.
#[inline(always)]
pub fn run_layer<S: Simd, const I: usize, const O: usize>(
    simd: S,
    layer: &Layer<I, O>,
    input: &[Lane; I],
    outputs: &mut [Lane; O],
) {
    apply_layer(simd, layer, input, outputs);
    activate(outputs);
}

/// The weighted sums of a layer.
#[inline(always)]
pub fn apply_layer<S: Simd, const I: usize, const O: usize>(
    simd: S,
    layer: &Layer<I, O>,
    input: &[Lane; I],
    sums: &mut [Lane; O],
) {
    sums.iter_mut().zip(&layer.bias).for_each(|(sum, bias)| *sum = [*bias; LANES]);
    add_weighted(simd, &layer.weights, input, sums);
}

/// The bipolar sigmoid of every sum.
#[inline(always)]
pub fn activate(sums: &mut [Lane]) {
    sums.as_flattened_mut().iter_mut().for_each(|sum| *sum = bipolar_sigmoid(*sum, GRADIENT));
}

/// The slope before the activation, from the slope behind it.
#[inline(always)]
pub fn before_activation(slope: &mut [Lane], outputs: &[Lane]) {
    for (s, y) in slope.as_flattened_mut().iter_mut().zip(outputs.as_flattened()) {
        *s *= 0.5 * GRADIENT * (1.0 - y * y);
    }
}
