//! How much larger errors are than the filters know.
//!
//! A filter states the errors of its own model: that the ground moves its state at random, at a rate that it has chosen by its
//! innovations. Ground does not. Where it begins to bend, errors come in runs and are several times as large; on ground that stays plane
//! half of what is stated is not there. How much, a small network tells, from what a side knows of how well it does now and did before:
//! it is trained by likelihood on simulated drives, in which errors are known, and changes standard deviations only, never what is
//! estimated.

mod frozen;
mod inputs;
mod memory;
mod traits;

use crate::math::of_octaves;
use crate::network::checksum;
use crate::network::fixed_point::{FixedLayer, Quad, SUM_BITS, rounded};
use crate::rover::{PerAxle, Rover};
use crate::scalar::Scalar;

pub use inputs::INPUTS;
pub use memory::{DoubtMemory, SHARE_BITS, SLOW};
pub use traits::{TRAITS, traits};

/// Neurons of the hidden layer, of which the last [`SLOW`] remember.
pub const HIDDEN: usize = 32;
/// Quantities of a wheel: resistive torque, slip, contact angle, normal load and drawbar pull.
pub const QUANTITIES: usize = 5;
/// Outputs: of the quantities of front, middle and rear wheel; then of the sum of the bogie's drawbar pulls.
pub const OUTPUTS: usize = 3 * QUANTITIES + 1;
/// The most by which an output may be off zero: no standard deviation is more than five times what is stated, nor less than a fifth.
pub const GREATEST_OUTPUT: f32 = 2.25;

/// One hidden layer of bipolar sigmoids. Outputs are standard deviations over those stated, in [octaves](of_octaves).
#[derive(Debug, Clone, PartialEq)]
pub struct DoubtNetwork {
    /// Hidden layer.
    pub first: FixedLayer<{ INPUTS / 4 }, { HIDDEN / 4 }>,
    /// Linear output.
    pub output: FixedLayer<{ HIDDEN / 4 }, { OUTPUTS / 4 }>,
}

crate::words!(DoubtNetwork: first, output);

/// The network that flies.
pub fn frozen() -> &'static DoubtNetwork {
    &frozen::NETWORK
}

/// Whether a network is, by its checksum, the one that was trained.
pub fn is_as_trained(network: &DoubtNetwork) -> bool {
    checksum(network) == frozen::CHECKSUM
}

impl DoubtNetwork {
    /// All weights zero: the filters are believed.
    pub const ZERO: Self = Self { first: FixedLayer::ZERO, output: FixedLayer::ZERO };

    /// The outputs for inputs, which are taken to 1/4096 and saturate at ±8, after what is remembered, which takes them in.
    pub fn run(&self, memory: &mut DoubtMemory, inputs: &[f32; INPUTS]) -> [f32; OUTPUTS] {
        let mut hidden: [Quad; HIDDEN / 4] = self.first.run(&rounded(inputs, SUM_BITS));
        memory.follow(&mut hidden);
        self.output.outputs(&hidden)
    }

    /// Whether no inputs whatever can bring a sum past 32 bits, on which flight relies.
    pub fn cannot_overflow(&self) -> bool {
        self.first.cannot_overflow() && self.output.cannot_overflow()
    }
}

/// How far a side's filters are believed.
#[derive(Debug, Clone)]
pub(super) struct Doubt {
    /// Of the rover.
    traits: [f32; TRAITS],
    memory: DoubtMemory,
    times: [f32; OUTPUTS],
    /// Whether this side has the turn, and whether it got it in this frame.
    has_turn: bool,
    its_turn: bool,
    /// Since the turn went from one side to the other, s.
    since_s: f32,
}

/// No drive that the network learned from is faster, m/s: beyond, nothing that it has seen tells that errors are less than what is stated.
const FASTEST_M_S: f32 = 0.06;
/// Turns are not shorter than this, s: a quarter less than the frames of the drives that the network learned from.
const TURN_S: f32 = 0.075;

impl Doubt {
    /// Of a rover's filters that have seen nothing, which are believed. The sides take turns, by `phase`: it is odd on one of them.
    pub fn new<S: Scalar>(rover: &Rover<S>, phase: usize) -> Self {
        let has_turn = phase.is_multiple_of(2);
        Self {
            traits: traits(rover),
            memory: DoubtMemory::EMPTY,
            times: [1.0; OUTPUTS],
            has_turn,
            its_turn: false,
            since_s: 0.0,
        }
    }

    /// To be called once a frame, before anything else, with the time since the one before, s.
    pub fn take_turns(&mut self, step_s: f32) {
        self.since_s += step_s;
        self.its_turn = false;
        if self.since_s >= TURN_S {
            self.since_s = 0.0;
            self.has_turn = !self.has_turn;
            self.its_turn = self.has_turn;
        }
    }

