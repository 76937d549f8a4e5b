//! From one instant to the next: implicit in time, so that forces and motion agree at each.

use kapvik_firmware::rover::{Axes, PerWheel};

use super::balance::{Instant, Motion, WheelInstant, World};
use super::felt_slip::felt_slip_after;
use super::newton::{Newton, Residual};
use super::pose::{Coordinates, Pose};
use super::standing::{about_standing, standing_on_hubs};
use super::wheel_soil::WheelMotion;

/// The longest step, s.
const LONGEST_STEP_S: f64 = 0.05;
/// The shortest, s: where not even it finds a balance there is none.
const SHORTEST_STEP_S: f64 = 1.0e-5;

/// The last two instants, which the next follows from by the backward differentiation formula of second order. Where a
/// step finds no balance (wheels that start, stop or touch down), a shorter one is tried.
#[derive(Debug, Clone)]
pub struct Stepper {
    newton: Newton,
    time_s: f64,
    step_s: f64,
    last: Past,
    before: Past,
    /// Time between the last two instants, s.
    between_s: f64,
    rates: Coordinates,
    /// At the last instant: rim speeds, m/s, and the way of the rims, m.
    rims: (PerWheel<f64>, PerWheel<f64>),
    /// At the last instant: how the wheels moved, and the slip that the soil under them had felt.
    wheels: PerWheel<WheelMotion>,
    felt_slip: PerWheel<f64>,
}

/// The backward differentiation formula of second order for steps of unequal length:
/// h ẋ = a x − b x₋₁ + c x₋₂ with w = h/h₋₁, a = (1 + 2w)/(1 + w), b = 1 + w, c = w²/(1 + w).
#[derive(Debug, Clone, Copy)]
struct BackwardDifference {
    step_s: f64,
    now: f64,
    last: f64,
    before: f64,
}

impl BackwardDifference {
    fn new(step_s: f64, step_before_s: f64) -> Self {
        let ratio = step_s / step_before_s;
        let sum = 1.0 + ratio;
        Self { step_s, now: (sum + ratio) / sum, last: sum, before: ratio * ratio / sum }
    }

    /// The rate of a value.
    fn rate(&self, now: f64, last: f64, before: f64) -> f64 {
        (self.now * now - self.last * last + self.before * before) / self.step_s
    }

    /// The value that has these rates.
    fn value(&self, rate: &Coordinates, last: &Coordinates, before: &Coordinates) -> Coordinates {
        (rate * self.step_s + last * self.last - before * self.before) / self.now
    }
}

/// What is kept of an instant.
#[derive(Debug, Clone, Copy)]
struct Past {
    pose: Coordinates,
    centre_velocity_m_s: Axes<f64>,
}

/// The rover at rest: the unknowns are its place but for x, and in the place of x the speed at which it creeps, which is
/// what holds it on a slope.
struct AtRest<'a> {
    world: &'a World,
    x_m: f64,
}

impl Residual for AtRest<'_> {
    type State = Instant;
    fn at(&self, unknowns: &Coordinates) -> Option<(Coordinates, Instant)> {
        let mut pose = Pose::from(*unknowns);
        let rates = Pose { x: pose.x, ..Pose::default() };
        pose.x = self.x_m;
        let rim_speed_m_s = PerWheel::default();
        let (acceleration_m_s2, rim_way_m) = (Axes::default(), PerWheel::default());
        let felt_slip = PerWheel::default();
        let motion = Motion { pose, rates, acceleration_m_s2, rim_speed_m_s, rim_way_m, felt_slip };
        let instant = self.world.instant(&motion).ok()?;
        Some((instant.residual, instant))
    }
}

/// One step: the unknowns are the rates at its end.
struct Step<'a> {
    world: &'a World,
    stepper: &'a Stepper,
    difference: BackwardDifference,
    rim_speed_m_s: PerWheel<f64>,
    rim_way_m: PerWheel<f64>,
    felt_slip: PerWheel<f64>,
}

impl Residual for Step<'_> {
    type State = Instant;
    fn at(&self, rates: &Coordinates) -> Option<(Coordinates, Instant)> {
        let Stepper { last, before, .. } = self.stepper;
        let pose = Pose::from(self.difference.value(rates, &last.pose, &before.pose));
        let rates = Pose::from(*rates);
        let velocity = centre_velocity_m_s(self.world, &pose, &rates);
        let (last, before) = (last.centre_velocity_m_s, before.centre_velocity_m_s);
        let acceleration_m_s2 = Axes {
            x: self.difference.rate(velocity.x, last.x, before.x),
            y: self.difference.rate(velocity.y, last.y, before.y),
            z: self.difference.rate(velocity.z, last.z, before.z),
        };
        let Self { rim_speed_m_s, rim_way_m, felt_slip, .. } = *self;
        let motion = Motion { pose, rates, acceleration_m_s2, rim_speed_m_s, rim_way_m, felt_slip };
        let instant = self.world.instant(&motion).ok()?;
        Some((instant.residual, instant))
    }
}

/// No motion balances the forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoBalance {
    /// The time after which none does, s.
    pub after_s: f64,
}

