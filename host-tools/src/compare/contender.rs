//! Who is set side by side: a method, and what it is told of the soil.

use kapvik_firmware::identification::SoilPrior;
use kapvik_firmware::terramechanics::Soil;

use crate::identify::method::{Evidence, Finding, Method, answer, networks};

use super::case::Case;
use super::situation::{Situation, SlipSinkage, Truth};

/// A method as it is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contender {
    /// Short name.
    pub id: &'static str,
    /// In words.
    pub label: &'static str,
    /// How it answers.
    way: Way,
    /// What it is told.
    told: Told,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// The per-wheel network about the wheel in the middle.
    OneWheel,
    /// As `identify` asks.
    By(Method),
}

/// What a method that takes part of the soil as given is told of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Told {
    /// The middle of the prior.
    Middle,
    /// The usual prior, in place of what the networks were trained with.
    UsualPrior,
    /// The true K.
    ShearModulus,
    /// All that it does not estimate: the truth.
    AllElse,
    /// The true soil, among those of the bank.
    OneOfTheBank,
}

const fn contender(id: &'static str, label: &'static str, way: Way, told: Told) -> Contender {
    Contender { id, label, way, told }
}

/// All of them, in the order of the table.
pub const CONTENDERS: [Contender; 15] = [
    contender("limit", "limit (posterior mean)", Way::By(Method::Limit), Told::Middle),
    contender("map", "map", Way::By(Method::Map), Told::Middle),
    contender("map-usual", "map, usual prior", Way::By(Method::Map), Told::UsualPrior),
    contender("network", "network, rover", Way::By(Method::Network), Told::Middle),
    contender("network-one-wheel", "network, one wheel", Way::OneWheel, Told::Middle),
    contender("cross", "cross", Way::By(Method::Cross), Told::Middle),
    contender("ding", "ding", Way::By(Method::Ding), Told::Middle),
    contender("ding-bounded", "ding, bounded", Way::By(Method::DingBounded), Told::Middle),
    contender("iagnemma", "iagnemma, K assumed", Way::By(Method::Iagnemma), Told::Middle),
    contender("iagnemma-K", "iagnemma, K known", Way::By(Method::Iagnemma), Told::ShearModulus),
    contender(
        "iagnemma-recursive",
        "iagnemma, recursive, K known",
        Way::By(Method::IagnemmaRecursive),
        Told::ShearModulus,
    ),
    contender("hutangkabodee", "hutangkabodee", Way::By(Method::Hutangkabodee), Told::Middle),
    contender("hutangkabodee-n", "hutangkabodee; n, c, c₁, c₂ known", Way::By(Method::Hutangkabodee), Told::AllElse),
    contender("ray", "ray", Way::By(Method::Ray), Told::Middle),
    contender("ray-bank", "ray, soil in the bank", Way::By(Method::Ray), Told::OneOfTheBank),
];

impl Contender {
    /// Whether it is the limit, which only counts where its prior is that of the cases.
    pub fn is_limit(&self) -> bool {
        self.way == Way::By(Method::Limit)
    }

    /// Whether it is told what nobody knows on a drive, or stands in the table with another prior: it is not in the contest then.
    pub fn is_told_otherwise(&self) -> bool {
        self.told != Told::Middle
    }

    /// Whether it is asked in a situation: not where it would be another once more.
    pub fn takes_part(&self, situation: &Situation) -> bool {
        let drawn = situation.truth == Truth::Drawn;
        match (self.way, self.told) {
            // Its prior is that of the networks, and it knows equations 1–11.
            (Way::By(Method::Limit), _) => drawn && situation.slip_sinkage == SlipSinkage::None,
            (_, Told::UsualPrior) => !drawn,
            _ => true,
        }
    }

    /// What it says of a case.
    ///
    /// # Errors
    /// Why it says nothing.
    pub fn answer(&self, case: &Case) -> Result<Finding, String> {
        let evidence = self.evidence(case);
        match self.way {
            Way::OneWheel => networks::one_wheel(&evidence),
            Way::By(method) => answer(method, &evidence),
        }
    }

    fn evidence(&self, case: &Case) -> Evidence {
        let mut evidence = case.evidence.clone();
        // Table 1 is a soil of the literature, and of some situations.
        evidence.bank.retain(|soil| !is_near(soil, &case.soil));
        let assumed = &mut evidence.assumed.soil;
        match self.told {
            Told::Middle => {}
            Told::UsualPrior => evidence.prior = SoilPrior::usual(),
            Told::ShearModulus => assumed.shear_modulus_m = case.soil.shear_modulus_m,
            Told::AllElse => {
                *assumed = Soil {
                    friction_angle_rad: assumed.friction_angle_rad,
                    shear_modulus_m: assumed.shear_modulus_m,
                    frictional_modulus: assumed.frictional_modulus,
                    ..case.soil
                };
            }
            Told::OneOfTheBank => evidence.bank.push(case.soil),
        }
        evidence
    }
}

/// Whether two soils are one by their strength.
fn is_near(one: &Soil<f64>, other: &Soil<f64>) -> bool {
    (one.friction_angle_rad - other.friction_angle_rad).abs() < 1e-3
        && (one.cohesion_pa - other.cohesion_pa).abs() < 1.0
        && (one.shear_modulus_m - other.shear_modulus_m).abs() < 1e-4
}
