//! Counts what a function costs, under QEMU's `-icount shift=0`: instructions and stack.
//!
//! Results go out over semihosting, a line each:
//!
//! ```text
//! calibration INSTRUCTIONS TICKS
//! kernel NAME INSTRUCTIONS STACK_BYTES
//! fingerprint NAME CHECKSUM
//! ```

use core::arch::asm;
use core::fmt::Display;
use core::hint::black_box;

use semihosting::println;

use crate::ticks::{self, INSTRUCTIONS_PER_TICK};
use crate::{stack, uart};

/// How many inputs a kernel is tried with; what it costs depends on them.
const INPUTS: u16 = 64;
/// How often each, so that a tick of 40 instructions is small against the sum.
const ROUNDS: u16 = 16;
/// A call of this many ticks is large against a tick by itself: once is enough.
const LONG_CALL_TICKS: u32 = 1000;
/// A call of this many ticks is tried with fewer inputs.
const VERY_LONG_CALL_TICKS: u32 = 25_000;
/// So many.
const FEW_INPUTS: u16 = 8;

/// Counts instructions, and knows what its own loop costs.
pub struct Bench {
    /// Instructions of the loop around a call.
    loop_instructions: u64,
    /// Stack of the call that measures the stack.
    probe_stack: u32,
}

impl Bench {
    /// Starts the counter and shows it a loop whose length is known.
    pub fn start() -> Self {
        const TURNS: u32 = 1_000_000;
        uart::start_log();
        ticks::count_clock();
        let start = ticks::now();
        // SAFETY: counts a register down to zero; two instructions a turn.
        unsafe { asm!("2: subs {0}, {0}, #1", "bne 2b", inout(reg) TURNS => _) };
        println!("calibration {} {}", 2 * TURNS, ticks::now().wrapping_sub(start));
        Self { loop_instructions: instructions(0.0, 1.0, |x| x), probe_stack: stack_bytes(0.0, 1.0, |x| x) }
    }

    /// What one call of `function` costs, the mean over inputs between `low` and `high`.
    pub fn kernel<R>(&self, name: impl Display, low: f32, high: f32, mut function: impl FnMut(f32) -> R) {
        let cost = instructions(low, high, &mut function).saturating_sub(self.loop_instructions);
        println!("kernel {name} {cost} {}", stack_bytes(low, high, &mut function).saturating_sub(self.probe_stack));
    }

    /// A line with the fingerprint of some arithmetic.
    pub fn fingerprint(&self, name: &str, checksum: u32) {
        println!("fingerprint {name} {checksum:08x}");
    }
}

/// Stack of a call, at both ends of the inputs.
#[inline(never)]
fn stack_bytes<R>(low: f32, high: f32, mut function: impl FnMut(f32) -> R) -> u32 {
    let before = stack::repaint();
    black_box(function(black_box(low)));
    black_box(function(black_box(high)));
    stack::high_water_bytes().saturating_sub(before)
}

/// Instructions of a call and the loop around it.
#[inline(never)]
fn instructions<R>(low: f32, high: f32, mut function: impl FnMut(f32) -> R) -> u64 {
    let mut turn = |inputs: u16, rounds: u16| {
        let step = (high - low) / f32::from(inputs - 1);
        let start = ticks::now();
        for _ in 0..rounds {
            for index in 0..inputs {
                black_box(function(black_box(low + step * f32::from(index))));
            }
        }
        ticks::now().wrapping_sub(start)
    };
    let per_call = |ticks: u32, inputs: u16, rounds: u16| {
        u64::from(ticks) * INSTRUCTIONS_PER_TICK / (u64::from(inputs) * u64::from(rounds))
    };
    let few = turn(FEW_INPUTS, 1);
    if few / u32::from(FEW_INPUTS) >= VERY_LONG_CALL_TICKS {
        return per_call(few, FEW_INPUTS, 1);
    }
    let once = turn(INPUTS, 1);
    let long = once / u32::from(INPUTS) >= LONG_CALL_TICKS;
    let (ticks, rounds) = if long { (once, 1) } else { (turn(INPUTS, ROUNDS), ROUNDS) };
    per_call(ticks, INPUTS, rounds)
}