impl Stepper {
    /// The rover standing at rest on all its wheels with its differential axis at x = 0; `None` where the ground does not hold it so.
    pub fn at_rest(world: &World) -> Option<(Self, Instant)> {
        let instant = [about_standing, standing_on_hubs].into_iter().find_map(|pose| {
            let solved = Newton::default().solve(&AtRest { world, x_m: 0.0 }, pose(world)?.into())?;
            // What balances on some of its wheels falls over.
            let bears = |wheel: &WheelInstant| wheel.forces.load_n > 0.0;
            solved.state.wheels.iter_wheels().all(bears).then_some(solved.state)
        })?;
        let past = Past { pose: instant.motion.pose.into(), centre_velocity_m_s: Axes::default() };
        let stepper = Self {
            newton: Newton::default(),
            time_s: 0.0,
            step_s: LONGEST_STEP_S,
            last: past,
            before: past,
            between_s: LONGEST_STEP_S,
            rates: Coordinates::zeros(),
            rims: (PerWheel::default(), PerWheel::default()),
            wheels: instant.wheels.map_wheels(|wheel| wheel.motion),
            felt_slip: PerWheel::default(),
        };
        Some((stepper, instant))
    }

    /// The instant at a later time, with the wheels at the rim speeds that are told of each time.
    ///
    /// None where it is there already.
    ///
    /// # Errors
    /// Where no balance is found.
    pub fn advance(
        &mut self,
        world: &World,
        to_s: f64,
        rim_speeds_m_s: impl Fn(f64) -> PerWheel<f64>,
    ) -> Result<Option<Instant>, NoBalance> {
        let mut reached = None;
        while self.time_s < to_s {
            let steps = libm::ceil((to_s - self.time_s) / self.step_s - 1.0e-6).max(1.0);
            let step_s = (to_s - self.time_s) / steps;
            let time_s = if steps > 1.0 { self.time_s + step_s } else { to_s };
            reached = self.step(world, step_s, rim_speeds_m_s(time_s));
            if reached.is_some() {
                self.time_s = time_s;
                self.step_s = (2.0 * step_s).min(LONGEST_STEP_S);
                continue;
            }
            self.step_s = 0.5 * step_s;
            if self.step_s < SHORTEST_STEP_S {
                return Err(NoBalance { after_s: self.time_s });
            }
        }
        Ok(reached)
    }

    /// One step; `None` where no balance is found: the next try makes its slopes anew, for those of this one have led nowhere.
    fn step(&mut self, world: &World, step_s: f64, rim_speed_m_s: PerWheel<f64>) -> Option<Instant> {
        let difference = BackwardDifference::new(step_s, self.between_s);
        let rim_way_m = self.rim_way_m(step_s, &rim_speed_m_s);
        let felt_slip = self.felt_slip(world, step_s);
        let mut newton = std::mem::take(&mut self.newton);
        let step = Step { world, stepper: self, difference, rim_speed_m_s, rim_way_m, felt_slip };
        let solved = newton.solve(&step, self.rates)?;
        let Motion { pose, rates, .. } = solved.state.motion;
        self.newton = newton;
        self.before = self.last;
        self.between_s = step_s;
        self.last = Past { pose: pose.into(), centre_velocity_m_s: centre_velocity_m_s(world, &pose, &rates) };
        self.rates = solved.unknowns;
        self.rims = (rim_speed_m_s, rim_way_m);
        self.wheels = solved.state.wheels.map_wheels(|wheel| wheel.motion);
        self.felt_slip = felt_slip;
        Some(solved.state)
    }

    /// The slip that the soil has felt at the end of a step, from how the wheels moved at its beginning: a step takes a small
    /// part of the contact's length.
    fn felt_slip(&self, world: &World, step_s: f64) -> PerWheel<f64> {
        let mut felt_slip = self.felt_slip;
        felt_slip.iter_wheels_mut().zip(self.wheels.iter_wheels()).for_each(|(felt, motion)| {
            *felt = felt_slip_after(step_s, *felt, motion, &world.rover.wheel);
        });
        felt_slip
    }

    /// The way of the rims at the end of a step, by the mean of the speeds at its ends.
    fn rim_way_m(&self, step_s: f64, rim_speed_m_s: &PerWheel<f64>) -> PerWheel<f64> {
        let (last_m_s, mut way_m) = self.rims;
        let speeds = last_m_s.iter_wheels().zip(rim_speed_m_s.iter_wheels());
        way_m.iter_wheels_mut().zip(speeds).for_each(|(way, (last, now))| *way += 0.5 * step_s * (last + now));
        way_m
    }
}

/// Velocity of the centre of mass in the world, m/s.
fn centre_velocity_m_s(world: &World, pose: &Pose, rates: &Pose) -> Axes<f64> {
    let (centre, turn) = (world.rover.suspension.centre_of_mass, pose.motion(rates).turn_rad_s);
    let swept = pose.into_world(Axes {
        x: turn.y * centre.z - turn.z * centre.y,
        y: turn.z * centre.x - turn.x * centre.z,
        z: turn.x * centre.y - turn.y * centre.x,
    });
    Axes { x: rates.x + swept.x, y: swept.y, z: rates.z + swept.z }
}
