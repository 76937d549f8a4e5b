//! Channels whose sign is turned against that of the format.

use crate::error::HostError;
use crate::statistics::{centred, correlation};

use super::{Campaign, Channel};

/// Slip above which soil resists a driven wheel beyond doubt.
const DRIVES: f64 = 0.1;
/// Share of the readings that are nearly all, and fewest readings that tell.
const NEARLY_ALL: f64 = 0.9;
const FEWEST: usize = 5;
/// Fewest rows in which a pull is seen to fall, and the greatest slip up to which it usually rises.
const FEWEST_OF_A_TREND: usize = 8;
const RISES_TO: f64 = 0.5;
/// Correlation, and its size over its standard error, from which two things go together.
const TOGETHER: f64 = 0.5;
const BEYOND_CHANCE: f64 = 3.0;

impl Campaign {
    /// Checks that torque and sinkage have the format's sign.
    pub(super) fn check_signs(&self) -> Result<(), HostError> {
        // What reads below zero by another zero, as a torque does of which too much was taken off for the drive's friction, or a gauge that was
        // zeroed on a wheel that had sunk, reads less below zero under more load or slip.
        match self.nearly_all_below_zero(Channel::Torque, |slip| slip > DRIVES) {
            Some((row, below, all)) if self.grows_below_zero(Channel::Torque) => {
                let message = format!(
                    "torque_nm below 0 in {below} of {all} rows with a slip above {DRIVES}, and the more so the more load or slip: expected \
                     positive where the soil resists forward rotation: is its sign turned?"
                );
                return Err(self.error_at_row(row, Channel::Torque, message));
            }
            _ => {}
        }
        match self.nearly_all_below_zero(Channel::Sinkage, |_| true) {
            Some((row, below, all)) if self.grows_below_zero(Channel::Sinkage) => Err(self.error_at_row(
                row,
                Channel::Sinkage,
                format!(
                    "sinkage_m below 0 in {below} of {all} rows, and the more so the more load or slip: expected positive \
                     downward: is its sign turned?"
                ),
            )),
            _ => Ok(()),
        }
    }

    /// What is asked where the drawbar pull falls with slip while the torque rises.
    pub(super) fn of_falling_pull(&self) -> Option<String> {
        let over_load = |channel: Channel| {
            self.pairs(Channel::Slip, channel, |row, slip, value| {
                let load_n = self.value(row, Channel::Load).unwrap_or(1.0);
                ((0.0..=RISES_TO).contains(&slip) && load_n > 0.0).then_some((slip, value / load_n))
            })
        };
        let [pulls, torques] = [Channel::DrawbarPull, Channel::Torque].map(over_load);
        let is_seen = pulls.len() >= FEWEST_OF_A_TREND && torques.len() >= FEWEST_OF_A_TREND;
        (is_seen && trend(&pulls) < 0.0 && trend(&torques) > 0.0).then(|| {
            format!(
                "drawbar_pull_n falls with slip up to {RISES_TO} where torque_nm rises: it is expected positive where it pushes the rover \
                 forward: is its sign turned? A soil may do that, too."
            )
        })
    }

    /// The first row with a reading below zero, how many have one, and of how many, where nearly all do at slips like that; a row without a
    /// slip counts where any slip does.
    fn nearly_all_below_zero(&self, channel: Channel, is_meant: impl Fn(f64) -> bool) -> Option<(usize, usize, usize)> {
        let is_row = |row: &usize| is_meant(self.value(*row, Channel::Slip).unwrap_or(0.0));
        let readings = (0..self.rows.len()).filter(is_row).filter_map(|row| Some((row, self.value(row, channel)?)));
        let readings: Vec<(usize, f64)> = readings.collect();
        let below: Vec<usize> = readings.iter().filter(|(_, value)| *value < 0.0).map(|(row, _)| *row).collect();
        let is_nearly_all = below.len() >= FEWEST && below.len() as f64 >= NEARLY_ALL * readings.len() as f64;
        is_nearly_all.then(|| (below[0], below.len(), readings.len()))
    }

