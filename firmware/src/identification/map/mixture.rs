//! Mean and spread of the posterior: normal in all directions but those of cohesion, shear modulus and friction angle, over
//! which it is summed.
//!
//! The logarithm of a small cohesion is anything from what the data allow at most downwards, and as the cohesion takes part
//! of the strength, friction angle and shear modulus go with it: the posterior is a bent ridge with one long end. Where the
//! slips are alike, another ridge runs from soils that are weak and hold early to ones that are strong and hold late; of one
//! instant, friction angle and modulus are known so little that the prior's ends bend them. Where these three are held, the
//! others are nearly normal. So cohesion, and what else is known little, are moved in equal steps from the mode to both
//! sides, the others are fitted anew at each, and the normal distributions are mixed with the weights of their
//! evidence (Laplace's approximation at each: L. Tierney, J. B. Kadane, J. Am. Stat. Assoc. 81 (1986) 82–86; summed over
//! the axes that are not normal: H. Rue, S. Martino, N. Chopin, J. R. Stat. Soc. B 71 (2009) 319–392). Equal weights in
//! equal steps of no more than one and a half standard deviations integrate a smooth bell to 3e-4.

use crate::scalar::Scalar;

use super::descent::{Patience, descend};
use super::normal::Normal;
use super::problem::{Fit, Held, Problem};
use super::unknowns::{COHESION, FRICTION, MODULUS, Point, UNKNOWNS, Unknowns};

/// Standard deviation of ln K at a given cohesion beyond which it is summed over too.
const WIDE_MODULUS: f64 = 0.1;
/// The same of φ, rad.
const WIDE_ANGLE: f64 = 0.02;

/// Mean and standard deviation of every unknown, in the units of the beliefs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moments<S> {
    pub mean: [S; UNKNOWNS],
    pub std: [S; UNKNOWNS],
    /// Descents' steps.
    pub steps: u16,
}

/// An axis along which the posterior is summed.
#[derive(Debug, Clone, Copy)]
struct Line<S> {
    place: usize,
    /// Distance of the steps in standard deviations.
    spacing: S,
    /// Most steps to either side.
    reach: usize,
    /// The summation ends where the logarithm of the evidence is lower by this.
    depth: S,
}

/// The posterior about its mode.
pub(super) fn moments<S: Scalar, const N: usize>(problem: &Problem<'_, S>, mode: &Fit<S, N>) -> Moments<S> {
    let unknowns = problem.forward.unknowns;
    let known = problem.known();
    let cohesion = Line { place: COHESION, spacing: S::constant(0.8), reach: 8, depth: S::constant(6.0) };
    let modulus = Line { place: MODULUS, spacing: S::constant(1.5), reach: 4, depth: S::constant(4.0) };
    let friction = Line { place: FRICTION, ..modulus };
    let given_cohesion = Normal::new(mode, &holding(&known, COHESION)).variances();
    let wide = |line: Line<S>, least: f64| {
        let variance = given_cohesion.get(line.place).copied().unwrap_or(S::zero());
        let std = variance.sqrt() * unknowns.slope(line.place, &mode.state.point);
        (std > S::constant(least)).then_some(line)
    };
    let lines = [Some(cohesion), wide(modulus, WIDE_MODULUS), wide(friction, WIDE_ANGLE)];
    let mut sum = Sum::about(unknowns, &mode.state.point);
    let steps = sum_over(problem, (mode, &Normal::new(mode, &known)), &known, &lines, S::one(), &mut sum);
    sum.moments(steps)
}

/// Adds up the normal distributions about fits at all steps along the lines, one line within the other: it calls itself once for
/// each line, of which there are three at most. Returns how many steps the descents took.
fn sum_over<S: Scalar, const N: usize>(
    problem: &Problem<'_, S>,
    (fit, normal): (&Fit<S, N>, &Normal<S>),
    held: &Held,
    lines: &[Option<Line<S>>],
    width: S,
    sum: &mut Sum<'_, S>,
) -> u16 {
    match lines {
        [None, rest @ ..] => sum_over(problem, (fit, normal), held, rest, width, sum),
        [Some(line), rest @ ..] if !sum.is_little(normal, width) => {
            let given = holding(held, line.place);
            let mut inner = 0;
            let steps = along(problem, (fit, normal), held, line, &mut |fit, normal, own| {
                inner += sum_over(problem, (fit, normal), &given, rest, width * own, sum);
            });
            steps + inner
        }
        _ => {
            sum.add(&fit.state.point, normal, width);
            0
        }
    }
}

/// What is done with a fit, the distribution about it and the width of the strip that it stands for.
type Visit<'a, S, const N: usize> = dyn FnMut(&Fit<S, N>, &Normal<S>, S) + 'a;

