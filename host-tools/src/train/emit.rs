//! The frozen table as a file.

use kapvik_firmware::network::{PartVisitor, RoverTable, WheelTable, Words};
use kapvik_table_file::{Block, TableFile};

use super::fifth_input::Candidate;
use super::plan::Plan;
use super::world::World;
use crate::error::HostError;
use crate::prior::{self, Range};

/// The note that says which effects the networks were trained with.
pub const EFFECTS_NOTE: &str = "effects";

/// Collects the parts of a table as blocks.
struct Blocks(Vec<Block>);

impl PartVisitor for Blocks {
    fn part(&mut self, name: &'static str, shape: &[usize], numbers: &mut impl Words) {
        let mut words = Vec::new();
        numbers.for_each(&mut |word| words.push(word));
        self.0.push(Block { name: name.to_owned(), shape: shape.to_vec(), words });
    }
    fn whole_part(&mut self, name: &'static str, shape: &[usize], numbers: &mut impl Words) {
        self.part(name, shape, numbers);
    }
}

/// What stands in the file beside the numbers.
pub struct Provenance<'a> {
    /// The run that made the table.
    pub plan: &'a Plan,
    /// The world that the scenes were drawn from.
    pub world: &'a World,
    /// The per-wheel network's fifth input.
    pub fifth: Candidate,
    /// Held-out losses of the per-wheel and of the rover network.
    pub losses: [f64; 2],
}

/// The file of two tables.
///
/// # Errors
/// Where a network cannot fly.
pub fn table_file(wheel: WheelTable, rover: RoverTable, provenance: &Provenance<'_>) -> Result<TableFile, HostError> {
    let can_fly = [wheel.network.cannot_overflow(), rover.network.cannot_overflow()];
    check_networks(provenance.losses, can_fly)?;
    Ok(TableFile { notes: notes(provenance), blocks: blocks(wheel, rover) })
}

/// Refuses networks that cannot fly, of their losses and of whether their sums stay within 32 bits: per-wheel and rover network.
fn check_networks(losses: [f64; 2], can_fly: [bool; 2]) -> Result<(), HostError> {
    for ((name, loss), can_fly) in ["per-wheel", "rover"].into_iter().zip(losses).zip(can_fly) {
        let wrong = if !loss.is_finite() {
            format!("its held-out loss is {loss}")
        } else if !can_fly {
            "its sums can overflow 32 bits".to_owned()
        } else {
            continue;
        };
        return Err(HostError::Failed(format!("the {name} network has diverged: {wrong}; no table is written")));
    }
    Ok(())
}

/// The numbers of two tables, as their file has them.
fn blocks(mut wheel: WheelTable, mut rover: RoverTable) -> Vec<Block> {
    let mut blocks = Blocks(Vec::new());
    wheel.visit_parts(&mut blocks);
    rover.visit_parts(&mut blocks);
    blocks.0
}

/// A remark in a table's file: its key, then its words.
type Note = (&'static str, String);

fn notes(provenance: &Provenance<'_>) -> Vec<(String, String)> {
    let notes = of_training(provenance).into_iter().chain(of_soils()).chain(of_scenes());
    notes.map(|(key, value)| (key.to_owned(), value)).collect()
}

fn of_training(provenance: &Provenance<'_>) -> [Note; 10] {
    let Provenance { plan, world, fifth, losses } = provenance;
    [
        ("made by", format!("kapvik train {}", env!("CARGO_PKG_VERSION"))),
        ("seed", plan.seed.to_string()),
        ("scenes", format!("{} for training, {} held out", plan.scenes, plan.held_out)),
        ("passes", format!("{} rover network, {} per-wheel network", plan.rover, plan.wheel)),
        ("held-out loss", format!("{:.4} per-wheel, {:.4} rover (nats)", losses[0], losses[1])),
        ("activation", "bipolar sigmoid 2 / (1 + exp(-A x)) - 1, A/2 within the weights".into()),
        (
            "whole numbers",
            "the networks: pairs of 16 bits; neurons of rover.network are products of two activations".into(),
        ),
        (EFFECTS_NOTE, world.to_string()),
        ("fifth input", fifth.name().into()),
        ("targets", "ln c (Pa), phi (rad), ln K (m); means, then log-variances on the scale of the prior".into()),
    ]
}

fn of_soils() -> [Note; 7] {
    [
        ("prior c", range(prior::COHESION_PA, "Pa")),
        ("prior phi", range(prior::FRICTION_ANGLE_RAD, "rad")),
        ("prior K", range(prior::SHEAR_MODULUS_M, "m")),
        ("prior n", range(prior::SINKAGE_EXPONENT, "")),
        ("prior k_eff", range(prior::STIFFNESS, "Pa/m^n")),
        ("prior c1", range(prior::PEAK_STRESS_C1, "")),
        ("prior c2", range(prior::PEAK_STRESS_C2, "")),
    ]
}

fn of_scenes() -> [Note; 5] {
    let noise = prior::INSTANT_NOISE;
    [
        (
            "wheels",
            format!(
                "{:.0} % Kapvik's (assumed), others of radius {}; {:.0} % of what the rover network is shown: six of Kapvik's at \
                 slips from small to great, half spread of loads {}",
                100.0 * prior::KAPVIK_SHARE,
                range(prior::RADIUS_M, "m"),
                100.0 * prior::MANOEUVRE_SHARE,
                range(prior::MANOEUVRE_LOAD_SPREAD, "")
            ),
        ),
        ("pressures", format!("W/(rb) {}", range(prior::PRESSURE_PA, "Pa"))),
        ("slip", range(prior::SLIP, "")),
        (
            "patches",
            format!(
                "{:.0} % of what the rover network is shown: 2 ... 6 soils under the wheels, parameters within a share of their \
                 ranges of {} from a middle; targets are the mean over the wheels",
                100.0 * prior::PATCHY_SHARE,
                range(prior::PATCH_REACH, "")
            ),
        ),
        (
            "noise",
            format!(
                "per instant DP/W {:.5}, W/W {:.5}, T/(rW) {:.5}, slip {:.5}, z/r {:.5}; averaging factor {}, in {:.0} % of \
                 what the rover network is shown {}",
                noise.drawbar_pull,
                noise.load,
                noise.torque,
                noise.slip,
                noise.sinkage,
                range(prior::AVERAGING, ""),
                100.0 * prior::PRECISE_SHARE,
                range(prior::PRECISE_AVERAGING, "")
            ),
        ),
    ]
}

fn range(range: Range, unit: &str) -> String {
    let Range { low, high, logarithmic } = range;
    let kind = if logarithmic { "logarithmic" } else { "uniform" };
    format!("{low} ... {high} {unit} {kind}").replace("  ", " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_network_that_has_diverged_is_refused() {
        assert!(check_networks([-1.2, -3.0], [true; 2]).is_ok());
        let said = |losses, can_fly| check_networks(losses, can_fly).expect_err("refused").to_string();
        assert!(said([-1.2, f64::NAN], [true; 2]).contains("the rover network has diverged: its held-out loss is NaN"));
        assert!(
            said([-1.2, -3.0], [false, true]).contains("the per-wheel network has diverged: its sums can overflow")
        );
    }
}
