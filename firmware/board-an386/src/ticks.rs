//! Counters: microseconds since boot, and system ticks, which count instructions under QEMU's `-icount shift=0`.

use core::ptr::{read_volatile, write_volatile};

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

/// Instructions to a tick under `-icount shift=0`: an instruction takes 1 ns, a tick of the 25 MHz clock 40 ns.
pub const INSTRUCTIONS_PER_TICK: u64 = 40;

/// The counter has 24 bits.
const WRAP: u32 = 0x0100_0000;

/// System ticks since it was made, modulo 2²⁴.
pub struct Stopwatch {
    timer: SYST,
    start: u32,
}

impl Stopwatch {
    /// Starts the system timer; `None` if it was taken before.
    pub fn new() -> Option<Self> {
        let mut timer = cortex_m::Peripherals::take()?.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(WRAP - 1);
        timer.clear_current();
        timer.enable_counter();
        Some(Self { timer, start: 0 })
    }

    /// Starts to count from zero.
    pub fn restart(&mut self) {
        self.timer.clear_current();
        self.start = SYST::get_current();
    }

    /// Ticks since the restart, at most 2²⁴ − 1.
    pub fn ticks(&self) -> u32 {
        // The timer counts down.
        self.start.wrapping_sub(SYST::get_current()) % WRAP
    }
}

/// The board's cycle counter, divided down to microseconds.
const FPGA_IO: usize = 0x4002_8000;
const COUNTER: *mut u32 = (FPGA_IO + 0x18) as *mut u32;
const PRESCALE: *mut u32 = (FPGA_IO + 0x1c) as *mut u32;
const CORE_CLOCK_MHZ: u32 = 25;

/// Starts to count microseconds.
pub(crate) fn start_microseconds() {
    // SAFETY: the two registers of the board's counter, which nothing else writes.
    unsafe {
        write_volatile(PRESCALE, CORE_CLOCK_MHZ - 1);
        write_volatile(COUNTER, 0);
    }
}

/// Microseconds since boot, modulo 2³².
pub(crate) fn microseconds() -> u32 {
    // SAFETY: reading the counter has no side effect.
    unsafe { read_volatile(COUNTER) }
}
