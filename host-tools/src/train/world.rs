//! The world that scenes are drawn from: equations 1–11, and the effects that somebody declares beside them.

use std::fmt;

use kapvik_firmware::terramechanics::effects::{Effects, ParameterInfo};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::data::campaign::{Declared, DeclaredEffect, Knowledge};
use crate::digits::significant;

/// The effects that a world has, each with what is known of its parameters, and how often its ground is patchy. Without
/// either it is the seed's.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct World {
    effects: Vec<WorldEffect>,
    patchy_share: f64,
}

/// An effect of a world.
#[derive(Debug, Clone, PartialEq)]
struct WorldEffect {
    id: &'static str,
    /// The parameters that are not neutral.
    parameters: Vec<(&'static str, Spread)>,
}

/// How a parameter is spread over scenes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Spread {
    /// The same in all.
    Exactly(f64),
    /// A Gaussian, cut off at the parameter's bounds.
    Normal { mean: f64, std: f64, low: f64, high: f64 },
    /// Anywhere between two ends.
    Uniform { low: f64, high: f64 },
}

impl World {
    /// Equations 1–11 exactly.
    pub fn seed() -> Self {
        Self::default()
    }

    /// The world of a declaration.
    ///
    /// A parameter that is given exactly is the same in all scenes; one with a standard deviation is drawn from the
    /// Gaussian within its bounds, one with two ends uniformly between them. Of an effect's form, what is free and not
    /// given is drawn uniformly from its neutral value to three times a typical size away, to both sides where it may have
    /// both signs. An effect without a stated form has the first one in which the given parameters occur.
    pub fn declared(declared: &Declared) -> Self {
        Self { effects: declared.effects.iter().map(WorldEffect::of).collect(), patchy_share: 0.0 }
    }

    /// The same world, in which a share of the scenes has several soils under the wheels.
    pub fn with_patches(&self, patchy_share: f64) -> Self {
        Self { patchy_share, ..self.clone() }
    }

    /// The share of scenes whose wheels stand on several soils.
    pub fn patchy_share(&self) -> f64 {
        self.patchy_share
    }

    /// Whether nothing acts beside equations 1–11.
    pub fn is_without_effects(&self) -> bool {
        self.effects.is_empty()
    }

    /// The effects of one scene; `share` gives numbers 0 … 1.
    pub fn draw(&self, mut share: impl FnMut() -> f64) -> Effects<f64> {
        let mut effects = Effects::none();
        for effect in &self.effects {
            effects.add(effect.id);
            for (name, spread) in &effect.parameters {
                effects.set(effect.id, name, spread.at(share()));
            }
        }
        effects
    }
}

impl WorldEffect {
    fn of(declared: &DeclaredEffect) -> Self {
        let form = declared.first_form();
        let spread = |parameter: &ParameterInfo| {
            let within = |name: &str| name == parameter.name;
            let set = form.and_then(|form| form.set.iter().find(|(name, _)| within(name)));
            let free = form.is_some_and(|form| form.free.iter().any(|name| within(name)));
            match (declared.known.get(parameter.name), set) {
                (Some(known), _) => Some(Spread::known(*known, parameter)),
                (None, Some((_, value))) => Some(Spread::Exactly(*value)),
                (None, None) => free.then(|| Spread::unknown(parameter)),
            }
        };
        let parameters = declared.info.parameters.iter();
        let parameters = parameters.filter_map(|parameter| Some((parameter.name, spread(parameter)?))).collect();
        Self { id: declared.info.id, parameters }
    }
}

impl Spread {
    /// How many times its typical size a parameter of which nothing is known may be away from neutral.
    const REACH: f64 = 3.0;

    fn known(known: Knowledge, parameter: &ParameterInfo) -> Self {
        match known {
            Knowledge::Value { value, std } if std > 0.0 => {
                Self::Normal { mean: value, std, low: parameter.low, high: parameter.high }
            }
            Knowledge::Value { value, .. } => Self::Exactly(value),
            Knowledge::Between { min, max } => Self::Uniform { low: min, high: max },
        }
    }

    fn unknown(parameter: &ParameterInfo) -> Self {
        // What does nothing beyond its bounds may be anywhere within them.
        if !(parameter.low..=parameter.high).contains(&parameter.neutral) {
            return Self::Uniform { low: parameter.low, high: parameter.high };
        }
        let reach = Self::REACH * parameter.typical.abs();
        Self::Uniform {
            low: (parameter.neutral - reach).max(parameter.low),
            high: (parameter.neutral + reach).min(parameter.high),
        }
    }

    fn at(self, share: f64) -> f64 {
        match self {
            Self::Exactly(value) => value,
            Self::Uniform { low, high } => low + (high - low) * share,
            Self::Normal { mean, std, low, high } => {
                let normal = Normal::standard();
                let (below, above) = (normal.cdf((low - mean) / std), normal.cdf((high - mean) / std));
                let deviations = normal.inverse_cdf(below + (above - below) * share);
                (mean + std * deviations).clamp(low, high)
            }
        }
    }
}

