//! Arm's MPS2 board with the AN386 image, a Cortex-M4F, as QEMU's machine `mps2-an386` has it.
//!
//! UART0 is the link, UART1 the log. This is target code: on any other target the crate is empty.
#![no_std]
#![cfg(target_os = "none")]

pub mod bench;
mod fault;
mod interrupts;
mod log;
pub mod stack;
mod ticks;
pub mod uart;

pub use cortex_m_rt::entry;

/// Ends QEMU with the given exit code.
pub fn exit(code: i32) -> ! {
    semihosting::process::exit(code)
}
