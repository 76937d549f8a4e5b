//! Sides of drives through the network, frame by frame, and the loss's way back to its weights, from the last frame to the first.

use kapvik_firmware::estimator::doubt::{HIDDEN, INPUTS, OUTPUTS, SHARE_BITS, SLOW};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::loss::loss;
use super::rows::{Row, SideRows};
use super::weights::DoubtWeights;
use crate::train::lanes::{
    LANES, Lane, ZERO, add_input_slope, add_layer_gradient, apply_layer, before_activation, run_layer,
};
use crate::train::trainable::{change_each, flatten, in_lanes};

/// Inputs of a side whose drive has ended.
const ENDED: [f32; INPUTS] = [0.0; INPUTS];

/// The sum of the losses of some rows, and its slope against each weight.
#[derive(Debug, Clone)]
pub struct Slope {
    /// The sum.
    pub loss: f32,
    /// How many rows it is of.
    pub rows: u32,
    /// Its slope.
    pub gradient: DoubtWeights,
}

impl Slope {
    /// Of no rows.
    pub const NONE: Self = Self { loss: 0.0, rows: 0, gradient: DoubtWeights::ZERO };
}

/// The sum of the losses of the sides at these places, and its slope. Blocks are summed by themselves, so that the result does not
/// depend on the number of cores.
pub fn slope_of(weights: &DoubtWeights, sides: &[SideRows], places: &[u32]) -> Slope {
    let blocks: Vec<Slope> = places
        .par_chunks(LANES)
        .map(|places| {
            let block = places.iter().filter_map(|place| sides.get(*place as usize)).map(Vec::as_slice).collect();
            Arch::new().dispatch(Pass { weights, block })
        })
        .collect();
    let mut sum = Slope::NONE;
    for block in &blocks {
        change_each(&mut sum.gradient, flatten(&block.gradient), |sum, slope| *sum += slope);
        sum.loss += block.loss;
        sum.rows += block.rows;
    }
    sum
}

/// A block of sides, one a lane, to be run with registers as wide as the machine has.
struct Pass<'a> {
    weights: &'a DoubtWeights,
    block: Vec<&'a [Row]>,
}

impl WithSimd for Pass<'_> {
    type Output = Slope;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Slope {
        let Self { weights, block } = self;
        let mut sum = Slope::NONE;
        let frames = run(simd, weights, &block);
        let mut later = [ZERO; SLOW];
        for (place, frame) in frames.iter().enumerate().rev() {
            let slopes = frame.loss(simd, weights, block.iter().map(|rows| rows.get(place)), &mut sum);
            frame.backward(simd, weights, &slopes, &mut later, &mut sum.gradient);
        }
        sum
    }
}

/// The frames of a block of sides, one side a lane, in the order of time.
#[inline(always)]
fn run<S: Simd>(simd: S, weights: &DoubtWeights, block: &[&[Row]]) -> Vec<Frame> {
    let length = block.iter().map(|rows| rows.len()).max().unwrap_or(0);
    let mut memory = [ZERO; SLOW];
    let at = |place: usize| block.iter().map(move |rows| rows.get(place).map_or(&ENDED, |row| &row.inputs));
    (0..length).map(|place| Frame::run(simd, weights, in_lanes(at(place)), &mut memory)).collect()
}

/// What the neurons put out for a frame of a block of sides.
struct Frame {
    input: [Lane; INPUTS],
    /// Of all hidden neurons, before any remembers.
    activations: [Lane; HIDDEN],
    /// What the output layer is given: of the last neurons, running means.
    hidden: [Lane; HIDDEN],
}

/// Of what is new, the part that a neuron takes that remembers, in their order.
fn share(neuron: usize) -> f32 {
    SHARE_BITS.get(neuron / 4).map_or(0.0, |bits| libm::exp2f(-(*bits as f32)))
}

impl Frame {
    #[inline(always)]
    fn run<S: Simd>(simd: S, weights: &DoubtWeights, input: [Lane; INPUTS], memory: &mut [Lane; SLOW]) -> Self {
        let mut activations = [ZERO; HIDDEN];
        run_layer(simd, &weights.first, &input, &mut activations);
        let mut hidden = activations;
        for (neuron, (mean, new)) in memory.iter_mut().zip(hidden.iter_mut().skip(HIDDEN - SLOW)).enumerate() {
            for (mean, new) in mean.iter_mut().zip(new.iter()) {
                *mean += share(neuron) * (new - *mean);
            }
            *new = *mean;
        }
        Self { input, activations, hidden }
    }

    #[inline(always)]
    fn outputs<S: Simd>(&self, simd: S, weights: &DoubtWeights) -> [Lane; OUTPUTS] {
        let mut outputs = [ZERO; OUTPUTS];
        apply_layer(simd, &weights.output, &self.hidden, &mut outputs);
        outputs
    }

