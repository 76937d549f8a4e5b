//! A rover that drives steadily on plane ground: at what slips and loads its wheels roll.
//!
//! Left and right are alike, so that one side carries half of the weight. Body and links are taken to lie along the ground.
//! The hub speed and the loads of the three wheels follow from four balances: force along the ground and across it, moment
//! of the bogie, moment of the rocker with its half of the body's.

use kapvik_firmware::rover::{
    Axes, Axle, HubContact, LinkAngles, PerAxle, Rover, Side, SideLayout, body_moment_nm, bogie_moment_nm,
    rocker_moment_nm,
};
use kapvik_firmware::terramechanics::Soil;
use nalgebra::{Matrix4, SMatrix, Vector4};

use crate::limit::response::{Response, respond_exactly};
use crate::prior::DEEPEST;

/// Balances of a side: force along the ground (N) and across it (N), moments of bogie and rocker (N·m).
pub type Balances = Vector4<f64>;

/// Changes of the balances with pull, load and torque of the wheels: three columns each, front to rear.
pub type BalanceSlopes = SMatrix<f64, 4, 9>;

/// What the drives are told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drives {
    /// Every wheel turns at its rim speed, m/s.
    Roll(PerAxle<f64>),
    /// The wheels of one axle spin at a rim speed (m/s) while those of the others are held, and the rover stands.
    Spin(Axle, f64),
}

/// A wheel in a steady drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyWheel {
    /// Slip.
    pub slip: f64,
    /// Load, N.
    pub load_n: f64,
    /// Rim speed, m/s.
    pub rim_speed_m_s: f64,
    /// What the soil does; none for a wheel that is held.
    pub response: Option<Response>,
}

/// A steady drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyDrive {
    /// Speed of the hubs, m/s.
    pub hub_speed_m_s: f64,
    /// The wheels of a side.
    pub wheels: PerAxle<SteadyWheel>,
}

/// The balances of one side of a rover on a slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideBalance {
    /// What the weight of half a rover puts into the balances.
    pub weight: Balances,
    /// Change of that with the pitch, 1/rad.
    pub weight_by_pitch: Balances,
    /// What the wheels put into them.
    pub by_wheels: BalanceSlopes,
}

/// Newton steps before a drive is given up.
const STEPS: usize = 60;
/// Imbalance that is left, over a wheel's part of the weight: above the rounding of the sinkages that are looked for.
const SETTLED: f64 = 1e-5;
/// The least load that a wheel may be left with, as a share of its part of the weight.
const LEAST_LOAD: f64 = 0.1;

impl SideBalance {
    /// On a slope, rad, uphill: the rover lies along the ground.
    pub fn new(rover: &Rover<f64>, slope_rad: f64) -> Self {
        let layout = SideLayout::new(rover, Side::Left, &LinkAngles::default());
        Self::at(rover, &layout, &PerAxle::all(HubContact::at(0.0)), slope_rad)
    }

    /// Of a side with its hubs where the layout has them, on these contacts in the body's axes, and the body at a pitch, rad.
    pub fn at(
        rover: &Rover<f64>,
        layout: &SideLayout<f64>,
        contacts: &PerAxle<HubContact<f64>>,
        pitch_rad: f64,
    ) -> Self {
        let weight = |along: f64, across: f64| {
            let specific_force = Axes { x: rover.gravity_m_s2 * along, y: 0.0, z: rover.gravity_m_s2 * across };
            let half_n = -0.5 * rover.mass_kg;
            let rocker_nm = 0.5 * body_moment_nm(rover, &specific_force);
            Balances::new(half_n * specific_force.x, half_n * specific_force.z, 0.0, rocker_nm)
        };
        let (sine, cosine) = libm::sincos(pitch_rad);
        let mut by_wheels = BalanceSlopes::zeros();
        for (place, mut column) in by_wheels.column_iter_mut().enumerate() {
            let one = |kind: usize| PerAxle::from_array([0, 1, 2].map(|axle| f64::from(3 * kind + axle == place)));
            column.copy_from(&balances(layout, contacts, &one(0), &one(1), &one(2)));
        }
        Self { weight: weight(sine, cosine), weight_by_pitch: weight(cosine, -sine), by_wheels }
    }

