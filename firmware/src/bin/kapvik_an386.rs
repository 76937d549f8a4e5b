//! The flight image for QEMU's `mps2-an386`: serial port in, pipeline, serial port out.
#![no_std]
#![no_main]

use kapvik_board_an386::{entry, exit, stack, uart::LinkUart};
use kapvik_firmware::telemetry::{Board, Event, Noticed, SensorChange, Telemetry};

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
    let mut telemetry = Telemetry::new(port, An386);
    telemetry.start();
    let self_test = telemetry.self_test();
    if self_test.passed() {
        defmt::info!("self-test passed, {=u8} golden pairs", self_test.wheel_pairs + self_test.rover_pairs);
    } else {
        defmt::error!("self-test failed, no estimates will be given: {}", self_test);
    }
    loop {
        match telemetry.serve() {
            Some(event) => log(&event),
            None => telemetry.port().wait(),
        }
    }
}

fn log(event: &Event) {
    match event {
        Event::Refused(reason) => defmt::warn!("frame refused: {}", reason),
        Event::FrameRefused(reason) => defmt::warn!("sensor frame refused: {}", reason),
        Event::Configured(Ok(())) => defmt::info!("rover configured, estimating anew"),
        Event::Configured(Err(reason)) => defmt::warn!("impossible rover, kept the one before: {}", reason),
        Event::Estimated(noticed) => log_noticed(noticed),
        Event::Repeated => defmt::debug!("sensor frame repeated"),
        Event::Queried => defmt::trace!("soil query answered"),
        Event::Greeted => defmt::debug!("greeted"),
        Event::HealthReported => defmt::debug!("health reported"),
        Event::SelfTested(report) => defmt::debug!("self-test: {}", report),
    }
}

fn log_noticed(noticed: &Noticed) {
    if let Some(count) = noticed.soil_changes {
        defmt::info!("the soil changed, {=u16} so far", count);
    }
    if noticed.gaps > 0 {
        defmt::warn!("a long gap between frames or a clock set back, filters started anew");
    }
    if noticed.filter_resets > 0 {
        defmt::warn!("{=u32} filters reset to their floor", noticed.filter_resets);
    }
    if noticed.relearned > 0 {
        defmt::warn!("{=u32} filters gave up what they believed", noticed.relearned);
    }
    noticed.for_each_sensor(|sensor, change| match change {
        SensorChange::Dropped => defmt::warn!("sensor dropped: {}", sensor),
        SensorChange::Restored => defmt::info!("sensor restored: {}", sensor),
    });
}
