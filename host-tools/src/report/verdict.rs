//! What an estimate is worth, beside what other means say.

use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};

use crate::data::campaign::{Ground, Knowledge};
use crate::identify::at_edge;

use crate::parameter::Parameter;

/// What an estimate is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The data told it, and nothing speaks against it.
    Told,
    /// The data removed less than half of the variance that there was before them.
    Untold,
    /// The networks are sure, and the direct tests lie elsewhere.
    ExcludesDirectTests,
    /// The networks are sure, and at the end of what they were trained for: the best soil may lie beyond it.
    AtEdge,
    /// The networks are sure, and the equations that they were trained with explain the run with no soil.
    ExplainsNothing,
    /// The networks are sure, and wrong about another parameter of the same soil: they were estimated as one.
    InDoubtfulCompany,
}

impl Verdict {
    /// Of one parameter of a soil, with what is known of the ground by other means, and whether any soil explains the run.
    pub fn of(parameter: Parameter, soil: &SoilEstimate, ground: &Ground, is_explained: bool) -> Self {
        match Self::alone(parameter, soil, ground) {
            Self::Told if !is_explained => Self::ExplainsNothing,
            Self::Told if Parameter::ALL.iter().any(|other| Self::alone(*other, soil, ground).is_doubtful()) => {
                Self::InDoubtfulCompany
            }
            verdict => verdict,
        }
    }

    /// Without regard to the other parameters.
    fn alone(parameter: Parameter, soil: &SoilEstimate, ground: &Ground) -> Self {
        let estimate = parameter.of(soil);
        if !estimate.identifiable {
            Self::Untold
        } else if parameter.known(ground).is_some_and(|known| excludes(estimate, known)) {
            Self::ExcludesDirectTests
        } else if at_edge(parameter.prior(), estimate.value.into()) {
            Self::AtEdge
        } else {
            Self::Told
        }
    }

    /// In words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Told => "told by these data",
            Self::Untold => "cannot be told from these data",
            Self::ExcludesDirectTests => "narrow, but excludes the direct tests",
            Self::AtEdge => "narrow, but at the edge of the training",
            Self::ExplainsNothing => "narrow, but no soil explains the run",
            Self::InDoubtfulCompany => "narrow, but part of a doubtful estimate",
        }
    }

    /// The mark behind a number in a table.
    pub fn mark(self) -> char {
        match self {
            Self::Told => ' ',
            Self::Untold => '?',
            _ => '!',
        }
    }

    /// The class of its shapes.
    pub fn class(self) -> &'static str {
        match self {
            Self::Told => "told",
            Self::Untold => "untold",
            _ => "doubtful",
        }
    }

    /// Whether something speaks against it.
    pub fn is_doubtful(self) -> bool {
        !matches!(self, Self::Told | Self::Untold)
    }
}

/// Whether the 95 % interval and that of the direct tests have nothing in common.
fn excludes(estimate: &ParameterEstimate, known: Knowledge) -> bool {
    let (low, high) = known.within(2.0);
    let [least, greatest] = estimate.interval_95.map(f64::from);
    greatest < low || least > high
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(value: f32, half_width: f32) -> ParameterEstimate {
        let interval = [value - half_width, value + half_width];
        ParameterEstimate {
            value,
            std: 0.5 * half_width,
            interval_68: interval,
            interval_95: interval,
            identifiable: true,
        }
    }

    fn soil(friction_angle_rad: ParameterEstimate) -> SoilEstimate {
        SoilEstimate {
            cohesion_pa: estimate(300.0, 50.0),
            friction_angle_rad,
            shear_modulus_m: estimate(0.012, 0.001),
            outside_training_range: false,
        }
    }

    #[test]
    fn being_sure_is_not_being_right() {
        let known = Knowledge::Value { value: 0.557, std: 0.035 };
        let ground = Ground { friction_angle_rad: Some(known), ..Ground::default() };
        let verdicts = |friction, ground| {
            [Parameter::FrictionAngle, Parameter::Cohesion].map(|one| Verdict::of(one, &soil(friction), ground, true))
        };
        let nothing = Ground::default();
        let untold = ParameterEstimate { identifiable: false, ..estimate(0.44, 0.03) };
        assert_eq!(verdicts(estimate(0.55, 0.05), &ground), [Verdict::Told; 2]);
        assert_eq!(verdicts(estimate(0.44, 0.03), &ground), [Verdict::ExcludesDirectTests, Verdict::InDoubtfulCompany]);
        assert_eq!(verdicts(estimate(0.44, 0.03), &nothing), [Verdict::Told; 2]);
        assert_eq!(verdicts(untold, &ground), [Verdict::Untold, Verdict::Told]);
        assert_eq!(
            Parameter::ALL.map(|one| Verdict::of(one, &soil(untold), &nothing, false)),
            [Verdict::ExplainsNothing, Verdict::Untold, Verdict::ExplainsNothing]
        );
        // 22° is where the training begins.
        let edge = estimate(22.1_f32.to_radians(), 0.01);
        assert_eq!(verdicts(edge, &nothing), [Verdict::AtEdge, Verdict::InDoubtfulCompany]);
    }
}