    /// Adds the losses of what is known of this frame; their slopes against the outputs.
    #[inline(always)]
    fn loss<'a, S: Simd>(
        &self,
        simd: S,
        weights: &DoubtWeights,
        rows: impl Iterator<Item = Option<&'a Row>>,
        sum: &mut Slope,
    ) -> [Lane; OUTPUTS] {
        let outputs = self.outputs(simd, weights);
        let mut slopes = [ZERO; OUTPUTS];
        for (lane, row) in rows.enumerate() {
            if let Some(known) = row.and_then(|row| row.known.as_ref()) {
                let loss = loss(&outputs.map(|output| output[lane]), known);
                slopes.iter_mut().zip(loss.slope).for_each(|(lanes, slope)| lanes[lane] = slope);
                sum.loss += loss.value;
                sum.rows += 1;
            }
        }
        slopes
    }

    /// `later` is the slope of the losses of later frames against what is remembered after this one; it becomes that against what was
    /// remembered before it.
    #[inline(always)]
    fn backward<S: Simd>(
        &self,
        simd: S,
        weights: &DoubtWeights,
        slope: &[Lane; OUTPUTS],
        later: &mut [Lane; SLOW],
        gradient: &mut DoubtWeights,
    ) {
        add_layer_gradient(simd, &self.hidden, slope, &mut gradient.output);
        let mut hidden = [ZERO; HIDDEN];
        add_input_slope(simd, &weights.output.weights, slope, &mut hidden);
        for (neuron, (later, slope)) in later.iter_mut().zip(hidden.iter_mut().skip(HIDDEN - SLOW)).enumerate() {
            for (later, slope) in later.iter_mut().zip(slope.iter_mut()) {
                let against_mean = *later + *slope;
                *slope = share(neuron) * against_mean;
                *later = against_mean - *slope;
            }
        }
        before_activation(&mut hidden, &self.activations);
        add_layer_gradient(simd, &self.input, &hidden, &mut gradient.first);
    }
}

/// The outputs for the frames of one side.
#[cfg(test)]
pub fn outputs_of(weights: &DoubtWeights, rows: &[Row]) -> Vec<[f32; OUTPUTS]> {
    let simd = pulp::Scalar::new();
    let frames = run(simd, weights, &[rows]);
    frames.iter().map(|frame| frame.outputs(simd, weights).map(|output| output[0])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::doubt::rows::Known;
    use crate::doubt::rows::tests::correlated;
    use crate::train::rounding::tests::wave;

    /// More than fill a block, of different lengths; of some frames nothing is known.
    fn sides() -> Vec<SideRows> {
        let row = |seed: usize| {
            let errors = std::array::from_fn(|k| wave(70 * seed + k));
            let known = (!seed.is_multiple_of(3)).then(|| Known { errors, wheels: correlated() });
            Row { inputs: std::array::from_fn(|k| wave(100 * seed + k)), known }
        };
        (0..LANES + 5).map(|side| (0..3 + side % 4).map(|frame| row(11 * side + frame)).collect()).collect()
    }

    #[test]
    fn gradients_are_those_of_differences() {
        const STEP: f32 = 1e-2;
        let sides = sides();
        let places: Vec<u32> = (0..sides.len() as u32).collect();
        let mut weights = DoubtWeights::initial(3);
        weights.output.weights.0.as_flattened_mut().iter_mut().enumerate().for_each(|(k, w)| *w = 0.2 * wave(k));
        let slope = slope_of(&weights, &sides, &places);
        let known = sides.iter().flatten().filter(|row| row.known.is_some()).count();
        assert_eq!(slope.rows as usize, known);
        let gradient = flatten(&slope.gradient);
        let block = sides.iter().take(LANES).map(Vec::as_slice).collect();
        let narrow = Pass { weights: &weights, block }.with_simd(pulp::Scalar::new());
        let wide = slope_of(&weights, &sides, &places[..LANES]);
        assert_eq!(flatten(&wide.gradient), flatten(&narrow.gradient), "other registers, other bits");
        let flat = flatten(&weights);
        for place in (0..flat.len()).step_by(23) {
            let mut at = |step: f32| {
                let moved = flat.iter().enumerate().map(|(k, w)| if k == place { w + step } else { *w });
                change_each(&mut weights, moved, |weight, value| *weight = value);
                slope_of(&weights, &sides, &places).loss
            };
            let expected = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            let slope = gradient[place];
            assert!((slope - expected).abs() < 0.2 + 0.01 * expected.abs(), "{place}: {slope}, {expected}");
        }
    }
}
