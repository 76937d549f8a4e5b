//! What the seed's equations lack: effects as values.
//!
//! Each effect is a small type with its equation, its parameters and what it touches: the soil, the contact, the shear
//! stress, the forces, or what a sensor reads. [`Effects::none`] is the seed's model, bit for bit. The same code simulates an
//! effect, fits it and trains with it. To add one, add its file and its line in the list below.

mod conditions;
mod info;
mod saturation;

mod bulldozing;
mod crosstalk;
mod drive_friction;
mod force_bias;
mod force_drift;
mod grouser_ripple;
mod grouser_thrust;
mod guide_friction;
mod interface_friction;
mod lateral_slip;
mod load_stiffening;
mod multi_pass;
mod peak_stress_shift;
mod pitch_misalignment;
mod rate;
mod rear_contact;
mod rolling_radius;
mod shear_hump;
mod sinkage_lag;
mod sinkage_reference;
mod slip_sinkage;
mod torque_scale;

use crate::scalar::Scalar;

use super::shear_law::{Hump, ShearConditions};
use super::shear_stress::Cap;
use super::wheel_on_soil::{Memory, Readings, WheelTruth};
use super::{Contact, Soil};

pub use bulldozing::Bulldozing;
pub use conditions::{Circumstances, Conditions, Grousers, speed_ratio};
pub use crosstalk::Crosstalk;
pub use drive_friction::DriveFriction;
pub use force_bias::ForceBias;
pub use force_drift::ForceDrift;
pub use grouser_ripple::GrouserRipple;
pub use grouser_thrust::GrouserThrust;
pub use guide_friction::GuideFriction;
pub use info::{Column, EffectInfo, Form, ParameterInfo, Role, Words};
pub use interface_friction::InterfaceFriction;
pub use lateral_slip::LateralSlip;
pub use load_stiffening::LoadStiffening;
pub use multi_pass::MultiPass;
pub use peak_stress_shift::PeakStressShift;
pub use pitch_misalignment::PitchMisalignment;
pub use rate::Rate;
pub use rear_contact::RearContact;
pub use rolling_radius::RollingRadius;
pub use shear_hump::ShearHump;
pub use sinkage_lag::SinkageLag;
pub use sinkage_reference::SinkageReference;
pub use slip_sinkage::SlipSinkage;
pub use torque_scale::TorqueScale;

/// The parameters of an effect, by name.
pub trait Parameters<S>: Sized {
    /// What they are.
    const PARAMETERS: &'static [ParameterInfo];
    /// The effect that changes nothing.
    fn neutral() -> Self;
    /// The value of a parameter.
    fn parameter(&self, name: &str) -> Option<S>;
    /// The place of a parameter.
    fn parameter_mut(&mut self, name: &str) -> Option<&mut S>;
}

/// An effect: where it acts. What it does not touch, it leaves as it is.
pub trait Effect<S: Scalar>: Parameters<S> {
    /// The id by which files and reports name it.
    const ID: &'static str;
    /// What it does, in a few words that hold whatever its parameters are where there are no others.
    const SUMMARY: &'static str;
    /// What it does by each parameter of which that depends.
    const WORDS: &'static [Words] = &[];
    /// A measurement that shows it apart from others.
    const TEST: &'static str;
    /// The forms in which it may come.
    const FORMS: &'static [Form];
    /// Whether it may be of any size, as offsets and gains of sensors may: the bounds of its parameters are where to look for it, then.
    const ANY_SIZE: bool = false;
    /// Whether what it does follows the load of the wheel.
    const FOLLOWS_LOAD: bool = false;