    /// Whether a channel goes further below zero under more load or slip, whichever it follows more.
    fn grows_below_zero(&self, channel: Channel) -> bool {
        let of = |cause| trend(&self.pairs(cause, channel, |_, cause, value| Some((cause, -value))));
        let [load, slip] = [Channel::Load, Channel::Slip].map(of);
        (if load.abs() > slip.abs() { load } else { slip }) > 0.0
    }

    /// What is made of two channels in the rows that have both.
    fn pairs(
        &self,
        one: Channel,
        other: Channel,
        of: impl Fn(usize, f64, f64) -> Option<(f64, f64)>,
    ) -> Vec<(f64, f64)> {
        let pair = |row| of(row, self.value(row, one)?, self.value(row, other)?);
        (0..self.rows.len()).filter_map(pair).collect()
    }
}

/// The correlation of pairs; 0 where it is not clear.
fn trend(pairs: &[(f64, f64)]) -> f64 {
    let count = pairs.len() as f64;
    let (x, y): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let correlation = correlation(&centred(&x), &centred(&y));
    let errors = correlation.abs() * ((count - 2.0) / (1.0 - correlation * correlation).max(1e-12)).sqrt();
    if correlation.abs() > TOGETHER && errors > BEYOND_CHANCE { correlation } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// Three loads at five slips, with the signs of pull, torque and sinkage, and the gauge's zero.
    fn read([pull, torque, sinkage]: [f64; 3], zero_m: f64) -> Result<Campaign, String> {
        let row = |place: usize| {
            let (slip, load) = (0.02 + 0.1 * (place % 5) as f64, 40.0 + 20.0 * (place / 5) as f64);
            let (felt, depth) = (load * (0.05 + 0.3 * slip), 0.004 + 1e-4 * load + 0.004 * slip);
            let (pull, torque, sinkage) = (pull * felt, torque * 0.2 * felt, sinkage * depth - zero_m);
            format!("r{place},0,{slip},{load},{pull},{torque},{sinkage}\n")
        };
        let rows: String = (0..15).map(row).collect();
        let csv = format!("run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m\n{rows}");
        let toml = "name = \"a\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.15\nwidth_m = 0.1\n";
        Campaign::parse(Path::new("a.csv"), &csv, toml).map_err(|error| error.to_string())
    }

    #[test]
    fn a_turned_sign_is_refused_or_asked_about() {
        assert!(read([1.0; 3], 0.0).expect("as the format has it").remarks().is_empty());
        let said = read([1.0, -1.0, 1.0], 0.0).expect_err("torque");
        assert!(said.starts_with("a.csv:3:6: torque_nm below 0 in 12 of 12 rows"), "{said}");
        assert!(
            said.ends_with("expected positive where the soil resists forward rotation: is its sign turned?"),
            "{said}"
        );
        let said = read([1.0, 1.0, -1.0], 0.0).expect_err("sinkage");
        assert!(said.starts_with("a.csv:2:7: sinkage_m below 0 in 15 of 15 rows"), "{said}");
        let said = read([-1.0, 1.0, 1.0], 0.0).expect("a soil may do that").remarks();
        assert!(said[0].starts_with("drawbar_pull_n falls with slip"), "{said:?}");
    }

    /// Its zero is wrong, not its sign.
    #[test]
    fn a_gauge_that_was_zeroed_on_a_sunk_wheel_is_read() {
        assert!(read([1.0; 3], 0.02).expect("another zero").remarks().is_empty());
    }

    /// Nor is that of a torque of which too much was taken off: it still rises with slip.
    #[test]
    fn a_torque_with_another_zero_is_read() {
        let row = |place: usize| {
            let (slip, load) = (0.12 + 0.1 * (place % 4) as f64, 60.0 + 5.0 * (place / 4) as f64);
            format!("r{place},0,{slip},{load},{}\n", 0.03 * load * slip - 6.0)
        };
        let csv = format!("run,t_s,slip,load_n,torque_nm\n{}", (0..12).map(row).collect::<String>());
        let toml = "name = \"a\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.15\nwidth_m = 0.1\n";
        Campaign::parse(Path::new("a.csv"), &csv, toml).expect("an offset");
    }
}
