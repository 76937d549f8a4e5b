//! The variances of c, tan φ and ln K that come from the observations' noise.

use crate::identification::least_squares::Triangle;
use crate::scalar::Scalar;

use super::DingBounds;
use super::rows::{Sensitive, SensitiveRow, Traced};
use super::strength::Strength;

/// First order, through step 1 (whose parameters at a bound stay there) and step 3 (whose c and tan φ are taken as if they
/// had none). None where the equations of a step are singular.
pub(super) fn of<S: Scalar>(rows: &Sensitive<'_, S>, strength: &Strength<S>, bounds: &DingBounds<S>) -> Option<[S; 3]> {
    let free = Free::new(rows, bounds);
    let (mut first, mut third) = (free.held(), Triangle::<S, 3>::new());
    for row in rows.iter() {
        first.add(free.gradient(&row), S::zero());
        third.add(Model::new(&row, strength).gradient, S::zero());
    }
    // Columns: what the residuals of step 3 make of c, tan φ and ln K as c₁, c₂ and c₃ move.
    let mut by_shape = [[S::zero(); 3]; 3];
    for row in rows.iter() {
        let model = Model::new(&row, strength);
        let answer = third.normal_solve(model.gradient)?;
        for (column, slope) in by_shape.iter_mut().zip(model.residual.by_shape()) {
            column.iter_mut().zip(&answer).for_each(|(entry, share)| *entry += slope * *share);
        }
    }
    let mut variances = [S::zero(); 3];
    for row in rows.iter() {
        let model = Model::new(&row, strength);
        let direct = third.normal_solve(model.gradient)?;
        let shape = first.normal_solve(free.gradient(&row))?;
        let mut through = [S::zero(); 3];
        for (column, moved) in by_shape.iter().zip(&shape) {
            through.iter_mut().zip(column).for_each(|(entry, share)| *entry += *moved * *share);
        }
        for (variance, [by_residual, by_pull]) in row.measured([&model.residual, &row.pull_left_n]) {
            for (sum, (direct, through)) in variances.iter_mut().zip(direct.iter().zip(&through)) {
                let moved = by_residual * *direct + by_pull * *through;
                *sum += variance * moved * moved;
            }
        }
    }
    variances.iter().all(|variance| variance.is_finite()).then_some(variances)
}

/// Which of c₁, c₂ and c₃ are not at a bound.
struct Free([bool; 3]);

impl Free {
    fn new<S: Scalar>(rows: &Sensitive<'_, S>, bounds: &DingBounds<S>) -> Self {
        let [c1, c2, c3] = rows.shape;
        Self([bounds.c1.contains_inside(c1), bounds.c2.contains_inside(c2), bounds.c3.contains_inside(c3)])
    }

    /// Equations that hold those at a bound.
    fn held<S: Scalar>(&self) -> Triangle<S, 3> {
        let mut held = Triangle::new();
        for (place, _) in self.0.iter().enumerate().filter(|(_, free)| !**free) {
            held.add_alone(place, S::one(), S::zero());
        }
        held
    }

    /// The derivatives of the drawbar pull by those that are free.
    fn gradient<S: Scalar>(&self, row: &SensitiveRow<S>) -> [S; 3] {
        let mut gradient = row.pull_left_n.by_shape();
        for (slope, free) in gradient.iter_mut().zip(&self.0) {
            *slope = if *free { -*slope } else { S::zero() };
        }
        gradient
    }
}

/// The shear stress of step 3.
struct Model<S> {
    /// Of the stress by c, tan φ and ln K.
    gradient: [S; 3],
    /// What is observed less the stress.
    residual: Traced<S>,
}

impl<S: Scalar> Model<S> {
    fn new(row: &SensitiveRow<S>, strength: &Strength<S>) -> Self {
        let [cohesion_pa, tan_friction, shear_modulus_m] =
            [strength.cohesion_pa, strength.tan_friction, strength.shear_modulus_m].map(Traced::fixed);
        let lengths = row.stress.displacement_m / shear_modulus_m;
        let mobilised = row.stress.mobilised(shear_modulus_m);
        let left = S::one() - mobilised.value;
        let strength_pa = cohesion_pa + row.stress.normal_pa * tan_friction;
        Self {
            gradient: [
                mobilised.value,
                mobilised.value * row.stress.normal_pa.value,
                -(strength_pa.value * left * lengths.value),
            ],
            residual: row.stress.shear_pa - mobilised * strength_pa,
        }
    }
}
