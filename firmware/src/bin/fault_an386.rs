//! Goes wrong on purpose: shows that a panic ends QEMU with a non-zero exit and leaves its place in the log.
#![no_std]
#![no_main]

use kapvik_board_an386::{entry, uart};

#[entry]
fn main() -> ! {
    uart::start_log();
    panic!("on purpose");
}
