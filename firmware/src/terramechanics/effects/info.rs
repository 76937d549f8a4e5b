//! What is known of an effect without an example of it: its parameters, and the forms in which it may come.

/// A parameter of an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterInfo {
    /// Its name, as data files and reports have it.
    pub name: &'static str,
    /// Its unit; `-` where it has none.
    pub unit: &'static str,
    /// The value at which it changes nothing.
    pub neutral: f64,
    /// The least value that makes sense.
    pub low: f64,
    /// The greatest value that makes sense.
    pub high: f64,
    /// A size that one may expect: where a search for it starts.
    pub typical: f64,
    /// What it says of its effect.
    pub role: Role,
}

/// What a parameter says of its effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// How large the effect is.
    Size,
    /// How its law bends. Beforehand one expects that it does so little: neutral, give or take what is typical.
    Shape,
}

/// One way in which an effect may come: the parameters that are free in it, and what is fixed beforehand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    /// Its name within the effect.
    pub name: &'static str,
    /// The parameters that are free, by name.
    pub free: &'static [&'static str],
    /// Parameters that are not neutral in this form, and their values.
    pub set: &'static [(&'static str, f64)],
    /// What has to be known of a wheel or a row for this form to show.
    pub needs: &'static [Column],
}

impl Form {
    /// Whether it frees or sets a parameter.
    pub fn has(&self, parameter: &str) -> bool {
        self.free.contains(&parameter) || self.set.iter().any(|(set, _)| *set == parameter)
    }
}

/// What a form of an effect needs to know.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// The drawbar pull.
    DrawbarPull,
    /// The normal load.
    Load,
    /// The torque.
    Torque,
    /// The sinkage.
    Sinkage,
    /// The side force.
    SideForce,
    /// The slip angle.
    SlipAngle,
    /// The rate of the wheel, or its speed over the ground, from which it follows.
    WheelRate,
    /// The speed over the ground, or the rate of the wheel, from which it follows.
    Speed,
    /// The angle by which the wheel has turned.
    WheelAngle,
    /// Which pass over the same ground it is.
    Pass,
    /// The temperature.
    Temperature,
    /// The time since the force sensors were zeroed.
    HoursSinceZero,
    /// The way travelled.
    Travel,
    /// The pitch of rig or rover.
    Pitch,
    /// A wheel that has grousers.
    Grousers,
}

/// What an effect does by one of its parameters, in a few words: another thing where that is below neutral than where it is above.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Words {
    /// The parameter, by name.
    pub parameter: &'static str,
    /// Above neutral.
    pub above: &'static str,
    /// Below neutral.
    pub below: &'static str,
}

/// An effect: its id, its parameters and its forms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffectInfo {
    /// The id by which files and reports name it.
    pub id: &'static str,
    /// What it does, in a few words that hold whatever its parameters are where there are no others.
    pub summary: &'static str,
    /// What it does by each parameter of which that depends.
    pub words: &'static [Words],
    /// A measurement that shows it apart from others.
    pub test: &'static str,
    /// Its parameters.
    pub parameters: &'static [ParameterInfo],
    /// Its forms.
    pub forms: &'static [Form],
    /// Whether it may be of any size, as offsets and gains of sensors may: the bounds of its parameters are where to look for it, then.
    pub any_size: bool,
}

impl EffectInfo {
    /// The parameter of that name.
    pub fn parameter(&self, name: &str) -> Option<&'static ParameterInfo> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }
}

/// Says what an effect's parameters are, once: its struct, its neutral values, and access by name.
///
/// `about` goes before what is typical of a size, `shape` before what is typical of a shape.
macro_rules! effect_parameters {
    (@role about) => { $crate::terramechanics::effects::Role::Size };
    (@role shape) => { $crate::terramechanics::effects::Role::Shape };
    (
        $(#[$about:meta])*
        pub struct $effect:ident {
            $( $(#[$doc:meta])* $field:ident: $name:literal [$unit:literal] = $neutral:literal, $low:literal to $high:literal, $role:ident $typical:literal; )+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $effect<S> {
            $( $(#[$doc])* pub $field: S, )+
        }

        impl<S: $crate::scalar::Scalar> $crate::terramechanics::effects::Parameters<S> for $effect<S> {
            const PARAMETERS: &'static [$crate::terramechanics::effects::ParameterInfo] = &[
                $( $crate::terramechanics::effects::ParameterInfo {
                    name: $name,
                    unit: $unit,
                    neutral: $neutral,
                    low: $low,
                    high: $high,
                    typical: $typical,
                    role: $crate::terramechanics::effects::info::effect_parameters!(@role $role),
                }, )+
            ];

            fn neutral() -> Self {
                Self { $( $field: S::constant($neutral), )+ }
            }

            fn parameter(&self, name: &str) -> Option<S> {
                $( if name == $name { return Some(self.$field); } )+
                None
            }

            fn parameter_mut(&mut self, name: &str) -> Option<&mut S> {
                $( if name == $name { return Some(&mut self.$field); } )+
                None
            }
        }

        impl<S> $effect<S> {
            /// The same effect in another scalar.
            pub fn map<T>(self, convert: impl Fn(S) -> T) -> $effect<T> {
                $effect { $( $field: convert(self.$field), )+ }
            }
        }
    };
}

pub(super) use effect_parameters;
