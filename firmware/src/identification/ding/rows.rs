//! The observations that the method can use, and their stresses.

use crate::dual::Dual;
use crate::identification::{Observation, Refusal, StressShape, TriangularStress};
use crate::scalar::Scalar;
use crate::terramechanics::Wheel;

/// A wheel and what was seen of it; every driven observation has a sinkage in range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rows<'a, S> {
    wheel: &'a Wheel<S>,
    observations: &'a [Observation<S>],
}

impl<'a, S: Scalar> Rows<'a, S> {
    /// The rows of observations that have passed the common checks.
    pub fn new(wheel: &'a Wheel<S>, observations: &'a [Observation<S>]) -> Result<Self, Refusal> {
        let rows = Self { wheel, observations };
        for observation in rows.driven() {
            observation.sinkage_on(wheel)?;
        }
        Ok(rows)
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.driven().count()
    }

    /// The load that they carry together, root of the sum of squares, N.
    pub fn load_n(&self) -> S {
        let squares = self.driven().map(|Observation { state, .. }| state.load_n * state.load_n);
        squares.fold(S::zero(), |sum, square| sum + square).sqrt()
    }

    /// The wheel's radius, m.
    pub fn radius_m(&self) -> S {
        self.wheel.radius_m
    }

    /// The observations that were driving.
    pub fn driven(&self) -> impl Iterator<Item = &'a Observation<S>> + use<'a, S> {
        self.observations.iter().filter(|observation| observation.is_driven())
    }

    /// Their stresses.
    pub fn stresses(&self, shape: &StressShape<S>) -> impl Iterator<Item = TriangularStress<S>> {
        let (wheel, shape) = (*self.wheel, *shape);
        self.driven().map(move |Observation { state, .. }| {
            TriangularStress::new(&wheel, state, state.sinkage_m.unwrap_or(S::zero()), &shape)
        })
    }

    /// Drawbar pull, less the one that the shape leaves room for, with its derivatives by c₁, c₂ and c₃.
    pub fn pull_left(&self, [c1, c2, c3]: [S; 3]) -> impl Iterator<Item = Dual<S, 3>> {
        let shape = StressShape { c1: Dual::variable(c1, 0), c2: Dual::variable(c2, 1), c3: Dual::variable(c3, 2) };
        let wheel = self.wheel.map(Dual::fixed);
        self.driven().map(move |Observation { state, .. }| {
            let state = state.map(Dual::fixed);
            let sinkage_m = state.sinkage_m.unwrap_or(Dual::fixed(S::zero()));
            state.drawbar_pull_n - TriangularStress::new(&wheel, &state, sinkage_m, &shape).drawbar_pull_n
        })
    }
}

/// Variables of an observation: drawbar pull, load, torque, sinkage and slip; then c₁, c₂ and c₃.
pub(super) const MEASURED: usize = 5;
/// A number with its derivatives by them.
pub(super) type Traced<S> = Dual<S, { MEASURED + 3 }>;

/// The rows with derivatives by all that is measured and by the shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sensitive<'a, S> {
    rows: &'a Rows<'a, S>,
    /// c₁, c₂ and c₃.
    pub shape: [S; 3],
}

/// A row with derivatives.
pub(super) struct SensitiveRow<S> {
    /// The stresses.
    pub stress: TriangularStress<Traced<S>>,
    /// Drawbar pull, less the one that the shape leaves room for, N.
    pub pull_left_n: Traced<S>,
    /// Slip.
    pub slip: Traced<S>,
    /// The variance of each measured variable.
    variances: [S; MEASURED],
}

impl<'a, S: Scalar> Sensitive<'a, S> {
    /// The rows at a shape.
    pub fn new(rows: &'a Rows<'a, S>, shape: &StressShape<S>) -> Self {
        Self { rows, shape: [shape.c1, shape.c2, shape.c3] }
    }

    /// The wheel's radius, m.
    pub fn radius_m(&self) -> S {
        self.rows.radius_m()
    }

    /// The rows.
    pub fn iter(&self) -> impl Iterator<Item = SensitiveRow<S>> {
        let [c1, c2, c3] = self.shape;
        let shape = StressShape { c1: Dual::variable(c1, 5), c2: Dual::variable(c2, 6), c3: Dual::variable(c3, 7) };
        let wheel = self.rows.wheel.map(Dual::fixed);
        self.rows.driven().map(move |Observation { state, noise }| {
            let mut state = state.map(Dual::fixed);
            let mut sinkage_m = state.sinkage_m.unwrap_or(Dual::fixed(S::zero()));
            let (pull, load, torque) = (&mut state.drawbar_pull_n, &mut state.load_n, &mut state.torque_nm);
            for (place, number) in [pull, load, torque, &mut sinkage_m, &mut state.slip].into_iter().enumerate() {
                *number = Dual::variable(number.value, place);
            }
            let stds = [noise.drawbar_pull_n, noise.load_n, noise.torque_nm, noise.sinkage_m, noise.slip];
            let stress = TriangularStress::new(&wheel, &state, sinkage_m, &shape);
            SensitiveRow {
                pull_left_n: state.drawbar_pull_n - stress.drawbar_pull_n,
                stress,
                slip: state.slip,
                variances: stds.map(|std| std * std),
            }
        })
    }
}

impl<S: Scalar> SensitiveRow<S> {
    /// The measured variables' variances, each with the derivatives of the given numbers by that variable.
    pub fn measured<const N: usize>(&self, numbers: [&Traced<S>; N]) -> impl Iterator<Item = (S, [S; N])> {
        let slopes = numbers.map(|number| number.slopes);
        self.variances.into_iter().enumerate().map(move |(place, variance)| {
            (variance, slopes.map(|slopes| slopes.get(place).copied().unwrap_or(S::zero())))
        })
    }

    /// The variance that the noise gives a number.
    pub fn variance(&self, number: &Traced<S>) -> S {
        let shares = self.measured([number]).map(|(variance, [slope])| variance * slope * slope);
        shares.fold(S::zero(), |sum, share| sum + share)
    }
}

impl<S: Scalar> Traced<S> {
    /// The derivatives by c₁, c₂ and c₃.
    pub(super) fn by_shape(&self) -> [S; 3] {
        let [.., c1, c2, c3] = self.slopes;
        [c1, c2, c3]
    }
}
