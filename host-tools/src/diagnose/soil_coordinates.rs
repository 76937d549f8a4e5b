//! The soil's parameters as a fit sees them.

use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::Soil;

use crate::data::campaign::{Campaign, Ground, Knowledge};

use super::fit::Coordinate;

/// A parameter of the soil that a fit may free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SoilParameter {
    /// n.
    SinkageExponent,
    /// k_c/b + k_φ, Pa/mⁿ.
    Stiffness,
    /// c, Pa.
    Cohesion,
    /// φ, rad.
    FrictionAngle,
    /// K, m.
    ShearModulus,
    /// c₁.
    PeakStressC1,
    /// c₂.
    PeakStressC2,
    /// η.
    ReboundRatio,
}

/// What is believed of a parameter where a campaign does not say: mean and standard deviation in the fit's unit, and bounds.
struct DefaultPrior {
    mean: f64,
    std: f64,
    low: f64,
    high: f64,
}

impl SoilParameter {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::SinkageExponent,
        Self::Stiffness,
        Self::Cohesion,
        Self::FrictionAngle,
        Self::ShearModulus,
        Self::PeakStressC1,
        Self::PeakStressC2,
        Self::ReboundRatio,
    ];

    /// The key in `[soil]`.
    pub const fn key(self) -> &'static str {
        match self {
            Self::SinkageExponent => "n",
            Self::Stiffness => "k_eff",
            Self::Cohesion => "c",
            Self::FrictionAngle => "phi",
            Self::ShearModulus => "K",
            Self::PeakStressC1 => "c1",
            Self::PeakStressC2 => "c2",
            Self::ReboundRatio => "eta",
        }
    }

    /// Whether a fit works on the logarithm.
    pub const fn is_logarithmic(self) -> bool {
        matches!(self, Self::Stiffness | Self::ShearModulus)
    }

    /// From the fit's unit.
    pub fn value<S: Scalar>(self, coordinate: S) -> S {
        if self.is_logarithmic() { coordinate.exp() } else { coordinate }
    }

    /// To the fit's unit.
    pub fn coordinate(self, value: f64) -> f64 {
        if self.is_logarithmic() { value.max(1e-300).ln() } else { value }
    }

    /// The place of the parameter in a soil whose stiffness is all in k_φ.
    pub fn place<S>(self, soil: &mut Soil<S>) -> &mut S {
        match self {
            Self::SinkageExponent => &mut soil.sinkage_exponent,
            Self::Stiffness => &mut soil.frictional_modulus,
            Self::Cohesion => &mut soil.cohesion_pa,
            Self::FrictionAngle => &mut soil.friction_angle_rad,
            Self::ShearModulus => &mut soil.shear_modulus_m,
            Self::PeakStressC1 => &mut soil.peak_stress_c1,
            Self::PeakStressC2 => &mut soil.peak_stress_c2,
            Self::ReboundRatio => &mut soil.rebound_ratio,
        }
    }

    fn known(self, campaign: &Campaign) -> Option<Knowledge> {
        // A rear contact that nobody speaks of is an effect, not a part of the soil.
        let unsaid = (self == Self::ReboundRatio).then_some(Knowledge::Value { value: 0.0, std: 0.0 });
        self.stated(campaign).or(unsaid)
    }

    /// What a campaign states of it.
    pub fn stated(self, campaign: &Campaign) -> Option<Knowledge> {
        let ground = &campaign.ground;
        match self {
            Self::SinkageExponent => ground.sinkage_exponent,
            Self::Stiffness => ground.stiffness(&campaign.wheel),
            Self::Cohesion => ground.cohesion_pa,
            Self::FrictionAngle => ground.friction_angle_rad,
            Self::ShearModulus => ground.shear_modulus_m,
            Self::PeakStressC1 => ground.peak_stress_c1,
            Self::PeakStressC2 => ground.peak_stress_c2,
            Self::ReboundRatio => ground.rebound_ratio,
        }
    }

    /// Makes what is known of a soil say as little of it as may be.
    pub fn forget(self, ground: &mut Ground) {
        match self {
            Self::SinkageExponent => ground.sinkage_exponent = None,
            Self::Stiffness => {
                (ground.stiffness, ground.cohesive_modulus, ground.frictional_modulus) = (None, None, None);
            }
            Self::Cohesion => ground.cohesion_pa = None,
            Self::FrictionAngle => ground.friction_angle_rad = None,
            Self::ShearModulus => ground.shear_modulus_m = None,
            Self::PeakStressC1 => ground.peak_stress_c1 = None,
            Self::PeakStressC2 => ground.peak_stress_c2 = None,
            // Of which nothing said would be none.
            Self::ReboundRatio => ground.rebound_ratio = Some(Knowledge::Between { min: 0.0, max: 1.0 }),
        }
    }

    /// Covers the soils of the literature's catalogue: two standard deviations reach its ends, bounds lie beyond.
    const fn default_prior(self) -> DefaultPrior {
        let (mean, std, low, high) = match self {
            Self::SinkageExponent => (1.05, 0.25, 0.1, 2.2),
            Self::Stiffness => (14.3, 1.0, 9.2, 18.4),
            Self::Cohesion => (600.0, 1500.0, 0.0, 20_000.0),
            Self::FrictionAngle => (0.56, 0.14, 0.05, 1.05),
            Self::ShearModulus => (-4.3, 0.7, -7.6, -2.3),
            Self::PeakStressC1 => (0.32, 0.13, -0.2, 0.9),
            Self::PeakStressC2 => (0.18, 0.15, -0.6, 1.0),
            Self::ReboundRatio => (0.0, 0.1, 0.0, 1.0),
        };
        DefaultPrior { mean, std, low, high }
    }
}

/// What a fit does about a parameter of the soil.
#[derive(Debug, Clone, PartialEq)]
pub enum Treatment {
    /// Held at a value.
    Fixed(f64),
    /// Freed.
    Free(Coordinate),
}

/// What a fit does about each parameter of a campaign's soil: as its file says, or within the default prior.
pub fn treatments(campaign: &Campaign) -> [(SoilParameter, Treatment); 8] {
    SoilParameter::ALL.map(|parameter| (parameter, treatment(parameter, campaign)))
}

fn treatment(parameter: SoilParameter, campaign: &Campaign) -> Treatment {
    let prior = parameter.default_prior();
    let coordinate = |low: f64, high: f64, start: f64, prior| {
        Treatment::Free(Coordinate { name: parameter.key().to_owned(), low, high, start, prior })
    };
    match parameter.known(campaign) {
        Some(Knowledge::Value { value, std }) if std <= 1e-9 * value.abs() => Treatment::Fixed(value),
        Some(Knowledge::Value { value, std }) => {
            let mean = parameter.coordinate(value);
            let std = if parameter.is_logarithmic() { std / value } else { std };
            coordinate(prior.low.min(mean), prior.high.max(mean), mean, Some((mean, std)))
        }
        Some(Knowledge::Between { min, max }) => {
            let floor = if parameter.is_logarithmic() { min.max(1e-6 * max) } else { min };
            let (low, high) = (parameter.coordinate(floor), parameter.coordinate(max));
            coordinate(low, high, 0.5 * (low + high), None)
        }
        None => coordinate(prior.low, prior.high, prior.mean, Some((prior.mean, prior.std))),
    }
}
