//! The board's interrupts. The vector table ends behind them, where for a device that it does not know `cortex-m-rt` would have lines for
//! the 240 that the core could have.

use crate::uart;

/// Lines of the board (Arm, application note 386: FPGA with a Cortex-M4).
const LINES: usize = 32;

/// What the core calls.
type Handler = unsafe extern "C" fn();

unsafe extern "C" {
    /// Of `cortex-m-rt`: asks the core for the line, and hands it to what stands in `fault`.
    fn DefaultHandler();
}

// SAFETY: the linker script of `cortex-m-rt` takes this section, and this name, for what stands in the vector table behind the exceptions;
// each entry is a handler.
#[unsafe(link_section = ".vector_table.interrupts")]
#[unsafe(no_mangle)]
static __INTERRUPTS: [Handler; LINES] = {
    let mut lines = [DefaultHandler as Handler; LINES];
    lines[uart::RECEIVE_INTERRUPT as usize] = received;
    lines
};

extern "C" fn received() {
    uart::on_receive();
}