    fn of(&self, wheels: &[Answer; 3]) -> Balances {
        let values = |value: fn(&Answer) -> f64| wheels.each_ref().map(value);
        let [pulls, loads, torques] = [values(|w| w.pull_n), values(|w| w.load_n), values(|w| w.torque_nm)];
        let all: Vec<f64> = [pulls, loads, torques].concat();
        self.weight + self.by_wheels * SMatrix::<f64, 9, 1>::from_column_slice(&all)
    }
}

/// What pulls, loads and torques put into the balances.
fn balances(
    layout: &SideLayout<f64>,
    contacts: &PerAxle<HubContact<f64>>,
    pulls_n: &PerAxle<f64>,
    loads_n: &PerAxle<f64>,
    torques_nm: &PerAxle<f64>,
) -> Balances {
    let forces = contacts.zip(loads_n.zip(*pulls_n)).map(|(contact, (load, pull))| contact.hub_force_n(load, pull));
    let sum = forces.front + forces.middle + forces.rear;
    Balances::new(
        sum.x,
        sum.z,
        bogie_moment_nm(layout, &forces, torques_nm),
        rocker_moment_nm(layout, &forces, torques_nm),
    )
}

/// What a wheel puts into the balances, and how that changes with the load and with the unknown that all wheels share.
#[derive(Debug, Clone, Copy)]
struct Answer {
    pull_n: f64,
    load_n: f64,
    torque_nm: f64,
    pull_by_load: f64,
    torque_by_load: f64,
    pull_by_shared: f64,
    torque_by_shared: f64,
    slip: f64,
    response: Option<Response>,
}

/// The unknowns: the hub speed over `scale`, or the pull of a held wheel over its load; and the loads.
struct Problem<'a> {
    rover: &'a Rover<f64>,
    soil: &'a Soil<f64>,
    drives: Drives,
    balance: &'a SideBalance,
    /// Rim speed in which the hub speed is measured, m/s.
    scale: f64,
}

/// The steady drive of a rover on plane ground of a slope (rad, uphill); none where there is none that goes forward, or where
/// a wheel lifts or goes deeper than 0.6 of its radius.
pub fn steady_drive(
    rover: &Rover<f64>,
    soil: &Soil<f64>,
    balance: &SideBalance,
    drives: Drives,
) -> Option<SteadyDrive> {
    let (scale, start) = match drives {
        Drives::Roll(rims) => {
            let slowest = rims.into_array().into_iter().fold(f64::INFINITY, f64::min);
            (slowest, 0.9)
        }
        Drives::Spin(_, speed) => (speed, 0.0),
    };
    let problem = Problem { rover, soil, drives, balance, scale };
    let share_n = -balance.weight[1] / 3.0;
    let mut unknowns = Vector4::new(start, share_n, share_n, share_n);
    let mut wheels = problem.wheels(&unknowns)?;
    for _ in 0..STEPS {
        let residual = balance.of(&wheels);
        if residual.norm() < SETTLED * share_n {
            return problem.drive(&unknowns, &wheels, LEAST_LOAD * share_n);
        }
        let step = problem.slopes(&wheels).lu().solve(&residual)?;
        (unknowns, wheels) = problem.towards(&unknowns, &step, residual.norm(), share_n)?;
    }
    None
}

