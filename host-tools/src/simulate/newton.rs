//! A damped Newton method for seven equations.

use nalgebra::{LU, SMatrix};

use super::pose::Coordinates;

type Jacobian = SMatrix<f64, 7, 7>;
type Factors = LU<f64, nalgebra::Const<7>, nalgebra::Const<7>>;

/// The residual, N and N·m, that a step ends below: a hundredth of what every frame is held to.
const TOLERANCE: f64 = 1.0e-8;
/// Newton steps at most.
const STEPS: usize = 60;
/// Steps of the numerical derivative: rates of millimetres and milliradians a second are ten thousand times as large.
const DIFFERENCE: f64 = 1.0e-7;

/// What the unknowns lead to, with what they leave unbalanced; `None` where the equations do not hold.
pub trait Residual {
    /// All that is computed on the way.
    type State;
    /// At the given unknowns.
    fn at(&self, unknowns: &Coordinates) -> Option<(Coordinates, Self::State)>;
}

/// Solves by Newton's method with halved steps where a whole one does not help. The derivative is kept as long as it
/// serves, also from call to call.
#[derive(Debug, Clone, Default)]
pub struct Newton {
    factors: Option<Factors>,
}

/// A solution with what was computed on the way.
pub struct Solved<T> {
    /// The unknowns.
    pub unknowns: Coordinates,
    /// What they lead to.
    pub state: T,
}

impl Newton {
    /// The unknowns near `start` that leave nothing unbalanced; `None` where none are found.
    pub fn solve<R: Residual>(&mut self, problem: &R, start: Coordinates) -> Option<Solved<R::State>> {
        let mut unknowns = start;
        let (mut residual, mut state) = problem.at(&unknowns)?;
        for _ in 0..STEPS {
            if residual.amax() <= TOLERANCE {
                return Some(Solved { unknowns, state });
            }
            let fresh = self.factors.is_none();
            if fresh {
                self.factors = Some(jacobian(problem, &unknowns, &residual)?.lu());
            }
            let step = self.factors.as_ref().and_then(|factors| factors.solve(&residual))?;
            let smaller = shortened(problem, &unknowns, &residual, &step, fresh);
            let Some((next, next_residual, next_state)) = smaller else {
                if fresh {
                    return None;
                }
                self.factors = None;
                continue;
            };
            if next_residual.norm() > 0.1 * residual.norm() {
                self.factors = None;
            }
            (unknowns, residual, state) = (next, next_residual, next_state);
        }
        None
    }
}

/// The longest of step, step/2, step/4 … that leaves less unbalanced. A derivative that may be old gets one trial only.
fn shortened<R: Residual>(
    problem: &R,
    unknowns: &Coordinates,
    residual: &Coordinates,
    step: &Coordinates,
    fresh: bool,
) -> Option<(Coordinates, Coordinates, R::State)> {
    let halvings = if fresh { 30 } else { 1 };
    (0..halvings).find_map(|halving| {
        let next = unknowns - step * libm::ldexp(1.0, -halving);
        let (left, state) = problem.at(&next)?;
        (left.norm() < residual.norm()).then_some((next, left, state))
    })
}

fn jacobian<R: Residual>(problem: &R, unknowns: &Coordinates, residual: &Coordinates) -> Option<Jacobian> {
    let mut jacobian = Jacobian::zeros();
    for (place, mut column) in jacobian.column_iter_mut().enumerate() {
        let mut moved = *unknowns;
        moved[place] += DIFFERENCE;
        column.copy_from(&((problem.at(&moved)?.0 - residual) / DIFFERENCE));
    }
    Some(jacobian)
}
