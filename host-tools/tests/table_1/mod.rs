//! The seed's sand.

use kapvik_firmware::terramechanics::Soil;
use kapvik_host::soil_catalogue::{Completion, catalogue};

/// Table 1 of the seed, as the catalogue has it.
pub fn table_1() -> Soil<f64> {
    let soils = catalogue().expect("the data file that is built in reads");
    let sand = soils.iter().find(|soil| soil.id == "seed-table-1").expect("in the catalogue");
    sand.complete(&Completion::SEED).expect("the seed's Table 1 is complete")
}