    /// Those of the rover, which are among the inputs.
    pub fn traits(&self) -> &[f32; TRAITS] {
        &self.traits
    }

    /// Whether the network is run in this frame: in every other one, of ten a second.
    pub fn its_turn(&self) -> bool {
        self.its_turn
    }

    /// Takes the inputs of a frame in which the side moves at this speed, m/s, and whether any of its encoders speaks: where none does, the
    /// network would state pulls on hills too surely, and may only widen, too.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn take(&mut self, inputs: &[f32; INPUTS], speed_m_s: f32, rims_are_heard: bool) {
        let least = if speed_m_s > FASTEST_M_S || !rims_are_heard { 1.0 } else { 0.0 };
        self.times = frozen::NETWORK.run(&mut self.memory, inputs).map(|output| times_stated(output).max(least));
    }

    /// By what standard deviations are multiplied, in the order of the network's outputs.
    pub fn times<S: Scalar>(&self) -> [S; OUTPUTS] {
        self.times.map(S::from_f32)
    }
}

/// By what an output has a standard deviation multiplied.
#[cfg_attr(target_arch = "arm", inline(never))] // as above
pub fn times_stated(output: f32) -> f32 {
    of_octaves(output.clamp(-GREATEST_OUTPUT, GREATEST_OUTPUT))
}

/// Those of the wheels, front to rear, of all outputs.
pub(super) fn of_wheels<S: Scalar>(outputs: &[S; OUTPUTS]) -> PerAxle<[S; QUANTITIES]> {
    let [wheels @ .., _] = outputs;
    let (wheels, _) = wheels.as_chunks::<QUANTITIES>();
    match wheels {
        [front, middle, rear] => PerAxle { front: *front, middle: *middle, rear: *rear },
        _ => PerAxle::all([S::one(); QUANTITIES]),
    }
}

#[cfg(test)]
mod tests {
    use super::{Doubt, DoubtMemory, DoubtNetwork, GREATEST_OUTPUT, INPUTS, OUTPUTS, frozen, of_wheels, times_stated};
    use crate::rover::{PerAxle, Rover};

    /// Flight relies on it: no input whatever may bring a sum past 32 bits.
    #[test]
    fn the_frozen_network_cannot_overflow() {
        assert_ne!(frozen::NETWORK, DoubtNetwork::ZERO, "not trained: kapvik train-doubt");
        assert!(frozen::NETWORK.cannot_overflow());
    }

    #[test]
    fn whatever_a_side_seems_to_know_doubt_is_bounded() {
        let mut memory = DoubtMemory::EMPTY;
        assert_eq!(DoubtNetwork::ZERO.run(&mut memory, &[3.0; INPUTS]).map(times_stated), [1.0; OUTPUTS]);
        for input in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, 8.0, -8.0] {
            let doubt = frozen::NETWORK.run(&mut memory, &[input; INPUTS]).map(times_stated);
            assert!(doubt.iter().all(|times| (0.2..=5.0).contains(times)), "{input}: {doubt:?}");
        }
        assert_eq!(times_stated(10.0), times_stated(GREATEST_OUTPUT));
    }

    #[test]
    fn sides_take_turns_and_doubt_holds_until_the_next() {
        let mut sides = [0, 3].map(|phase| Doubt::new(&Rover::<f64>::assumed(), phase));
        let mut turns = |step_s: f32| {
            sides.iter_mut().for_each(|side| side.take_turns(step_s));
            sides.each_ref().map(Doubt::its_turn)
        };
        assert_eq!([0.1; 4].map(&mut turns), [[false, true], [true, false], [false, true], [true, false]]);
        let neither = [false, false];
        assert_eq!([0.05; 4].map(turns), [neither, [false, true], neither, [true, false]], "faster frames");
        let [side, _] = &mut sides;
        assert_eq!(side.times::<f64>(), [1.0; OUTPUTS]);
        side.take(&[1.0; INPUTS], 0.02, true);
        let taken = side.times::<f32>();
        assert_ne!(taken, [1.0; OUTPUTS]);
        side.take_turns(0.1);
        assert_eq!(side.times::<f32>(), taken);
    }

    #[test]
    fn outputs_go_from_wheel_to_wheel() {
        let outputs: [f64; OUTPUTS] = core::array::from_fn(|place| place as f64);
        let PerAxle { front: [torque, ..], middle: [.., pull], rear: [_, slip, ..] } = of_wheels(&outputs);
        assert_eq!([torque, pull, slip], [0.0, 9.0, 11.0]);
    }
}
