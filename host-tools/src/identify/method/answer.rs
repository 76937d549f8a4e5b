//! What a method answers.

use kapvik_firmware::identification::{Identified, Origin, Told};
use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};
use kapvik_firmware::terramechanics::Soil;

/// What a method says of a soil.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// c, Pa.
    pub cohesion_pa: Statement,
    /// φ, rad.
    pub friction_angle_rad: Statement,
    /// K, m.
    pub shear_modulus_m: Statement,
    /// Of the method's own system of equations, where it has one.
    pub condition_number: Option<f64>,
    /// How well the method's model explains what was seen, where it says.
    pub fit: Option<Fit>,
    /// Why the answer is none that a soil can be, in a few words; none where it is one.
    pub no_soil: Option<String>,
    /// Which intervals are wider than the method states them, and why; none where they are as it states them.
    pub widened: Option<String>,
    /// What else is to be known of the answer, which changes no number of it.
    pub remarks: Vec<String>,
}

/// What a method says of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statement {
    /// The value.
    pub value: f64,
    /// One standard deviation; infinite until something gives one.
    pub std: f64,
    /// Contains the truth in 68 of 100 cases, by the method's own account.
    pub interval_68: [f64; 2],
    /// Contains the truth in 95 of 100 cases, by the method's own account.
    pub interval_95: [f64; 2],
    /// Whether the data tell it.
    pub identifiable: bool,
    /// Whether the method takes it as given.
    pub assumed: bool,
}

/// How well a model explains what was seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Sum of the squared residuals in units of their noise.
    pub chi_square: f64,
    /// Numbers seen less parameters that the data tell.
    pub degrees_of_freedom: f64,
    /// Probability of a greater sum where the model is right.
    pub p_value: f64,
    /// The soil that the model then has; its stiffness is all in k_φ.
    pub soil: Soil<f64>,
}

impl Finding {
    /// An answer of which nothing else is said.
    pub fn of([cohesion_pa, friction_angle_rad, shear_modulus_m]: [Statement; 3]) -> Self {
        Self {
            cohesion_pa,
            friction_angle_rad,
            shear_modulus_m,
            condition_number: None,
            fit: None,
            no_soil: None,
            widened: None,
            remarks: Vec::new(),
        }
    }

    /// The three statements: c, φ, K.
    pub fn statements(&self) -> [&Statement; 3] {
        [&self.cohesion_pa, &self.friction_angle_rad, &self.shear_modulus_m]
    }

    /// The same, to change.
    pub fn statements_mut(&mut self) -> [&mut Statement; 3] {
        [&mut self.cohesion_pa, &mut self.friction_angle_rad, &mut self.shear_modulus_m]
    }
}

/// φ as told, c and K not.
#[cfg(test)]
pub fn told_of_friction_angle(degrees: f64, std_degrees: f64) -> Finding {
    let untold = Statement::normal(1.0, 1.0);
    let told = Statement::normal(degrees.to_radians(), std_degrees.to_radians());
    Finding::of([untold, Statement { identifiable: true, ..told }, untold])
}

impl From<&Identified<f64>> for Finding {
    fn from(identified: &Identified<f64>) -> Self {
        let Identified { cohesion_pa, friction_angle_rad, shear_modulus_m, condition_number } = identified;
        Self {
            condition_number: Some(*condition_number).filter(|number| number.is_finite()),
            ..Self::of([cohesion_pa, friction_angle_rad, shear_modulus_m].map(Statement::from))
        }
    }
}

impl From<&SoilEstimate> for Finding {
    fn from(estimate: &SoilEstimate) -> Self {
        let SoilEstimate { cohesion_pa, friction_angle_rad, shear_modulus_m, .. } = estimate;
        Self::of([cohesion_pa, friction_angle_rad, shear_modulus_m].map(Statement::from))
    }
}

impl Statement {
    /// A value with symmetric intervals: what a method says that knows a standard deviation and no more.
    pub fn normal(value: f64, std: f64) -> Self {
        let interval = |width: f64| [value - width * std, value + width * std];
        Self {
            value,
            std,
            interval_68: interval(1.0),
            interval_95: interval(1.96),
            identifiable: false,
            assumed: false,
        }
    }

    /// The same value with another standard deviation.
    #[must_use]
    pub fn with_std(self, std: f64) -> Self {
        Self { identifiable: self.identifiable, assumed: self.assumed, ..Self::normal(self.value, std) }
    }
}

impl From<&Told<f64>> for Statement {
    fn from(told: &Told<f64>) -> Self {
        Self {
            identifiable: told.identifiable,
            assumed: told.origin == Origin::Assumed,
            ..Self::normal(told.value, told.std.unwrap_or(f64::INFINITY))
        }
    }
}

impl From<&ParameterEstimate> for Statement {
    fn from(estimate: &ParameterEstimate) -> Self {
        Self {
            value: estimate.value.into(),
            std: estimate.std.into(),
            interval_68: estimate.interval_68.map(f64::from),
            interval_95: estimate.interval_95.map(f64::from),
            identifiable: estimate.identifiable,
            assumed: false,
        }
    }
}
