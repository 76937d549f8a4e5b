//! The `[wheel]` table of rover files, campaigns and wheel files.

use std::path::Path;

use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::terramechanics::effects::Grousers as LibraryGrousers;
use serde::Deserialize;
use toml::Spanned;

use super::toml_file::TomlFile;
use crate::error::HostError;

/// A wheel as a file describes it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WheelTable {
    radius_m: Spanned<f64>,
    width_m: Spanned<f64>,
    #[serde(default)]
    grouser_height_m: Option<Spanned<f64>>,
    #[serde(default)]
    grouser_count: Option<u32>,
}

/// Radius and width that no wheel of a vehicle exceeds, m: beyond it a file is in other units.
pub const LARGEST_M: f64 = 5.0;

/// The grousers of a wheel: geometry, which acts only through an effect.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Grousers {
    /// Height over the rim, m.
    pub height_m: f64,
    /// How many there are around the rim.
    pub count: u32,
}

impl Grousers {
    /// As the wheel–soil equations take them.
    pub fn of_library(self) -> LibraryGrousers<f64> {
        LibraryGrousers { height_m: self.height_m, count: self.count.into() }
    }
}

impl WheelTable {
    /// The wheel of a file that has a `[wheel]` table or is one.
    ///
    /// # Errors
    /// Where the file cannot be read, a key is missing, unknown or of the wrong kind, or a length is not above zero.
    pub fn read(path: &Path) -> Result<Self, HostError> {
        let file = TomlFile::read(path)?;
        let wheel: Self = file.section_or_whole("wheel")?;
        wheel.check(&file)?;
        Ok(wheel)
    }

    /// Refuses lengths that no wheel has.
    ///
    /// # Errors
    /// At the length, in `file`.
    pub fn check(&self, file: &TomlFile) -> Result<(), HostError> {
        for (name, length) in [("radius_m", &self.radius_m), ("width_m", &self.width_m)] {
            if !(*length.get_ref() > 0.0 && *length.get_ref() <= LARGEST_M) {
                let expected = format!("expected a length above 0 m and at most {LARGEST_M} m");
                return Err(file.error_at(length, format!("{name} = {}: {expected}", length.get_ref())));
            }
        }
        check_grouser_height(self.grouser_height_m.as_ref(), file)
    }

    /// The wheel of equations 1–11.
    pub fn wheel(&self) -> Wheel<f64> {
        Wheel { radius_m: *self.radius_m.get_ref(), width_m: *self.width_m.get_ref() }
    }

    /// Its grousers; none where the file does not say.
    pub fn grousers(&self) -> Grousers {
        Grousers {
            height_m: self.grouser_height_m.as_ref().map_or(0.0, |height| *height.get_ref()),
            count: self.grouser_count.unwrap_or(0),
        }
    }
}

/// Refuses a height of grousers, where a file states one, that is none.
///
/// # Errors
/// At the height, in `file`.
pub(super) fn check_grouser_height(height_m: Option<&Spanned<f64>>, file: &TomlFile) -> Result<(), HostError> {
    match height_m {
        Some(height) if !(*height.get_ref() >= 0.0 && height.get_ref().is_finite()) => {
            let message = format!("grouser_height_m = {}: expected 0 m or more", height.get_ref());
            Err(file.error_at(height, message))
        }
        _ => Ok(()),
    }
}