/// As it stands in the file of a frozen table.
impl fmt::Display for World {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_without_effects() {
            return formatter.write_str("none: equations 1-11");
        }
        for (place, effect) in self.effects.iter().enumerate() {
            let separator = if place == 0 { "" } else { "; " };
            write!(formatter, "{separator}{}", effect.id)?;
            for (place, (name, spread)) in effect.parameters.iter().enumerate() {
                write!(formatter, "{} {name} {spread}", if place == 0 { ":" } else { "," })?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Exactly(value) => write!(formatter, "{}", significant(value, 6)),
            Self::Normal { mean, std, .. } => {
                write!(formatter, "{} +- {} normal", as_well_as_known(mean, std), as_well_as_known(std, std))
            }
            Self::Uniform { low, high } => {
                write!(formatter, "{} ... {} uniform", significant(low, 6), significant(high, 6))
            }
        }
    }
}

/// A number to the second digit of what it is known to, for people.
fn as_well_as_known(value: f64, std: f64) -> f64 {
    let decimals = (1.0 - libm::floor(libm::log10(std))).clamp(0.0, 17.0) as usize;
    format!("{value:.decimals$}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use kapvik_firmware::terramechanics::effects::CATALOGUE;

    use super::*;

    fn world(text: &str) -> World {
        let declared = Declared::parse(Path::new("d.toml"), text).expect("a declaration");
        World::declared(&declared)
    }

    /// The ends and the middle of what a parameter is drawn from.
    fn drawn(text: &str, id: &str, parameter: &str) -> [Option<f64>; 3] {
        [0.0, 0.5, 1.0].map(|share| world(text).draw(|| share).get(id, parameter))
    }

    #[test]
    fn what_is_given_exactly_is_the_same_in_all_scenes() {
        let text = "[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nn1 = 0.3\n";
        assert_eq!(drawn(text, "slip-sinkage", "n1"), [Some(0.3); 3]);
        assert_eq!(drawn(text, "slip-sinkage", "stretch"), [Some(0.0); 3], "what the form does not have is neutral");
    }

    /// Of what nothing is known, what is typical may be.
    #[test]
    fn a_spread_of_which_nothing_is_known_holds_what_is_typical() {
        for parameter in CATALOGUE.iter().flat_map(|info| info.parameters) {
            let Spread::Uniform { low, high } = Spread::unknown(parameter) else { panic!("{}", parameter.name) };
            assert!((low..=high).contains(&parameter.typical), "{}: {low} to {high}", parameter.name);
        }
    }

    #[test]
    fn a_spread_is_written_as_well_as_it_is_known() {
        let world = |value, std| {
            let text = format!(
                "[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nn1 = {{ value = {value}, std = {std} }}\n"
            );
            world(&text).to_string()
        };
        assert_eq!(world(0.314_159_26, 0.028_311), "slip-sinkage: n1 0.314 +- 0.028 normal");
        assert_eq!(world(0.3, 0.1), "slip-sinkage: n1 0.3 +- 0.1 normal");
    }

    #[test]
    fn between_two_ends_it_is_uniform() {
        let text = "[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nn1 = { min = 0.0, max = 0.7 }\n";
        assert_eq!(drawn(text, "slip-sinkage", "n1"), [Some(0.0), Some(0.35), Some(0.7)]);
    }

    #[test]
    fn a_gaussian_ends_at_the_bounds() {
        // guide-friction's mu may lie in -0.9 … 0.9.
        let text =
            "[declared]\neffects = [\"guide-friction\"]\n[declared.guide-friction]\nmu = { value = 0.8, std = 0.1 }\n";
        let [least, middle, greatest] = drawn(text, "guide-friction", "mu").map(|value| value.expect("a value"));
        assert!((greatest - 0.9).abs() < 1e-9 && greatest <= 0.9, "{greatest}");
        assert!(least >= -0.9, "{least}");
        // Half of the mass below +1 standard deviation lies below -0.200 174 standard deviations: Φ⁻¹(0.841 34/2), by SciPy.
        assert!((middle - (0.8 - 0.1 * 0.200_174)).abs() < 1e-6, "{middle}");
    }

    #[test]
    fn what_is_not_given_is_within_three_typical_sizes_and_the_bounds() {
        let text = "[declared]\neffects = [\"guide-friction\", \"multi-pass\"]\n";
        let [low, _, high] = drawn(text, "guide-friction", "mu").map(|value| value.expect("a value"));
        assert!((low + 0.3).abs() < 1e-12 && (high - 0.3).abs() < 1e-12, "{low} {high}");
        let [low, _, high] = drawn(text, "multi-pass", "m1").map(|value| value.expect("a value"));
        assert!((low + 0.9).abs() < 1e-12 && (high - 1.5).abs() < 1e-12, "{low} {high}");
    }

    #[test]
    fn a_form_says_what_is_free_and_what_is_set() {
        let text = "[declared]\neffects = [\"sinkage-lag\"]\n[declared.sinkage-lag]\nform = \"from the surface\"\n";
        assert_eq!(drawn(text, "sinkage-lag", "start"), [Some(0.0); 3]);
        let [low, _, high] = drawn(text, "sinkage-lag", "length_m").map(|value| value.expect("a value"));
        assert!(low == 0.0 && (high - 0.15).abs() < 1e-12, "{low} {high}");
    }

    #[test]
    fn the_words_name_every_effect() {
        let text = "[declared]\neffects = [\"slip-sinkage\", \"force-bias\"]\n[declared.slip-sinkage]\nn1 = 0.3\n\
                    [declared.force-bias]\nload_n = { value = 1.0, std = 0.2 }\n";
        assert_eq!(world(text).to_string(), "slip-sinkage: n1 0.3; force-bias: load_n 1 +- 0.2 normal");
        assert_eq!(World::seed().to_string(), "none: equations 1-11");
    }
}
