//! The flight image for QEMU's `mps2-an386`: serial port in, pipeline, serial port out.
#![no_std]
#![no_main]

use kapvik_board_an386::{entry, exit, stack, uart::LinkUart};
use kapvik_firmware::telemetry::{Board, Event, Telemetry};

/// What the board knows about itself.
struct An386;

impl Board for An386 {
    fn stack_high_water_bytes(&mut self) -> Option<u32> {
        Some(stack::high_water_bytes())
    }
}

/// Exit code where the serial port cannot be had.
const NO_PORT: i32 = 2;

#[entry]
fn main() -> ! {
    let Some(port) = LinkUart::take() else { exit(NO_PORT) };
    let mut telemetry = Telemetry::boot(port, An386);
    let self_test = telemetry.self_test();
    if self_test.passed() {
        defmt::info!("self-test passed, {=u8} golden pairs", self_test.wheel_pairs + self_test.rover_pairs);
    } else {
        defmt::error!("self-test failed, no estimates will be given: {}", self_test);
    }
    loop {
        match telemetry.serve() {
            Some(Event::Refused(reason)) => defmt::warn!("frame refused: {}", reason),
            Some(Event::Estimated) => defmt::trace!("soil query answered"),
            Some(event) => defmt::debug!("{}", event),
            None => telemetry.port().wait(),
        }
    }
}
