//! The rows that a diagnosis can use, and why it leaves out the others.

use std::collections::BTreeMap;

use crate::data::campaign::Campaign;
use crate::error::HostError;

use super::document::LeftOut;
use super::fit::{CHANNELS, Reading};
use super::lone_rows::LoneRow;
use super::measurements::COLUMNS;

/// Slip below which a row is braking. A slip zero that is off by a few per cent does not make a driven wheel one that brakes.
const BRAKING: f64 = -0.05;

/// A row that can be used.
#[derive(Debug, Clone, Copy)]
pub struct UsableRow {
    /// Its place in the campaign.
    pub place: usize,
    /// What was read.
    pub readings: [Option<f64>; CHANNELS],
}

/// Why a row is left out, in the order in which reasons are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Reason {
    NothingToJudge,
    Braking,
    GrossError,
    FarOut,
    Copy,
}

impl Reason {
    fn in_words(self) -> &'static str {
        match self {
            Self::NothingToJudge => "nothing to judge: no slip, neither load nor sinkage, or nothing else",
            Self::Braking => "braking",
            Self::GrossError => "gross errors: a force or sinkage that no wheel can have felt",
            Self::FarOut => "far out of what all other rows say",
            Self::Copy => "copies: in runs that say, row by row, what another run says",
        }
    }
}

/// The rows that can be used, in the order of the campaign, and how many others are left out for what; those that stand alone are named.
/// Rows that brake are used where that is asked for, and where no other is left.
///
/// # Errors
/// Where no row is left.
pub fn usable_rows(
    campaign: &Campaign,
    braking: bool,
    lone: &[LoneRow],
) -> Result<(Vec<UsableRow>, Vec<LeftOut>), HostError> {
    let (mut usable, mut left_out) = sorted_out(campaign, lone);
    let only_brake = usable.iter().all(|row| brakes(&row.readings));
    if !braking && !only_brake {
        let all = usable.len();
        usable.retain(|row| !brakes(&row.readings));
        left_out.extend((usable.len() < all).then_some((Reason::Braking, all - usable.len())));
    }
    if usable.is_empty() {
        return Err(campaign.error("no row that has a slip, a load or a sinkage, and a force or a sinkage to judge"));
    }
    let told = left_out.into_iter().map(|(reason, rows)| LeftOut { reason: reason.in_words().to_owned(), rows });
    Ok((usable, told.collect()))
}

/// The rows that can be used, those that brake among them, and how many others cannot for what.
fn sorted_out(campaign: &Campaign, lone: &[LoneRow]) -> (Vec<UsableRow>, BTreeMap<Reason, usize>) {
    let mut usable = Vec::new();
    let mut left_out = BTreeMap::<Reason, usize>::new();
    for (place, is_copy) in campaign.copies().iter().enumerate() {
        let readings = COLUMNS.map(|channel| campaign.value(place, channel));
        let reason = if !has_something_to_judge(&readings) {
            Reason::NothingToJudge
        } else if campaign.gross_error(place).is_some() {
            Reason::GrossError
        } else if lone.iter().any(|lone| lone.place == place) {
            Reason::FarOut
        } else if *is_copy {
            Reason::Copy
        } else {
            usable.push(UsableRow { place, readings });
            continue;
        };
        *left_out.entry(reason).or_default() += 1;
    }
    (usable, left_out)
}

/// Whether a wheel that reads so is braked or towed.
pub fn brakes(readings: &[Option<f64>; CHANNELS]) -> bool {
    readings[Reading::Slip.index()].is_some_and(|slip| slip < BRAKING)
}

/// A slip, what determines the sinkage, and something to judge that by.
fn has_something_to_judge(readings: &[Option<f64>; CHANNELS]) -> bool {
    let has = |reading: Reading| readings[reading.index()].is_some();
    let forces = [Reading::DrawbarPull, Reading::Torque, Reading::SideForce].into_iter().filter(|r| has(*r)).count();
    let carried = has(Reading::Load);
    has(Reading::Slip) && ((carried && (forces > 0 || has(Reading::Sinkage))) || (has(Reading::Sinkage) && forces > 0))
}
