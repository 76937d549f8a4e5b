//! What a campaign must have for an effect to show in it at all.

use crate::data::campaign::Channel;

/// What an effect needs of a campaign.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wants {
    /// Columns that must be there.
    pub columns: Vec<Channel>,
    /// Loads that differ.
    pub loads: bool,
    /// Speeds that differ.
    pub speeds: bool,
    /// More than one pass.
    pub passes: bool,
    /// Pitch that differs.
    pub pitches: bool,
    /// Slip angles that differ.
    pub slip_angles: bool,
    /// Several rows in a run.
    pub long_runs: bool,
    /// Fewer runs than usual.
    pub few_runs: bool,
    /// Slip that changes within a run.
    pub changing_slip: bool,
    /// Rows that follow each other faster than the grousers.
    pub fast_rows: bool,
    /// A wheel with grousers.
    pub grousers: bool,
    /// Stiffness and peak stress known by other means: without, the soil's own parameters absorb the effect.
    pub known_soil: bool,
}

impl Wants {
    /// These columns.
    pub fn columns(columns: &[Channel]) -> Self {
        Self { columns: columns.to_vec(), ..Self::default() }
    }

    /// Both.
    pub fn and(mut self, other: &Self) -> Self {
        self.columns.extend(&other.columns);
        Self {
            columns: self.columns,
            loads: self.loads || other.loads,
            speeds: self.speeds || other.speeds,
            passes: self.passes || other.passes,
            pitches: self.pitches || other.pitches,
            slip_angles: self.slip_angles || other.slip_angles,
            long_runs: self.long_runs || other.long_runs,
            few_runs: self.few_runs || other.few_runs,
            changing_slip: self.changing_slip || other.changing_slip,
            fast_rows: self.fast_rows || other.fast_rows,
            grousers: self.grousers || other.grousers,
            known_soil: self.known_soil || other.known_soil,
        }
    }
}
