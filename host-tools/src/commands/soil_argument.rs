//! A soil as the command line names it.

use std::path::Path;

use kapvik_firmware::terramechanics::Soil;

use crate::data::soil_file::SoilTable;
use crate::error::HostError;
use crate::printable::on_one_line;
use crate::soil_catalogue::{Completion, catalogue};

/// A soil by its name in the catalogue, or from a file.
///
/// # Errors
/// Where there is neither, or it leaves open what the equations need.
pub fn soil(name: &str) -> Result<Soil<f64>, HostError> {
    let soils = catalogue()?;
    match soils.iter().find(|soil| soil.id == name) {
        Some(soil) => soil.complete(&Completion::SEED).map_err(|missing| {
            HostError::Failed(format!(
                "{}: its source leaves open what the equations need: {missing}",
                on_one_line(name)
            ))
        }),
        None if name.ends_with(".toml") => SoilTable::read_complete(Path::new(name)),
        None => Err(HostError::Failed(format!(
            "{}: expected a file S.toml, or a soil of the catalogue: {}",
            on_one_line(name),
            soils.iter().map(|soil| soil.id.as_str()).collect::<Vec<_>>().join(", ")
        ))),
    }
}
