//! A wheel on a soil with effects: true forces, and what the sensors read.

use crate::scalar::Scalar;

use super::effects::{Circumstances, Conditions, Effects, Grousers};
use super::forces::check;
use super::integrals::{Integrals, Place, integrate};
use super::normal_stress::NormalStress;
use super::quadrature::Quadrature;
use super::shear_displacement::ShearDisplacement;
use super::shear_law::{AlteredShear, PlainShear, ShearConditions};
use super::shear_stress::{Mobilisation, Strength};
use super::sinkage::LoadCurve;
use super::{Contact, ForceError, SinkageError, Soil, Wheel};

/// A wheel on a soil with effects. The soil's parameters are those of equations 1–11; the effects act on top.
#[derive(Debug, Clone, Copy)]
pub struct WheelOnSoil<'a, S> {
    /// The wheel.
    pub wheel: &'a Wheel<S>,
    /// Its grousers, which act only through an effect.
    pub grousers: &'a Grousers<S>,
    /// The soil.
    pub soil: &'a Soil<S>,
    /// What acts beside equations 1–11.
    pub effects: &'a Effects<S>,
    /// Gravity, m/s².
    pub gravity_m_s2: S,
    /// How the contact is integrated.
    pub quadrature: Quadrature,
}

/// The true state of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelTruth<S> {
    /// Slip, −1 … 1.
    pub slip: S,
    /// Normal load, N.
    pub load_n: S,
    /// Drawbar pull, N.
    pub drawbar_pull_n: S,
    /// Resistive torque, N·m.
    pub torque_nm: S,
    /// Sinkage, m.
    pub sinkage_m: S,
    /// Side force, N, positive to the side of a positive slip angle.
    pub side_force_n: S,
}

/// What the sensors of a wheel read, in the units of [`WheelTruth`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Readings<S> {
    /// Slip.
    pub slip: S,
    /// Normal load, N.
    pub load_n: S,
    /// Drawbar pull, N.
    pub drawbar_pull_n: S,
    /// Torque, N·m.
    pub torque_nm: S,
    /// Sinkage, m.
    pub sinkage_m: S,
    /// Side force, N.
    pub side_force_n: S,
}

/// What a run carries from one row to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Memory<S> {
    /// The last lagging sinkage, m, and the travel at which it was, m.
    pub lagging: Option<(S, S)>,
}

impl<S> Memory<S> {
    /// At the start of a run.
    pub const fn start() -> Self {
        Self { lagging: None }
    }
}

impl<S: Scalar> WheelOnSoil<'_, S> {
    /// The true state at a slip (−1 … 1) and a sinkage (m, 0 … r). `load_n` is the load that effects of the load see; the
    /// load of the state is what the stresses give.
    ///
    /// # Errors
    /// As [`super::wheel_forces`].
    pub fn forces(
        &self,
        conditions: &Conditions<S>,
        slip: S,
        load_n: S,
        sinkage_m: S,
    ) -> Result<WheelTruth<S>, ForceError> {
        check(self.wheel, self.soil, slip, sinkage_m)?;
        let at = self.circumstances(conditions, slip, load_n);
        let soil = self.effects.soil(&at);
        if !soil.is_valid() {
            return Err(ForceError::Soil);
        }
        let mut contact = Contact::free(self.wheel, &soil, slip, sinkage_m);
        self.effects.contact(&mut contact, &at);
        let contact = contact.held();
        let found = self.integrals(&soil, &contact, slip, self.effects.shear(&at));
        let area = self.wheel.radius_m * self.wheel.width_m;
        let mut truth = WheelTruth {
            slip,
            load_n: area * found.load,
            drawbar_pull_n: area * found.pull,
            torque_nm: area * self.wheel.radius_m * found.torque,
            sinkage_m,
            side_force_n: area * found.side,
        };
        self.effects.resist(&mut truth, &contact, &at);
        if truth.is_finite() { Ok(truth) } else { Err(ForceError::Overflow) }
    }

    /// The true state of a wheel that carries `load_n` at a slip: the smallest sinkage at which the soil does.
    ///
    /// # Errors
    /// As [`super::sinkage_for_load`].
    pub fn at_load(&self, conditions: &Conditions<S>, slip: S, load_n: S) -> Result<WheelTruth<S>, SinkageError> {
        let soil = self.effects.soil(&self.circumstances(conditions, slip, load_n));
        let curve = LoadCurve::new(self.wheel, &soil, |sinkage_m| {
            self.forces(conditions, slip, load_n, sinkage_m).map(|truth| truth.load_n)
        });
        let sinkage_m = curve.sinkage_for(load_n)?;
        self.forces(conditions, slip, load_n, sinkage_m).map_err(|_| SinkageError::Input)
    }

    /// What the sensors read of a true state, without noise. `memory` goes along a run from row to row.
    pub fn readings(&self, conditions: &Conditions<S>, truth: &WheelTruth<S>, memory: &mut Memory<S>) -> Readings<S> {
        let mut readings = Readings::of(truth);
        let at = self.circumstances(conditions, truth.slip, truth.load_n);
        self.effects.read(&mut readings, truth, &at, memory);
        readings
    }

    fn circumstances<'b>(&'b self, conditions: &'b Conditions<S>, slip: S, load_n: S) -> Circumstances<'b, S> {
        Circumstances {
            wheel: self.wheel,
            grousers: self.grousers,
            soil: self.soil,
            conditions,
            slip,
            load_n,
            gravity_m_s2: self.gravity_m_s2,
        }
    }

    fn integrals(&self, soil: &Soil<S>, contact: &Contact<S>, slip: S, conditions: ShearConditions<S>) -> Integrals<S> {
        let displacement = ShearDisplacement::new(slip);
        let shear_radius_m = conditions.radius_ratio.map_or(self.wheel.radius_m, |ratio| self.wheel.radius_m * ratio);
        let mobilisation = Mobilisation::new(soil, shear_radius_m, &displacement);
        let place = Place {
            contact,
            normal: &NormalStress::new(self.wheel, soil),
            displacement: &displacement,
            strength: &Strength::new(soil, conditions.cap),
            layer: mobilisation.scale,
        };
        if conditions.is_plain() {
            integrate(&self.quadrature, &place, &PlainShear { mobilisation })
        } else {
            let law = AlteredShear::new(&displacement, mobilisation, &conditions, contact);
            integrate(&self.quadrature, &place, &law)
        }
    }
}

impl<S: Scalar> WheelTruth<S> {
    fn is_finite(&self) -> bool {
        [self.load_n, self.drawbar_pull_n, self.torque_nm, self.side_force_n].iter().all(|force| force.is_finite())
    }
}

impl<S: Scalar> Readings<S> {
    /// What faultless sensors read.
    pub fn of(truth: &WheelTruth<S>) -> Self {
        Self {
            slip: truth.slip,
            load_n: truth.load_n,
            drawbar_pull_n: truth.drawbar_pull_n,
            torque_nm: truth.torque_nm,
            sinkage_m: truth.sinkage_m,
            side_force_n: truth.side_force_n,
        }
    }
}
