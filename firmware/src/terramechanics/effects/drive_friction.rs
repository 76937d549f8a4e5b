//! Friction between motor and wheel.

use crate::scalar::Scalar;

use super::info::effect_parameters;
use super::{Circumstances, Column, Effect, Form, Memory, Readings, WheelTruth, Words};

effect_parameters! {
    /// The torque read at the drive contains friction that is not the soil's: T_c sgn ω + B ω + μ |T| sgn ω.
    pub struct DriveFriction {
        /// T_c, N·m at the wheel.
        coulomb_nm: "coulomb_nm" ["N m"] = 0.0, -50.0 to 50.0, about 0.2;
        /// B, N·m·s/rad at the wheel.
        viscous_nm_s: "viscous_nm_s" ["N m s"] = 0.0, -200.0 to 200.0, about 0.2;
        /// μ.
        proportional: "proportional" ["-"] = 0.0, 0.0 to 0.8, about 0.1;
    }
}

impl<S: Scalar> DriveFriction<S> {
    /// Friction of a drive that turns at a rate (rad/s) against a torque (N·m), N·m; none of one that stands.
    pub fn friction_nm(&self, rate_rad_s: S, torque_nm: S) -> S {
        let dry_nm = self.coulomb_nm + self.proportional * torque_nm.abs();
        let against = if rate_rad_s > S::zero() {
            dry_nm
        } else if rate_rad_s < S::zero() {
            -dry_nm
        } else {
            S::zero()
        };
        against + self.viscous_nm_s * rate_rad_s
    }
}

impl<S: Scalar> Effect<S> for DriveFriction<S> {
    const ID: &'static str = "drive-friction";
    const SUMMARY: &'static str = "the drive has friction of its own";
    const WORDS: &'static [Words] = &[
        Words {
            parameter: "coulomb_nm",
            above: "the drive has friction of its own",
            below: "the torque read lacks a constant part, as where too much friction of the drive was taken off",
        },
        Words {
            parameter: "viscous_nm_s",
            above: "the drive has friction of its own that grows with its rate",
            below: "the torque read is the less the faster the wheel turns",
        },
    ];
    const TEST: &'static str = "the torque of the wheel lifted off the ground, at several rates";
    const FORMS: &'static [Form] = &[
        Form { name: "Coulomb", free: &["coulomb_nm"], set: &[], needs: &[Column::Torque] },
        Form { name: "viscous", free: &["viscous_nm_s"], set: &[], needs: &[Column::Torque, Column::WheelRate] },
        Form {
            name: "Coulomb and viscous",
            free: &["coulomb_nm", "viscous_nm_s"],
            set: &[],
            needs: &[Column::Torque, Column::WheelRate],
        },
    ];
    const ANY_SIZE: bool = true;

    fn read(&self, readings: &mut Readings<S>, truth: &WheelTruth<S>, at: &Circumstances<'_, S>, _: &mut Memory<S>) {
        // A wheel of unknown rate turns forward, as the wheels of campaigns do; then only dry friction is known.
        let friction_nm = match at.wheel_rate_rad_s() {
            Some(rate_rad_s) => self.friction_nm(rate_rad_s, truth.torque_nm),
            None => self.coulomb_nm + self.proportional * truth.torque_nm.abs(),
        };
        readings.torque_nm += friction_nm;
    }
}
