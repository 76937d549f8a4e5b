//! What acts on the rover beside the wheel–soil equations: by id, with a value.
//!
//! Effects are those of the library. On soil and contact they act as there. On sensors they act where the rover has the
//! channel: a load cell is the load, the force along its link the pull that leaks into it, the drive torque the torque. An
//! attitude that is misaligned tilts accelerometer and gyro; a wrong rolling radius makes the wheels turn otherwise. What
//! has no channel on the rover means nothing here, and is refused.

use std::ops::RangeInclusive;

use kapvik_firmware::terramechanics::effects::{CATALOGUE, EffectInfo, Effects, Form, ParameterInfo, effect_info};
use thiserror::Error;

use crate::digits::spaced_unit;

/// Effects on soil, sensors and drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoverEffects {
    /// Those of the library.
    pub library: Effects<f64>,
    /// By how much the wheels' radius exceeds that of the rover file, m.
    pub rolling_radius_m: f64,
    /// Gain error of the velocimeter.
    pub velocity_scale: f64,
    /// How late the velocimeter is, s.
    pub latency_s: f64,
    /// The share of its speed by which each wheel slowly departs from its command; none: as the scenario draws it.
    pub rim_wander: Option<f64>,
}

/// An effect of the library with a parameter of it, or one that the rover has beside these, without.
pub type Part = (&'static str, Option<&'static str>);

/// An effect that the rover has beside those of the library, or by a name of its own.
struct OwnEffect {
    id: &'static str,
    part: Part,
    place: fn(&mut RoverEffects, f64),
    range: RangeInclusive<f64>,
}

const OWN: [OwnEffect; 5] = [
    OwnEffect {
        id: "drive-viscosity",
        part: ("drive-friction", Some("viscous_nm_s")),
        place: |e, value| _ = e.library.set("drive-friction", "viscous_nm_s", value),
        range: -100.0..=100.0,
    },
    OwnEffect {
        id: "rolling-radius",
        part: ("rolling-radius", None),
        place: |e, value| e.rolling_radius_m = value,
        range: -0.02..=0.1,
    },
    OwnEffect {
        id: "velocity-scale",
        part: ("velocity-scale", None),
        place: |e, value| e.velocity_scale = value,
        range: -0.5..=1.0,
    },
    OwnEffect { id: "latency", part: ("latency", None), place: |e, value| e.latency_s = value, range: 0.0..=10.0 },
    OwnEffect {
        id: "rim-wander",
        part: ("rim-wander", None),
        place: |e, value| e.rim_wander = Some(value),
        range: 0.0..=0.5,
    },
];

impl Default for RoverEffects {
    fn default() -> Self {
        Self { library: Effects::none(), rolling_radius_m: 0.0, velocity_scale: 0.0, latency_s: 0.0, rim_wander: None }
    }
}

/// Why an effect is not set.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum EffectError {
    /// None has this id.
    #[error("no effect is named `{0}`: expected one of {known}", known = known())]
    Unknown(String),
    /// It has no such parameter, means nothing on a rover, or cannot have this value.
    #[error("{0}")]
    Refused(String),
}

impl RoverEffects {
    /// One effect alone, as of [`Self::set`].
    ///
    /// # Errors
    /// Those of [`Self::set`].
    pub fn only(name: &str, value: f64) -> Result<Self, EffectError> {
        let mut effects = Self::default();
        effects.set(name, value)?;
        Ok(effects)
    }

    /// Sets an effect: by its id, which stands for the first free parameter of its first form that shows on a rover, or by
    /// `ID.PARAMETER`.
    ///
    /// # Errors
    /// What is wrong with the name or the value: there is no such effect or parameter, it means nothing on a rover, or the value is outside
    /// its bounds, which those of sensors do not have.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), EffectError> {
        match Named::find(name)? {
            Named::Own(OwnEffect { range, .. }) if !range.contains(&value) => {
                refused(format!("{value}: expected {} to {}", range.start(), range.end()))
            }
            Named::Own(own) => {
                (own.place)(self, value);
                Ok(())
            }
            Named::OfLibrary { info, about, .. } if !info.any_size && !(about.low..=about.high).contains(&value) => {
                let (name, unit) = (about.name, spaced_unit(about.unit));
                refused(format!("{name} = {value}: expected {} to {}{unit}", about.low, about.high))
            }
            Named::OfLibrary { info, about, beside } => {
                for (name, value) in beside.iter().chain([&(about.name, value)]) {
                    self.library.set(info.id, name, *value);
                }
                Ok(())
            }
        }
    }

    /// Whether a name is one that [`Self::set`] takes a value for.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check_name(name: &str) -> Result<(), EffectError> {
        Named::find(name).map(|_| ())
    }

    /// What [`Self::set`] sets by a name; nothing by one that it refuses.
    pub fn parts(name: &str) -> Vec<Part> {
        if let Some(own) = OWN.iter().find(|own| own.id == name) {
            return vec![own.part];
        }
        let (id, parameter) = id_and_parameter(name);
        let Some(info) = effect_info(id) else { return Vec::new() };
        let parameters: Vec<&str> = match (parameter, form_on_a_rover(info)) {
            (Some(parameter), _) => info.parameter(parameter).map(|about| about.name).into_iter().collect(),
            (None, Some(form)) => form.set.iter().map(|(name, _)| *name).chain(form.free.first().copied()).collect(),
            (None, None) => Vec::new(),
        };
        parameters.into_iter().map(|parameter| (info.id, Some(parameter))).collect()
    }
}

