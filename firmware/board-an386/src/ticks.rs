//! The board's free-running counter: microseconds since boot for the log, or clock ticks, which count instructions
//! under QEMU's `-icount shift=0`.

use core::ptr::{read_volatile, write_volatile};

/// Instructions to a clock tick under `-icount shift=0`: an instruction takes 1 ns, a tick of the 25 MHz clock 40 ns.
pub const INSTRUCTIONS_PER_TICK: u64 = 40;

const FPGA_IO: usize = 0x4002_8000;
const COUNTER: *mut u32 = (FPGA_IO + 0x18) as *mut u32;
const PRESCALE: *mut u32 = (FPGA_IO + 0x1c) as *mut u32;
const CLOCK_MHZ: u32 = 25;

/// Lets the counter count microseconds, from zero.
pub(crate) fn count_microseconds() {
    start(CLOCK_MHZ - 1);
}

/// Lets the counter count clock ticks, from zero.
pub(crate) fn count_clock() {
    start(0);
}

fn start(prescale: u32) {
    // SAFETY: the two registers of the board's counter, which nothing else writes.
    unsafe {
        write_volatile(PRESCALE, prescale);
        write_volatile(COUNTER, 0);
    }
}

/// The counter, modulo 2³².
pub(crate) fn now() -> u32 {
    // SAFETY: reading the counter has no side effect.
    unsafe { read_volatile(COUNTER) }
}
