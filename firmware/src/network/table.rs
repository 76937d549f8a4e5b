//! The frozen tables: a network with all that is needed to use it.

use super::shape::{OUTPUTS, ROVER_CONTEXT, WHEEL_FEATURES, WHEEL_INPUTS};
use super::{
    FLOWN_PAIRS, GOLDEN_PAIRS, Normalisation, PosteriorScale, RoverGolden, RoverNetwork, WheelGolden, WheelNetwork,
    Words, rover_inputs, words,
};
use crate::checksum::Checksum;

/// The per-wheel network, frozen.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelTable<const PAIRS: usize = GOLDEN_PAIRS> {
    /// Of the inputs.
    pub normalisation: Normalisation<WHEEL_INPUTS>,
    /// Weights.
    pub network: WheelNetwork,
    /// What the outputs mean.
    pub posterior: PosteriorScale,
    /// Pairs that the network must reproduce.
    pub golden: [WheelGolden; PAIRS],
}
words!(WheelTable<PAIRS> where PAIRS: normalisation, network, posterior, golden);

/// The rover network, frozen.
#[derive(Debug, Clone, PartialEq)]
pub struct RoverTable<const PAIRS: usize = GOLDEN_PAIRS> {
    /// Of the inputs that the wheels share.
    pub context: Normalisation<ROVER_CONTEXT>,
    /// Of each wheel's own inputs.
    pub wheel: Normalisation<WHEEL_FEATURES>,
    /// Weights.
    pub network: RoverNetwork,
    /// What the outputs mean.
    pub posterior: PosteriorScale,
    /// Pairs that the network must reproduce.
    pub golden: [RoverGolden; PAIRS],
}
words!(RoverTable<PAIRS> where PAIRS: context, wheel, network, posterior, golden);

impl WheelTable {
    /// The table as it flies: with the first of its golden pairs.
    pub fn flown(&self) -> WheelTable<FLOWN_PAIRS> {
        let Self { normalisation, network, posterior, golden } = self.clone();
        WheelTable { normalisation, network, posterior, golden: first_of(&golden, WheelGolden::ZERO) }
    }
}

impl<const PAIRS: usize> WheelTable<PAIRS> {
    /// All zero, to be filled.
    pub const ZERO: Self = Self {
        normalisation: Normalisation::ZERO,
        network: WheelNetwork::ZERO,
        posterior: PosteriorScale::ZERO,
        golden: [const { WheelGolden::ZERO }; PAIRS],
    };

    /// The network's outputs for inputs in their own units.
    // One copy in the image: the self-test and the pipeline both call it.
    #[inline(never)]
    pub fn outputs(&self, input: &[f32; WHEEL_INPUTS]) -> [f32; OUTPUTS] {
        self.network.run(&self.normalisation.apply(input))
    }

    /// Golden pairs that the network reproduces bit for bit.
    pub fn golden_reproduced(&self) -> usize {
        self.golden.iter().filter(|pair| same_bits(&self.outputs(&pair.input), &pair.output)).count()
    }
}

impl RoverTable {
    /// The table as it flies: with the first of its golden pairs.
    pub fn flown(&self) -> RoverTable<FLOWN_PAIRS> {
        let Self { context, wheel, network, posterior, golden } = self.clone();
        RoverTable { context, wheel, network, posterior, golden: first_of(&golden, RoverGolden::ZERO) }
    }
}

impl<const PAIRS: usize> RoverTable<PAIRS> {
    /// All zero, to be filled.
    pub const ZERO: Self = Self {
        context: Normalisation::ZERO,
        wheel: Normalisation::ZERO,
        network: RoverNetwork::ZERO,
        posterior: PosteriorScale::ZERO,
        golden: [const { RoverGolden::ZERO }; PAIRS],
    };

    /// The network's outputs for inputs in their own units.
    // One copy in the image: the self-test and the pipeline both call it.
    #[inline(never)]
    pub fn outputs(
        &self,
        context: &[f32; ROVER_CONTEXT],
        wheels: impl IntoIterator<Item = [f32; WHEEL_FEATURES]>,
    ) -> [f32; OUTPUTS] {
        let wheels = wheels.into_iter().map(|features| self.wheel.apply(&features));
        self.network.run(&rover_inputs(&self.context.apply(context), wheels))
    }

    /// Golden pairs that the network reproduces bit for bit.
    pub fn golden_reproduced(&self) -> usize {
        let outputs = |pair: &RoverGolden| {
            let wheels = pair.wheels.get(..pair.count as usize).unwrap_or(&pair.wheels);
            self.outputs(&pair.context, wheels.iter().copied())
        };
        // Seen as what they are, the compiler makes a network of its own for each pair.
        let golden = core::hint::black_box(self.golden.as_slice());
        golden.iter().filter(|pair| same_bits(&outputs(pair), &pair.output)).count()
    }
}

/// The first of a list; `empty` where it is shorter.
fn first_of<T: Clone>(all: &[T], empty: T) -> [T; FLOWN_PAIRS] {
    core::array::from_fn(|place| all.get(place).unwrap_or(&empty).clone())
}

fn same_bits(left: &[f32; OUTPUTS], right: &[f32; OUTPUTS]) -> bool {
    left.iter().zip(right).all(|(l, r)| l.to_bits() == r.to_bits())
}

/// CRC-32 (ISO-HDLC) over the words of all numbers of a table, least significant byte first.
pub fn checksum(table: &impl Words) -> u32 {
    let mut checksum = Checksum::new();
    table.for_each(&mut checksum.words());
    checksum.finish()
}