/// What a name stands for.
enum Named {
    Own(&'static OwnEffect),
    OfLibrary {
        info: &'static EffectInfo,
        /// What gets the value.
        about: &'static ParameterInfo,
        /// What else its form sets.
        beside: &'static [(&'static str, f64)],
    },
}

impl Named {
    fn find(name: &str) -> Result<Self, EffectError> {
        if let Some(own) = OWN.iter().find(|own| own.id == name) {
            return Ok(Self::Own(own));
        }
        let (id, parameter) = id_and_parameter(name);
        let info = effect_info(id).ok_or_else(|| EffectError::Unknown(id.to_owned()))?;
        let (parameter, beside) = match parameter {
            Some(parameter) => (parameter, &[][..]),
            None => {
                let form = shown_form(info)?;
                let first = form.free.first().copied();
                (first.ok_or_else(|| EffectError::Refused(format!("{id} has nothing to set")))?, form.set)
            }
        };
        let Some(about) = info.parameter(parameter) else {
            let names: Vec<_> = info.parameters.iter().map(|parameter| parameter.name).collect();
            return refused(format!("{id} has no parameter `{parameter}`: expected {}", names.join(", ")));
        };
        match lacks(id, parameter) {
            Some(reason) => refused(format!("{name} means nothing on a rover: {reason}. What does: {}", known())),
            None => Ok(Self::OfLibrary { info, about, beside }),
        }
    }
}

