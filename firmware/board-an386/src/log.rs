//! The log: defmt's frames over UART1.

use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicBool, Ordering};

use critical_section::RestoreState;

use crate::{ticks, uart};

#[defmt::global_logger]
struct UartLogger;

struct State {
    encoder: UnsafeCell<defmt::Encoder>,
    restore: UnsafeCell<RestoreState>,
}

// SAFETY: both cells are used only between `acquire` and `release`, where interrupts are off and `TAKEN` is set.
unsafe impl Sync for State {}

static STATE: State =
    State { encoder: UnsafeCell::new(defmt::Encoder::new()), restore: UnsafeCell::new(RestoreState::invalid()) };
static TAKEN: AtomicBool = AtomicBool::new(false);

// Microseconds since the link was taken, in 32 bits: they start again at zero every 71.6 min. Clock ticks in an image that counts these.
defmt::timestamp!("{=u32:us}", ticks::now());

// SAFETY: `acquire` to `release` is a critical section. A second `acquire` in between comes of a fault or panic inside a log statement alone: it
// ends the frame under way with a zero byte and starts a new one. The handlers of both end the program behind that, so that nothing goes on
// with the frame that was cut.
unsafe impl defmt::Logger for UartLogger {
    fn acquire() {
        // SAFETY: released in `release`, which defmt calls after each `acquire`.
        let restore = unsafe { critical_section::acquire() };
        if TAKEN.load(Ordering::Relaxed) {
            // A fault or panic inside a log statement: what was being logged is cut, the new frame goes out whole.
            uart::transmit_log(&[0]);
        }
        TAKEN.store(true, Ordering::Relaxed);
        // SAFETY: interrupts are off, so this is the only access.
        unsafe {
            *STATE.restore.get() = restore;
            (*STATE.encoder.get()).start_frame(uart::transmit_log);
        }
    }

    unsafe fn flush() {}

    unsafe fn release() {
        // SAFETY: called after `acquire`, interrupts are off, so this is the only access.
        let restore = unsafe {
            (*STATE.encoder.get()).end_frame(uart::transmit_log);
            *STATE.restore.get()
        };
        TAKEN.store(false, Ordering::Relaxed);
        // SAFETY: the state that the matching `acquire` gave.
        unsafe { critical_section::release(restore) };
    }

    unsafe fn write(bytes: &[u8]) {
        // SAFETY: called between `acquire` and `release`, interrupts are off, so this is the only access.
        unsafe { (*STATE.encoder.get()).write(bytes, uart::transmit_log) };
    }
}
