//! The bank of soils that Ray's method chooses from: the soils of the literature.

use kapvik_firmware::terramechanics::Soil;

use crate::error::HostError;
use crate::soil_catalogue::{CatalogueSoil, Completion, catalogue};

/// A soil of the bank.
#[derive(Debug, Clone, PartialEq)]
pub struct BankSoil {
    /// Its id in the catalogue.
    pub id: String,
    /// Its parameters.
    pub soil: Soil<f64>,
    /// The source gives K, c₁ and c₂; else some of them are those of the seed's Table 1.
    pub complete: bool,
}

/// Every soil of the catalogue that has a pressure law and a strength, K, c₁, c₂ and η from the seed's Table 1 (K 11.4 mm,
/// c₁ 0.18, c₂ 0.32, η 0) where its source has none. Few sources give c₁ and c₂.
///
/// # Errors
/// As [`catalogue`].
pub fn soil_bank() -> Result<Vec<BankSoil>, HostError> {
    let soils = catalogue()?;
    Ok(soils.into_iter().filter_map(bank_soil).collect())
}

fn bank_soil(soil: CatalogueSoil) -> Option<BankSoil> {
    let completed = soil.complete(&Completion::SEED).ok()?;
    let complete = soil.shear_modulus_mm.is_some() && soil.c1.is_some() && soil.c2.is_some();
    Some(BankSoil { id: soil.id, soil: completed, complete })
}
