//! Who is set side by side: a method, and what it is told of the soil.

use kapvik_firmware::terramechanics::Soil;

use crate::identify::method::{Evidence, Finding, Method, answer, networks};

use super::case::Case;

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
    /// The true K.
    ShearModulus,
    /// All that it does not estimate: the truth.
    AllElse,
}

const fn contender(id: &'static str, label: &'static str, way: Way, told: Told) -> Contender {
    Contender { id, label, way, told }
}

/// All of them, in the order of the table.
pub const CONTENDERS: [Contender; 12] = [
    contender("limit", "limit (posterior mean)", Way::By(Method::Limit), Told::Middle),
    contender("map", "map", Way::By(Method::Map), Told::Middle),
    contender("network", "network, rover", Way::By(Method::Network), Told::Middle),
    contender("network-one-wheel", "network, one wheel", Way::OneWheel, Told::Middle),
    contender("cross", "cross", Way::By(Method::Cross), Told::Middle),
    contender("ding", "ding", Way::By(Method::Ding), Told::Middle),
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
];

impl Contender {
    /// Whether it is the limit, which only counts where its prior is that of the cases.
    pub fn is_limit(&self) -> bool {
        self.way == Way::By(Method::Limit)
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
        let assumed = &mut evidence.assumed.soil;
        match self.told {
            Told::Middle => {}
            Told::ShearModulus => assumed.shear_modulus_m = case.soil.shear_modulus_m,
            Told::AllElse => {
                *assumed = Soil {
                    friction_angle_rad: assumed.friction_angle_rad,
                    shear_modulus_m: assumed.shear_modulus_m,
                    frictional_modulus: assumed.frictional_modulus,
                    ..case.soil
                };
            }
        }
        evidence
    }
}
