//! The rover network on blocks of examples.

use kapvik_firmware::network::{
    OUTPUTS, ROVER_CONTEXT, ROVER_FIRST_HEAD, ROVER_HEAD_INPUTS, ROVER_HIDDEN, ROVER_SECOND_HEAD, ROVER_THIRD_HEAD,
    ROVER_WHEELS, WHEEL_FEATURES, Weights,
};
use pulp::Simd;

use super::example::{Example, RoverInput};
use super::gated_layer::GatedLanes;
use super::lanes::{
    LANES, Lane, ZERO, activate, add_gradient, add_input_slope, add_layer_gradient, add_weighted, apply_layer,
    before_activation,
};
use super::rover_weights::{FIRST_SUMS, RoverWeights, SECOND_SUMS, THIRD_SUMS};
use super::trainable::{Trainable, in_lanes, layer_fan_in};

/// What the neurons put out.
pub struct RoverBlock {
    context: [Lane; ROVER_CONTEXT],
    wheels: [WheelLanes; ROVER_WHEELS],
    /// One over the number of wheels.
    share: Lane,
    pool: [Lane; ROVER_HEAD_INPUTS],
    first: GatedLanes<FIRST_SUMS, ROVER_FIRST_HEAD>,
    second: GatedLanes<SECOND_SUMS, ROVER_SECOND_HEAD>,
    third: GatedLanes<THIRD_SUMS, ROVER_THIRD_HEAD>,
    output: [Lane; OUTPUTS],
}

/// The wheels of a block's examples that stand in the same place.
struct WheelLanes {
    features: [Lane; WHEEL_FEATURES],
    hidden: [Lane; ROVER_HIDDEN],
    /// One where the example has such a wheel, else zero.
    there: Lane,
}

impl WheelLanes {
    fn new(examples: &[Example<RoverInput>], place: usize) -> Self {
        let (mut features, mut there) = ([ZERO; WHEEL_FEATURES], ZERO);
        for (lane, wheel) in examples.iter().map(|example| example.input.wheels.get(place)).enumerate() {
            let Some(wheel) = wheel else { continue };
            there[lane] = 1.0;
            features.iter_mut().zip(wheel).for_each(|(lanes, feature)| lanes[lane] = *feature);
        }
        Self { features, hidden: [ZERO; ROVER_HIDDEN], there }
    }
}

impl Trainable for RoverWeights {
    type Input = RoverInput;
    type Block = RoverBlock;

    fn zero() -> Self {
        Self::ZERO
    }
    fn fan_in() -> Self {
        let wheel = ROVER_CONTEXT + WHEEL_FEATURES;
        Self {
            context: layer_fan_in(wheel),
            wheel: Weights([[wheel as f32; ROVER_HIDDEN]; WHEEL_FEATURES]),
            first: layer_fan_in(ROVER_HEAD_INPUTS),
            second: layer_fan_in(ROVER_FIRST_HEAD),
            third: layer_fan_in(ROVER_SECOND_HEAD),
            output: layer_fan_in(ROVER_THIRD_HEAD),
        }
    }
    fn matrices() -> Vec<[usize; 2]> {
        vec![
            [ROVER_CONTEXT + 1, ROVER_HIDDEN],
            [WHEEL_FEATURES, ROVER_HIDDEN],
            [ROVER_HEAD_INPUTS + 1, FIRST_SUMS],
            [ROVER_FIRST_HEAD + 1, SECOND_SUMS],
            [ROVER_SECOND_HEAD + 1, THIRD_SUMS],
            [ROVER_THIRD_HEAD + 1, OUTPUTS],
        ]
    }

    #[inline(always)]
    fn run_block<S: Simd>(&self, simd: S, examples: &[Example<RoverInput>]) -> RoverBlock {
        let mut block = RoverBlock {
            context: in_lanes(examples.iter().map(|example| &example.input.context)),
            wheels: std::array::from_fn(|place| WheelLanes::new(examples, place)),
            share: ZERO,
            pool: [ZERO; ROVER_HEAD_INPUTS],
            first: GatedLanes::ZERO,
            second: GatedLanes::ZERO,
            third: GatedLanes::ZERO,
            output: [ZERO; OUTPUTS],
        };
        let mut shared = [ZERO; ROVER_HIDDEN];
        apply_layer(simd, &self.context, &block.context, &mut shared);
        for wheel in &mut block.wheels {
            wheel.hidden = shared;
            add_weighted(simd, &self.wheel, &wheel.features, &mut wheel.hidden);
            activate(&mut wheel.hidden);
        }
        pool(&mut block, examples);
        block.first.run(simd, &self.first, &block.pool);
        block.second.run(simd, &self.second, &block.first.outputs);
        block.third.run(simd, &self.third, &block.second.outputs);
        apply_layer(simd, &self.output, &block.third.outputs, &mut block.output);
        block
    }
    fn outputs(block: &RoverBlock) -> &[Lane; OUTPUTS] {
        &block.output
    }

