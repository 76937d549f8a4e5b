//! What equations 1–11 leave unexplained, with the soil that other means have measured.

use kapvik_firmware::terramechanics::{Soil, Wheel};
use kapvik_firmware::wheel_state::WheelState;

use super::draw::number;
use crate::data::campaign::{Campaign, Channel, Knowledge};
use crate::statistics::root_mean_square;

/// The equations beside the measurements.
#[derive(Debug, Clone)]
pub struct ModelCheck {
    /// The soil of the equations.
    pub soil: Soil<f64>,
    /// Every row that has slip and load, but for gross errors.
    pub rows: Vec<ModelRow>,
}

/// What the equations say of one wheel state, at its slip and load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelState {
    /// Drawbar pull, N.
    pub drawbar_pull_n: f64,
    /// Torque, N·m.
    pub torque_nm: f64,
    /// Sinkage, m.
    pub sinkage_m: f64,
}

/// A row and what the equations say of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelRow {
    /// Slip.
    pub slip: f64,
    /// Load, N.
    pub load_n: f64,
    /// Measured drawbar pull, N.
    pub drawbar_pull_n: Option<f64>,
    /// Measured torque, N·m.
    pub torque_nm: Option<f64>,
    /// Measured sinkage, m.
    pub sinkage_m: Option<f64>,
    /// What the equations say; none where the soil does not carry the load.
    pub model: Option<ModelState>,
}

/// What the equations leave, of a row or as the root mean square over all; none for a channel that was not measured.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LeftOver {
    /// Of the drawbar pull, N.
    pub drawbar_pull_n: Option<f64>,
    /// Of the torque, N·m.
    pub torque_nm: Option<f64>,
    /// Of the sinkage, m.
    pub sinkage_m: Option<f64>,
}

impl ModelCheck {
    /// None where the campaign does not know enough of the soil by other means.
    pub fn of(campaign: &Campaign) -> Option<Self> {
        Some(Self::with(campaign, known_soil(campaign)?))
    }

    /// With any soil.
    pub fn with(campaign: &Campaign, soil: Soil<f64>) -> Self {
        let row = |row| {
            let value = |channel| campaign.value(row, channel);
            let (slip, load_n) = (value(Channel::Slip)?, value(Channel::Load)?);
            Some(ModelRow {
                slip,
                load_n,
                drawbar_pull_n: value(Channel::DrawbarPull),
                torque_nm: value(Channel::Torque),
                sinkage_m: value(Channel::Sinkage),
                model: ModelState::at(&campaign.wheel, &soil, slip, load_n),
            })
        };
        Self { soil, rows: campaign.sound_rows().filter_map(row).collect() }
    }

    /// Over all rows.
    pub fn rms(&self) -> LeftOver {
        LeftOver::rms(self.rows.iter().map(ModelRow::left_over))
    }

    /// By how much the equations would say something else, over all rows, were the soil that is known another by as much as its standard
    /// deviations say: each number by itself, their squares together.
    pub fn uncertainty(&self, campaign: &Campaign) -> LeftOver {
        let moved = moved_soils(campaign).into_iter().map(|soil| {
            let other = Self::with(campaign, soil);
            LeftOver::rms(self.rows.iter().zip(&other.rows).map(|(row, other)| row.less(other.model.as_ref())))
        });
        moved.reduce(LeftOver::hypot).unwrap_or_default()
    }
}

impl ModelRow {
    /// Measured less computed.
    pub fn left_over(&self) -> LeftOver {
        let less =
            |measured: Option<f64>, computed: fn(&ModelState) -> f64| Some(measured? - computed(self.model.as_ref()?));
        LeftOver {
            drawbar_pull_n: less(self.drawbar_pull_n, |model| model.drawbar_pull_n),
            torque_nm: less(self.torque_nm, |model| model.torque_nm),
            sinkage_m: less(self.sinkage_m, |model| model.sinkage_m),
        }
    }

