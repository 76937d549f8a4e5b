//! How deep the stack has been. The start-up code paints it; what is no longer paint was used.

use core::ptr::{addr_of, read_volatile};

use cortex_m_rt::STACK_PAINT_VALUE;

unsafe extern "C" {
    static _stack_start: u32;
    static _stack_end: u32;
}

/// The deepest that the stack has been since boot, or since [`repaint`], bytes.
pub fn high_water_bytes() -> u32 {
    let (top, bottom) = bounds();
    let mut word = bottom;
    // SAFETY: `word` stays within the stack region that the linker script reserves, word aligned, and is only read.
    while word < top && unsafe { read_volatile(word as *const u32) } == STACK_PAINT_VALUE {
        word += 4;
    }
    (top - word) as u32
}

/// Paints what lies below the caller's frame, so that the next measurement starts there. Gives the depth so far, bytes.
#[inline(never)]
pub fn repaint() -> u32 {
    // Interrupts are off: nobody else has a frame below this one.
    critical_section::with(|_| {
        let (top, bottom) = bounds();
        let pointer = cortex_m::register::msp::read() as usize;
        let mut word = bottom;
        while word < pointer {
            // SAFETY: `word` is within the stack region, word aligned and below the stack pointer: in nobody's frame.
            unsafe { (word as *mut u32).write_volatile(STACK_PAINT_VALUE) };
            word += 4;
        }
        (top - pointer) as u32
    })
}

/// Addresses of the top and the bottom of the stack region.
fn bounds() -> (usize, usize) {
    (addr_of!(_stack_start) as usize, addr_of!(_stack_end) as usize)
}