/// The first form that shows on a rover.
fn shown_form(info: &'static EffectInfo) -> Result<&'static Form, EffectError> {
    form_on_a_rover(info).ok_or_else(|| {
        let reason = info.parameters.iter().find_map(|parameter| lacks(info.id, parameter.name));
        let reason = reason.unwrap_or("it has no form");
        EffectError::Refused(format!("{} means nothing on a rover: {reason}. What does: {}", info.id, known()))
    })
}

/// The two halves of ID.PARAMETER, of which there may be the first alone.
fn id_and_parameter(name: &str) -> (&str, Option<&str>) {
    name.split_once('.').map_or((name, None), |(id, parameter)| (id, Some(parameter)))
}

fn refused<T>(reason: String) -> Result<T, EffectError> {
    Err(EffectError::Refused(reason))
}

/// The first form of an effect whose parameters all mean something on a rover.
fn form_on_a_rover(info: &'static EffectInfo) -> Option<&'static Form> {
    info.forms.iter().find(|form| form.free.iter().all(|parameter| lacks(info.id, parameter).is_none()))
}

/// The ids that can be set, in a list for people.
pub fn known() -> String {
    let library = CATALOGUE.iter().filter(|info| form_on_a_rover(info).is_some()).map(|info| info.id);
    let own = OWN.iter().map(|own| own.id).filter(|id| effect_info(id).is_none());
    library.chain(own).collect::<Vec<_>>().join(", ")
}

/// Why a parameter means nothing on a rover; none where it does something.
fn lacks(id: &str, parameter: &str) -> Option<&'static str> {
    const SINKAGE: &str = "it has no sensor of the sinkage";
    const PULL: &str = "it has no sensor of the drawbar pull, only of the load";
    const SIDE: &str = "it has no sensor of the side force, only of the load";
    match (id, parameter) {
        ("sinkage-lag" | "sinkage-reference", _) => Some(SINKAGE),
        ("slip-sinkage", "apparent") | ("grouser-ripple", "sinkage_sin_m" | "sinkage_cos_m") => Some(SINKAGE),
        ("lateral-slip", _) => Some("it holds its heading and its track, so that no wheel has a slip angle"),
        ("force-drift", "drawbar_pull_n_per_c" | "load_n_per_c" | "side_force_n_per_c" | "reference_c") => {
            Some("the simulation knows no temperature")
        }
        ("force-bias", "drawbar_pull_n") | ("force-drift", "drawbar_pull_n_per_h") => Some(PULL),
        ("grouser-ripple", "drawbar_pull_sin_n" | "drawbar_pull_cos_n") => Some(PULL),
        ("crosstalk", "load_to_drawbar_pull" | "side_force_to_drawbar_pull" | "torque_to_drawbar_pull_per_m") => {
            Some(PULL)
        }
        ("pitch-misalignment", "own_weight_n") => Some(PULL),
        ("force-bias", "side_force_n") | ("force-drift", "side_force_n_per_h") => Some(SIDE),
        ("crosstalk", "drawbar_pull_to_side_force" | "load_to_side_force") => Some(SIDE),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_effect_is_set_or_refused_for_a_reason() {
        for info in CATALOGUE {
            let mut effects = RoverEffects::default();
            let said = effects.set(info.id, 0.1);
            let refused = ["lateral-slip", "sinkage-lag", "sinkage-reference"].contains(&info.id);
            assert_eq!(said.is_err(), refused, "{}: {said:?}", info.id);
        }
    }

    #[test]
    fn an_id_stands_for_the_form_that_a_rover_shows() {
        let mut effects = RoverEffects::default();
        for (id, value) in [("force-bias", 2.0), ("force-drift", 720.0), ("shear-hump", 0.6), ("drive-viscosity", 0.5)]
        {
            effects.set(id, value).expect("a value");
        }
        let get = |id, parameter| effects.library.get(id, parameter);
        assert_eq!(get("force-bias", "load_n"), Some(2.0));
        assert_eq!(get("force-bias", "drawbar_pull_n"), Some(0.0));
        assert_eq!(get("force-drift", "load_n_per_h"), Some(720.0));
        assert_eq!(get("shear-hump", "share"), Some(1.0), "what the form has set");
        assert_eq!(get("drive-friction", "viscous_nm_s"), Some(0.5));
    }

    #[test]
    fn what_is_refused_sets_nothing() {
        let mut effects = RoverEffects::default();
        assert!(effects.set("shear-hump", 99.0).is_err());
        assert_eq!(effects, RoverEffects::default());
    }

    /// Whatever a name changes is among its parts, and those of another id are others.
    #[test]
    fn parts_are_what_is_set() {
        let parts = RoverEffects::parts;
        assert_eq!(parts("slip-sinkage"), parts("slip-sinkage.n1"));
        assert_eq!(parts("drive-viscosity"), parts("drive-friction.viscous_nm_s"));
        assert!(parts("shear-hump").contains(&parts("shear-hump.share")[0]));
        assert_eq!(parts("latency"), [("latency", None)]);
        assert_eq!([parts("slip-sinking"), parts("slip-sinkage.n2"), parts("lateral-slip")], [const { Vec::new() }; 3]);
        for info in CATALOGUE {
            let mut before = RoverEffects::default();
            for parameter in info.parameters {
                before.library.set(info.id, parameter.name, 0.123);
            }
            let mut effects = before;
            if OWN.iter().any(|own| own.id == info.id) || effects.set(info.id, 0.1).is_err() {
                continue;
            }
            let value = |effects: &RoverEffects, name: &str| effects.library.get(info.id, name);
            let parts = parts(info.id);
            for name in info.parameters.iter().map(|parameter| parameter.name) {
                let is_set = value(&effects, name) != value(&before, name);
                assert!(!is_set || parts.contains(&(info.id, Some(name))), "{}.{name}: {parts:?}", info.id);
            }
        }
    }

    #[test]
    fn what_is_refused_says_why() {
        let mut effects = RoverEffects::default();
        for (name, value, words) in [
            ("slip-sinking", 0.3, "no effect is named `slip-sinking`: expected one of slip-sinkage"),
            ("slip-sinkage.n2", 0.3, "no parameter `n2`: expected n1, saturation"),
            ("slip-sinkage", 30.0, "n1 = 30: expected -0.5 to 2"),
            ("slip-sinkage.apparent", 0.3, "no sensor of the sinkage"),
            ("force-drift.load_n_per_c", 0.3, "no temperature"),
            ("crosstalk.torque_to_drawbar_pull_per_m", 0.3, "no sensor of the drawbar pull"),
            ("pitch-misalignment.own_weight_n", 3.0, "no sensor of the drawbar pull"),
        ] {
            let said = effects.set(name, value).expect_err(name).to_string();
            assert!(said.contains(words), "{name}: {said}");
        }
        assert_eq!(effects, RoverEffects::default());
    }
}