    /// Computed less what is computed with another soil, of the channels that were measured.
    fn less(&self, other: Option<&ModelState>) -> LeftOver {
        let as_measured = Self {
            drawbar_pull_n: self.drawbar_pull_n.and(self.model.map(|model| model.drawbar_pull_n)),
            torque_nm: self.torque_nm.and(self.model.map(|model| model.torque_nm)),
            sinkage_m: self.sinkage_m.and(self.model.map(|model| model.sinkage_m)),
            model: other.copied(),
            ..*self
        };
        as_measured.left_over()
    }
}

impl LeftOver {
    fn rms(all: impl Iterator<Item = Self>) -> Self {
        let all: Vec<Self> = all.collect();
        let over = |of: fn(&Self) -> Option<f64>| {
            Some(root_mean_square(all.iter().filter_map(of))).filter(|rms| !rms.is_nan())
        };
        Self {
            drawbar_pull_n: over(|row| row.drawbar_pull_n),
            torque_nm: over(|row| row.torque_nm),
            sinkage_m: over(|row| row.sinkage_m),
        }
    }

    /// The root of the sum of squares; what is not known is nothing.
    fn hypot(self, other: Self) -> Self {
        let both = |one: Option<f64>, other: Option<f64>| match (one, other) {
            (Some(one), Some(other)) => Some(one.hypot(other)),
            _ => one.or(other),
        };
        Self {
            drawbar_pull_n: both(self.drawbar_pull_n, other.drawbar_pull_n),
            torque_nm: both(self.torque_nm, other.torque_nm),
            sinkage_m: both(self.sinkage_m, other.sinkage_m),
        }
    }

    /// In N, N·m and mm; a dash for what is not known.
    pub fn cells(&self, signed: bool) -> [String; 3] {
        let shown =
            |value: Option<f64>, digits| value.map_or_else(|| "–".to_owned(), |value| number(value, digits, signed));
        [shown(self.drawbar_pull_n, 1), shown(self.torque_nm, 2), shown(self.sinkage_m.map(|z| 1e3 * z), 1)]
    }
}

impl ModelState {
    /// None where the soil does not carry the load.
    pub fn at(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, load_n: f64) -> Option<Self> {
        let WheelState { drawbar_pull_n, torque_nm, sinkage_m, .. } =
            WheelState::under_load(wheel, soil, slip, load_n).ok()?;
        Some(Self { drawbar_pull_n, torque_nm, sinkage_m: sinkage_m? })
    }
}

/// The soil of the equations from what other means have measured. Where the stress peaks is rarely known: the middle of
/// what the networks were trained with, then.
fn known_soil(campaign: &Campaign) -> Option<Soil<f64>> {
    let (ground, wheel) = (&campaign.ground, &campaign.wheel);
    let needed = [
        ground.sinkage_exponent,
        ground.stiffness(wheel),
        ground.cohesion_pa,
        ground.friction_angle_rad,
        ground.shear_modulus_m,
    ];
    needed.iter().all(Option::is_some).then(|| ground.middle(wheel))
}

/// The known soil, with each number that is known to a standard deviation greater by that.
fn moved_soils(campaign: &Campaign) -> Vec<Soil<f64>> {
    type Place = fn(&mut Soil<f64>) -> &mut f64;
    let (ground, wheel) = (&campaign.ground, &campaign.wheel);
    let numbers: [(Option<Knowledge>, Place); 8] = [
        (ground.sinkage_exponent, |soil| &mut soil.sinkage_exponent),
        (ground.stiffness(wheel), |soil| &mut soil.frictional_modulus),
        (ground.cohesion_pa, |soil| &mut soil.cohesion_pa),
        (ground.friction_angle_rad, |soil| &mut soil.friction_angle_rad),
        (ground.shear_modulus_m, |soil| &mut soil.shear_modulus_m),
        (ground.peak_stress_c1, |soil| &mut soil.peak_stress_c1),
        (ground.peak_stress_c2, |soil| &mut soil.peak_stress_c2),
        (ground.rebound_ratio, |soil| &mut soil.rebound_ratio),
    ];
    let moved = |(known, place): (Option<Knowledge>, Place)| {
        let std = known.map(Knowledge::std).filter(|std| *std > 0.0)?;
        let mut soil = ground.middle(wheel);
        *place(&mut soil) += std;
        Some(soil)
    };
    numbers.into_iter().filter_map(moved).collect()
}