    /// Changes the soil that this wheel meets at this instant.
    fn soil(&self, _soil: &mut Soil<S>, _at: &Circumstances<'_, S>) {}
    /// Moves the contact angles. The peak may be outside the contact, where equation 10 puts it, and is held inside afterwards.
    fn contact(&self, _contact: &mut Contact<S>, _at: &Circumstances<'_, S>) {}
    /// Changes how the soil shears on the rim.
    fn shear(&self, _shear: &mut ShearConditions<S>, _at: &Circumstances<'_, S>) {}
    /// Adds forces beside those on the rim.
    fn resist(&self, _truth: &mut WheelTruth<S>, _contact: &Contact<S>, _at: &Circumstances<'_, S>) {}
    /// Changes what the sensors read.
    fn read(
        &self,
        _readings: &mut Readings<S>,
        _truth: &WheelTruth<S>,
        _at: &Circumstances<'_, S>,
        _memory: &mut Memory<S>,
    ) {
    }
}

/// Makes the set of effects from the list of their types. They act in the list's order.
macro_rules! effects {
    ($( $field:ident: $effect:ident, )+) => {
        /// A set of effects, each there or not.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct Effects<S> {
            $( #[doc = concat!("[`", stringify!($effect), "`]")] pub $field: Option<$effect<S>>, )+
        }

        /// Every effect that there is.
        pub const CATALOGUE: &[EffectInfo] = &[
            $( EffectInfo {
                id: <$effect<f64> as Effect<f64>>::ID,
                summary: <$effect<f64> as Effect<f64>>::SUMMARY,
                words: <$effect<f64> as Effect<f64>>::WORDS,
                test: <$effect<f64> as Effect<f64>>::TEST,
                parameters: <$effect<f64> as Parameters<f64>>::PARAMETERS,
                forms: <$effect<f64> as Effect<f64>>::FORMS,
                any_size: <$effect<f64> as Effect<f64>>::ANY_SIZE,
            }, )+
        ];

        impl<S: Scalar> Effects<S> {
            /// No effect: the seed's equations 1–11.
            pub fn none() -> Self {
                Self { $( $field: None, )+ }
            }

            /// Whether what any of them does follows the load of the wheel.
            pub fn follow_load(&self) -> bool {
                [$( self.$field.is_some() && <$effect<S> as Effect<S>>::FOLLOWS_LOAD, )+].contains(&true)
            }

            /// The value of a parameter of an effect that is there.
            pub fn get(&self, id: &str, parameter: &str) -> Option<S> {
                $( if id == <$effect<S> as Effect<S>>::ID {
                    return self.$field.as_ref()?.parameter(parameter);
                } )+
                None
            }

            /// Puts an effect in with all its parameters neutral, where it is not there yet; false where there is no such effect.
            pub fn add(&mut self, id: &str) -> bool {
                $( if id == <$effect<S> as Effect<S>>::ID {
                    self.$field.get_or_insert_with($effect::neutral);
                    return true;
                } )+
                false
            }

            /// Sets a parameter, and puts its effect in where it is not there yet; false where there is no such effect or parameter.
            pub fn set(&mut self, id: &str, parameter: &str, value: S) -> bool {
                $( if id == <$effect<S> as Effect<S>>::ID {
                    let effect = self.$field.get_or_insert_with($effect::neutral);
                    return effect.parameter_mut(parameter).map(|place| *place = value).is_some();
                } )+
                false
            }

            /// The ids of the effects that are there.
            pub fn ids(&self) -> impl Iterator<Item = &'static str> {
                [ $( self.$field.as_ref().map(|_| <$effect<S> as Effect<S>>::ID), )+ ].into_iter().flatten()
            }

            /// The same effects in another scalar.
            pub fn map<T>(self, convert: impl Fn(S) -> T + Copy) -> Effects<T> {
                Effects { $( $field: self.$field.map(|effect| effect.map(convert)), )+ }
            }

            /// The soil that this wheel meets at this instant.
            pub(super) fn soil(&self, at: &Circumstances<'_, S>) -> Soil<S> {
                let mut soil = *at.soil;
                $( if let Some(effect) = &self.$field { effect.soil(&mut soil, at); } )+
                soil
            }

            pub(super) fn contact(&self, contact: &mut Contact<S>, at: &Circumstances<'_, S>) {
                $( if let Some(effect) = &self.$field { effect.contact(contact, at); } )+
            }

            pub(super) fn shear(&self, at: &Circumstances<'_, S>) -> ShearConditions<S> {
                let mut shear = ShearConditions::plain();
                $( if let Some(effect) = &self.$field { effect.shear(&mut shear, at); } )+
                shear
            }

            pub(super) fn resist(&self, truth: &mut WheelTruth<S>, contact: &Contact<S>, at: &Circumstances<'_, S>) {
                $( if let Some(effect) = &self.$field { effect.resist(truth, contact, at); } )+
            }

            pub(super) fn read(
                &self,
                readings: &mut Readings<S>,
                truth: &WheelTruth<S>,
                at: &Circumstances<'_, S>,
                memory: &mut Memory<S>,
            ) {
                $( if let Some(effect) = &self.$field { effect.read(readings, truth, at, memory); } )+
            }
        }
    };
}

// Soil and contact first; then what reads them, from the mechanics to the sensor's own gain and offset.
effects! {
    slip_sinkage: SlipSinkage,
    multi_pass: MultiPass,
    load_stiffening: LoadStiffening,
    rate: Rate,
    grouser_ripple: GrouserRipple,
    rear_contact: RearContact,
    peak_stress_shift: PeakStressShift,
    grouser_thrust: GrouserThrust,
    lateral_slip: LateralSlip,
    interface_friction: InterfaceFriction,
    shear_hump: ShearHump,
    bulldozing: Bulldozing,
    sinkage_lag: SinkageLag,
    sinkage_reference: SinkageReference,
    pitch_misalignment: PitchMisalignment,
    guide_friction: GuideFriction,
    crosstalk: Crosstalk,
    drive_friction: DriveFriction,
    torque_scale: TorqueScale,
    force_bias: ForceBias,
    force_drift: ForceDrift,
    rolling_radius: RollingRadius,
}

/// The effect of that id.
pub fn effect_info(id: &str) -> Option<&'static EffectInfo> {
    CATALOGUE.iter().find(|effect| effect.id == id)
}