/// Visits fits in equal steps to both sides of `middle` along an axis, all other unknowns that are not held fitted anew, with
/// the distribution about each and the distance of the steps; `middle` alone where the unknown is held. `about` is the
/// distribution about `middle` before the axis is held. Returns how many steps the descents took.
fn along<S: Scalar, const N: usize>(
    problem: &Problem<'_, S>,
    (middle, about): (&Fit<S, N>, &Normal<S>),
    held: &Held,
    line: &Line<S>,
    visit: &mut Visit<'_, S, N>,
) -> u16 {
    if held.get(line.place).copied().unwrap_or(true) {
        visit(middle, about, S::one());
        return 0;
    }
    let column = about.covariances(line.place);
    let variance = column.get(line.place).copied().unwrap_or(S::one());
    let width = line.spacing * variance.sqrt().min(S::one());
    let towards = column.map(|covariance| covariance * width / variance);
    let held = holding(held, line.place);
    let about_middle = Normal::new(middle, &held);
    let bounds = problem.forward.unknowns.bounds(line.place);
    let floor = about_middle.ln_evidence - line.depth;
    let patience = Patience { steps: 4, gain: S::constant(1e-2), damping: S::constant(1e-3) };
    visit(middle, &about_middle, width);
    let mut steps = 0;
    for sign in [S::one(), -S::one()] {
        let mut from: Option<Fit<S, N>> = None;
        let mut shift = towards.map(|shift| sign * shift);
        for _ in 0..line.reach {
            let last = from.as_ref().unwrap_or(middle);
            let at = last.state.point;
            let reached = at.get(line.place).zip(shift.get(line.place)).map(|(at, shift)| *at + *shift);
            if !reached.is_some_and(|reached| reached >= bounds.0 && reached <= bounds.1) {
                break;
            }
            let Some(found) = descend(problem, last.beside(problem, &shift), &held, &patience) else { break };
            steps += found.steps;
            let normal = Normal::new(&found.fit, &held);
            visit(&found.fit, &normal, width);
            if normal.ln_evidence < floor {
                break;
            }
            shift = shifted(&found.fit.state.point, &at.map(|from| -from));
            from = Some(found.fit);
        }
    }
    steps
}

fn shifted<S: Scalar>(point: &Point<S>, shift: &Point<S>) -> Point<S> {
    let mut moved = *point;
    for (slot, shift) in moved.iter_mut().zip(shift) {
        *slot += *shift;
    }
    moved
}

/// One more unknown held.
fn holding(held: &Held, place: usize) -> Held {
    let mut more = *held;
    if let Some(slot) = more.get_mut(place) {
        *slot = true;
    }
    more
}

/// The mixture as it grows: weighted sums about values near its middle, the weights over the greatest so far.
#[derive(Debug, Clone, Copy)]
struct Sum<'a, S> {
    unknowns: &'a Unknowns<S>,
    origin: [S; UNKNOWNS],
    ln_greatest: Option<S>,
    total: S,
    first: [S; UNKNOWNS],
    second: [S; UNKNOWNS],
}

impl<'a, S: Scalar> Sum<'a, S> {
    fn about(unknowns: &'a Unknowns<S>, point: &Point<S>) -> Self {
        let zero = [S::zero(); UNKNOWNS];
        let origin = unknowns.values(point, |_, value| value);
        Self { unknowns, origin, ln_greatest: None, total: S::zero(), first: zero, second: zero }
    }

    /// Whether a strip of some width has so little weight that it may be taken for normal.
    fn is_little(&self, normal: &Normal<S>, width: S) -> bool {
        let ln_weight = normal.ln_evidence + width.ln();
        self.ln_greatest.is_some_and(|greatest| ln_weight < greatest - S::constant(3.0))
    }

    /// Adds the normal distribution about a point that stands for a strip of some width.
    fn add(&mut self, point: &Point<S>, normal: &Normal<S>, width: S) {
        let ln_weight = normal.ln_evidence + width.ln();
        if !ln_weight.is_finite() {
            return;
        }
        let before = self.ln_greatest.unwrap_or(ln_weight);
        let greatest = before.max(ln_weight);
        self.scale((before - greatest).exp());
        self.ln_greatest = Some(greatest);
        let weight = (ln_weight - greatest).exp();
        self.total += weight;
        let coordinates = point.iter().zip(normal.variances());
        let sums = self.first.iter_mut().zip(&mut self.second).zip(self.origin);
        for (place, (((first, second), origin), (mean, variance))) in sums.zip(coordinates).enumerate() {
            let (mean, variance) = self.unknowns.moments(place, *mean, variance);
            let away = mean - origin;
            *first += weight * away;
            *second += weight * (away * away + variance);
        }
    }

    fn scale(&mut self, factor: S) {
        self.total = self.total * factor;
        self.first = self.first.map(|sum| sum * factor);
        self.second = self.second.map(|sum| sum * factor);
    }

    fn moments(&self, steps: u16) -> Moments<S> {
        let shift = self.first.map(|sum| sum / self.total);
        let std = core::array::from_fn(|place| {
            let (square, mean) = (self.second.get(place), shift.get(place));
            let pair = square.copied().zip(mean.copied());
            pair.map_or(S::zero(), |(square, mean)| (square / self.total - mean * mean).max(S::zero()).sqrt())
        });
        Moments { mean: shifted(&self.origin, &shift), std, steps }
    }
}