impl Problem<'_> {
    /// The longest share of a Newton step that makes the imbalance less; none where none does.
    fn towards(
        &self,
        from: &Vector4<f64>,
        step: &Vector4<f64>,
        imbalance: f64,
        share_n: f64,
    ) -> Option<(Vector4<f64>, [Answer; 3])> {
        const SHORTEST: f64 = 1e-3;
        let mut share = (0.3 / step[0].abs()).min(0.5 * share_n / step.fixed_rows::<3>(1).amax()).min(1.0);
        while share > SHORTEST {
            let to = from - step * share;
            if let Some(wheels) = self.wheels(&to)
                && self.balance.of(&wheels).norm() < imbalance
            {
                return Some((to, wheels));
            }
            share *= 0.5;
        }
        None
    }

    fn wheels(&self, unknowns: &Vector4<f64>) -> Option<[Answer; 3]> {
        let answer = |axle: Axle, load_n: f64| match self.drives {
            Drives::Roll(rims) => self.rolling(*rims.of(axle), unknowns[0] * self.scale, load_n),
            Drives::Spin(spinning, _) if spinning == axle => self.on_soil(1.0, 0.0, load_n),
            Drives::Spin(..) => Some(self.held(unknowns[0], load_n)),
        };
        Some([answer(Axle::Front, unknowns[1])?, answer(Axle::Middle, unknowns[2])?, answer(Axle::Rear, unknowns[3])?])
    }

    fn rolling(&self, rim_m_s: f64, hub_m_s: f64, load_n: f64) -> Option<Answer> {
        if hub_m_s <= 0.0 {
            return None;
        }
        let (slip, slip_by_speed) = if rim_m_s >= hub_m_s {
            (1.0 - hub_m_s / rim_m_s, -1.0 / rim_m_s)
        } else {
            (rim_m_s / hub_m_s - 1.0, -rim_m_s / (hub_m_s * hub_m_s))
        };
        self.on_soil(slip, slip_by_speed * self.scale, load_n)
    }

    fn on_soil(&self, slip: f64, slip_by_shared: f64, load_n: f64) -> Option<Answer> {
        if load_n <= 0.0 {
            return None;
        }
        let response = respond_exactly(&self.rover.wheel, self.soil, slip, load_n)?;
        Some(Answer {
            pull_n: response.value[0],
            load_n,
            torque_nm: response.value[1],
            pull_by_load: response.by_load[0],
            torque_by_load: response.by_load[1],
            pull_by_shared: response.by_slip[0] * slip_by_shared,
            torque_by_shared: response.by_slip[1] * slip_by_shared,
            slip,
            response: Some(response),
        })
    }

    /// A wheel that is held takes a part of the pull in proportion to its load, at its rim.
    fn held(&self, ratio: f64, load_n: f64) -> Answer {
        let radius = self.rover.wheel.radius_m;
        Answer {
            pull_n: ratio * load_n,
            load_n,
            torque_nm: radius * ratio * load_n,
            pull_by_load: ratio,
            torque_by_load: radius * ratio,
            pull_by_shared: load_n,
            torque_by_shared: radius * load_n,
            slip: 0.0,
            response: None,
        }
    }

    /// Change of the balances with the unknowns.
    fn slopes(&self, wheels: &[Answer; 3]) -> Matrix4<f64> {
        let by = &self.balance.by_wheels;
        let mut slopes = Matrix4::zeros();
        let mut by_shared = Balances::zeros();
        for (place, wheel) in wheels.iter().enumerate() {
            let (pull, load, torque) = (by.column(place), by.column(3 + place), by.column(6 + place));
            slopes.set_column(1 + place, &(pull * wheel.pull_by_load + load + torque * wheel.torque_by_load));
            by_shared += pull * wheel.pull_by_shared + torque * wheel.torque_by_shared;
        }
        slopes.set_column(0, &by_shared);
        slopes
    }

    fn drive(&self, unknowns: &Vector4<f64>, wheels: &[Answer; 3], least_load_n: f64) -> Option<SteadyDrive> {
        let deepest = DEEPEST * self.rover.wheel.radius_m;
        let stands = |wheel: &Answer| {
            wheel.load_n > least_load_n && wheel.response.is_none_or(|response| response.value[2] < deepest)
        };
        let (hub_speed_m_s, rims) = match self.drives {
            Drives::Roll(rims) => (unknowns[0] * self.scale, rims.into_array()),
            Drives::Spin(axle, speed) => {
                (0.0, Axle::ALL.map(|each| if each == axle { speed } else { 0.0 }).into_array())
            }
        };
        let of = |place: usize| SteadyWheel {
            slip: wheels[place].slip,
            load_n: wheels[place].load_n,
            rim_speed_m_s: rims[place],
            response: wheels[place].response,
        };
        let wheels_of_side = PerAxle::from_array([of(0), of(1), of(2)]);
        wheels.iter().all(stands).then_some(SteadyDrive { hub_speed_m_s, wheels: wheels_of_side })
    }
}