    #[inline(always)]
    fn backward<S: Simd>(&self, simd: S, block: &RoverBlock, slope: &[Lane; OUTPUTS], gradient: &mut Self) {
        add_layer_gradient(simd, &block.third.outputs, slope, &mut gradient.output);
        let mut third = [ZERO; ROVER_THIRD_HEAD];
        add_input_slope(simd, &self.output.weights, slope, &mut third);
        let third = block.third.before(&third);
        add_layer_gradient(simd, &block.second.outputs, &third, &mut gradient.third);
        let mut second = [ZERO; ROVER_SECOND_HEAD];
        add_input_slope(simd, &self.third.weights, &third, &mut second);
        let second = block.second.before(&second);
        add_layer_gradient(simd, &block.first.outputs, &second, &mut gradient.second);
        let mut first = [ZERO; ROVER_FIRST_HEAD];
        add_input_slope(simd, &self.second.weights, &second, &mut first);
        let first = block.first.before(&first);
        add_layer_gradient(simd, &block.pool, &first, &mut gradient.first);
        // The context among the pool's numbers needs no slope.
        let mut pool = [ZERO; 2 * ROVER_HIDDEN];
        add_input_slope(simd, &self.first.weights, &first, &mut pool);
        let mut context = [ZERO; ROVER_HIDDEN];
        for wheel in &block.wheels {
            let hidden = wheel_slope(block, wheel, &pool);
            add_gradient(simd, &wheel.features, &hidden, &mut gradient.wheel);
            context.as_flattened_mut().iter_mut().zip(hidden.as_flattened()).for_each(|(sum, s)| *sum += s);
        }
        add_layer_gradient(simd, &block.context, &context, &mut gradient.context);
    }
}

/// Mean and variance of each neuron over the wheels, then the shared inputs and the number of wheels.
#[inline(always)]
fn pool(block: &mut RoverBlock, examples: &[Example<RoverInput>]) {
    let RoverBlock { context, wheels, share, pool, .. } = block;
    let mut count = [1.0_f32; LANES];
    for (count, example) in count.iter_mut().zip(examples) {
        *count = example.input.wheels.len() as f32;
    }
    *share = count.map(|count| 1.0 / count);
    for neuron in 0..ROVER_HIDDEN {
        let (mut mean, mut variance) = (ZERO, ZERO);
        for wheel in wheels.iter() {
            for ((mean, there), hidden) in mean.iter_mut().zip(&wheel.there).zip(&wheel.hidden[neuron]) {
                *mean += there * hidden;
            }
        }
        mean.iter_mut().zip(share.iter()).for_each(|(mean, share)| *mean *= share);
        for wheel in wheels.iter() {
            let lanes = wheel.hidden[neuron].iter().zip(&mean).zip(share.iter()).zip(&wheel.there);
            for (variance, (((hidden, mean), share), there)) in variance.iter_mut().zip(lanes) {
                *variance += there * (share * (hidden - mean) * (hidden - mean));
            }
        }
        pool[neuron] = mean;
        pool[ROVER_HIDDEN + neuron] = variance;
    }
    pool[2 * ROVER_HIDDEN..][..ROVER_CONTEXT].copy_from_slice(context);
    pool[ROVER_HEAD_INPUTS - 1] = count.map(|count| count * (1.0 / ROVER_WHEELS as f32));
}

/// The slope before the activation of a wheel's neurons, from that against their means and variances.
#[inline(always)]
fn wheel_slope(block: &RoverBlock, wheel: &WheelLanes, pool: &[Lane; 2 * ROVER_HIDDEN]) -> [Lane; ROVER_HIDDEN] {
    let mut slope = [ZERO; ROVER_HIDDEN];
    for (neuron, slope) in slope.iter_mut().enumerate() {
        let of_pool = pool[neuron].iter().zip(&pool[ROVER_HIDDEN + neuron]);
        let outputs = wheel.hidden[neuron].iter().zip(&block.pool[neuron]);
        let shares = block.share.iter().zip(&wheel.there);
        for (((slope, (of_mean, of_variance)), (hidden, mean)), (share, there)) in
            slope.iter_mut().zip(of_pool).zip(outputs).zip(shares)
        {
            // The variance's slope by way of the mean vanishes, since deviations add up to zero.
            *slope = share * there * (of_mean + 2.0 * of_variance * (hidden - mean));
        }
    }
    before_activation(&mut slope, &wheel.hidden);
    slope
}
