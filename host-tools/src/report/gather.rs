//! From a campaign to findings, by way of a flight computer.

use kapvik_firmware::soil::QueryAnswer;
use kapvik_firmware::wheel_state::SoilQuery;

use crate::data::campaign::Campaign;
use crate::error::HostError;
use crate::flight_computer::{Computer, FlightComputer};
use crate::identify::identify_rehearsed;
use crate::qemu::LogView;

use super::facts::FlightFacts;
use super::findings::{Findings, fingerprint};
use super::residual::ModelCheck;

impl Findings {
    /// Sends the states of a campaign to a flight computer, whose networks know the effects that it declares or none, and gathers what it makes
    /// of them.
    ///
    /// # Errors
    /// Where the computer cannot be had, does not pass its self-test or does not answer, or the campaign lacks a column.
    pub fn gather(campaign: Campaign, know_effects: bool, on: Computer) -> Result<Self, HostError> {
        let mut computer = FlightComputer::start(on, LogView::Information)?;
        let boot = computer.passed_boot_report()?;
        let mut answers: Vec<QueryAnswer> = Vec::new();
        let identification = identify_rehearsed(&campaign, know_effects, &mut |query: &SoilQuery| {
            let answer = computer.query(query)?;
            answers.push(answer.clone());
            Ok(answer)
        })?;
        let health = computer.health()?;
        let fingerprint = fingerprint(&answers)
            .map_err(|error| HostError::Failed(format!("the answers have no fingerprint: {error}")))?;
        let (memory, log) = (computer.memory(), computer.into_log());
        let flight = FlightFacts { computer: on, boot, health, memory, log, fingerprint, networks: None };
        Ok(Self { model: ModelCheck::of(&campaign), campaign, identification, flight })
    }
}
