//! A panic or a fault ends QEMU with a non-zero exit; it never hangs.

use core::panic::PanicInfo;

use cortex_m_rt::{ExceptionFrame, exception};

/// Exit code after a panic.
const PANIC: i32 = 101;
/// Exit code after a hard fault.
const HARD_FAULT: i32 = 102;
/// Exit code after an interrupt or exception that nobody handles.
const UNHANDLED: i32 = 103;

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    match info.location() {
        Some(place) => defmt::error!("panic at {=str}:{=u32}", place.file(), place.line()),
        None => defmt::error!("panic"),
    }
    crate::exit(PANIC)
}

#[exception]
// SAFETY: reads the stacked registers and ends; no state of the interrupted program is touched.
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    defmt::error!("hard fault at {=u32:#010x}, called from {=u32:#010x}", frame.pc(), frame.lr());
    crate::exit(HARD_FAULT)
}

#[exception]
// SAFETY: ends; no state of the interrupted program is touched.
unsafe fn DefaultHandler(number: i16) {
    defmt::error!("interrupt {=i16} has no handler", number);
    crate::exit(UNHANDLED)
}
