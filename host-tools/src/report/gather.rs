//! From a campaign to findings, by way of a flight computer.

use std::time::Duration;

use kapvik_firmware::soil::QueryAnswer;
use kapvik_firmware::wheel_state::SoilQuery;

use crate::data::campaign::Campaign;
use crate::error::HostError;
use crate::flight_computer::{Computer, FlightComputer};
use crate::identify::identify;
use crate::qemu::{Binary, Image, LogLine, LogView, MemoryUse};
use crate::setup;

use super::facts::FlightFacts;
use super::findings::{Findings, fingerprint};
use super::residual::ModelCheck;

impl Findings {
    /// Sends the states of a campaign to a flight computer, and gathers what it makes of them.
    ///
    /// # Errors
    /// Where the computer cannot be had, does not pass its self-test or does not answer, or the campaign lacks a column.
    pub fn gather(campaign: Campaign, on: Computer) -> Result<Self, HostError> {
        let (mut computer, memory) = start(on)?;
        let boot = computer.boot_report()?;
        if !boot.self_test.passed() {
            return Err(HostError::Failed(format!("the flight computer's self-test failed: {:?}", boot.self_test)));
        }
        let mut answers: Vec<QueryAnswer> = Vec::new();
        let identification = identify(&campaign, &mut |query: &SoilQuery| {
            let answer = computer.query(query)?;
            answers.push(answer.clone());
            Ok(answer)
        })?;
        let health = computer.health()?;
        let fingerprint = fingerprint(&answers)
            .map_err(|error| HostError::Failed(format!("the answers have no fingerprint: {error}")))?;
        let flight = FlightFacts { computer: on, boot, health, memory, log: settled_log(&computer), fingerprint };
        Ok(Self { model: ModelCheck::of(&campaign), campaign, identification, flight })
    }
}

/// The log, once it has stopped growing: it comes over a line of its own, behind the answers.
fn settled_log(computer: &FlightComputer) -> Vec<LogLine> {
    const PAUSE: Duration = Duration::from_millis(60);
    const PAUSES: u32 = 20;
    let mut log = computer.log();
    for _ in 0..PAUSES {
        std::thread::sleep(PAUSE);
        let later = computer.log();
        if later.len() == log.len() {
            break;
        }
        log = later;
    }
    log
}

fn start(on: Computer) -> Result<(FlightComputer, Option<MemoryUse>), HostError> {
    match on {
        Computer::Host => Ok((FlightComputer::in_process()?, None)),
        Computer::Qemu => {
            let toolchain = setup::prepare(None)?;
            let image = Image::build(&toolchain, Binary::Flight)?;
            let memory = MemoryUse::of(&image)?;
            Ok((FlightComputer::in_qemu(&toolchain, &image, LogView::Information)?, Some(memory)))
        }
    }
}
