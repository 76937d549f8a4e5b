//! The drives that can be asked for by name. Each draws its details from the seed.

use std::fmt::{self, Display, Formatter};

use clap::ValueEnum;
use kapvik_firmware::rover::{Axle, PerSide, PerWheel, Rover, Side};
use kapvik_firmware::terramechanics::Soil;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::course::{
    Course, Demand, HARD_SLIP, Hills, draw_equal_speeds, draw_hills, draw_programme, draw_soil, draw_spread_speeds,
    on_both_sides, pull_ratio,
};
use super::faults::{Failure, Fault};
use super::ground_soils::{Becomes, Change};
use super::programme::Command;
use super::terrain::{Shape, Terrain};
use super::varied_ground::draw_varied_ground;
use crate::data::sensor_channels::WHEEL_NAMES;
use crate::error::HostError;
use crate::prior::Range;

/// A kind of drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, ValueEnum)]
pub enum Scenario {
    /// A bit of all: slips spread on the level, hills, a slope, a rock, then another soil
    Traverse,
    /// Level ground, rim speeds equal to a percent or two
    Level,
    /// Level ground, slips spread from about 0.05 to 0.6 by individual rim speeds
    Spread,
    /// Left and right profiles of their own, slopes up to 15°
    Hills,
    /// A slope of 10°
    Slope,
    /// A steep rock or two of 6 to 8 cm, one under each side at most; the rover may be over both at once
    Rock,
    /// Hills, with sensors that give nothing for seconds, between 10 and 86 s
    Dropout,
    /// Start, stop, stand, back up, on level ground
    StartStop,
    /// A hole under one middle wheel alone, over which the bogie's stop holds it in the air
    WheelLift,
    /// One wheel does not turn for a while, between 15 and 38 s: a rear one is dragged along, another may hold the rover
    WheelBlocked,
    /// Level ground, slips spread, and a soil that becomes ice-cemented or sublimated
    SoilChange,
    /// Ground, soils and speeds of any kind: nearly level or steep, long hills or a rough surface, a ramp, stones; wheels slip
    /// little or much
    Varied,
}

/// When the rover starts, s.
const START_S: f64 = 1.0;

/// What a scenario is drawn from.
pub struct Draw<'a> {
    /// Random numbers.
    pub random: &'a mut ChaCha8Rng,
    /// The rover.
    pub rover: &'a Rover<f64>,
    /// The soil, where it is not to be drawn.
    pub soil: Option<Soil<f64>>,
}

impl Display for Scenario {
    /// By the name that the command line takes.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        self.to_possible_value().map_or(Ok(()), |value| formatter.write_str(value.get_name()))
    }
}

impl Scenario {
    /// A drive of this kind, from such a seed, that fails, and why.
    pub fn failed(self, seed: u64, why: impl Display) -> HostError {
        HostError::Failed(format!("{self}, seed {seed}: {why}"))
    }

    /// A drive of this kind; `None` where the prior has no soil on which this rover could do it.
    pub fn draw(self, draw: &mut Draw<'_>) -> Option<Course> {
        match self {
            Self::Traverse => draw.traverse(),
            Self::Level => draw.level(),
            Self::Spread => draw.spread(),
            Self::Hills => draw.hills(),
            Self::Slope => draw.slope(),
            Self::Rock => draw.rock(),
            Self::Dropout => draw.dropout(),
            Self::StartStop => draw.start_stop(),
            Self::WheelLift => draw.wheel_lift(),
            Self::WheelBlocked => draw.wheel_blocked(),
            Self::SoilChange => draw.soil_change(),
            Self::Varied => draw.varied(),
        }
    }
}

impl Draw<'_> {
    fn uniform(&mut self, low: f64, high: f64) -> f64 {
        self.random.random_range(low..high)
    }

    /// A level drive at equal speeds, to be changed, on a soil where each wheel can pull so much of its load.
    fn course(&mut self, pull_ratio: f64, duration_s: f64) -> Option<Course> {
        self.course_on(&Demand { pull_ratio, ..Demand::default() }, duration_s)
    }

    /// A level drive at slips that are spread, to be changed.
    fn spread_course(&mut self, pull_ratio: f64, duration_s: f64) -> Option<Course> {
        let mut course = self.course_on(&Demand { pull_ratio, spread: true, ..Demand::default() }, duration_s)?;
        let fastest = self.uniform(0.030, 0.036);
        let rim_speed_m_s = draw_spread_speeds(self.random, self.rover, &course.soil, fastest);
        course.programme.commands = vec![Command { from_s: START_S, rim_speed_m_s }];
        Some(course)
    }

    /// A level drive at equal speeds on the soil that was asked for, else on one that meets the demand.
    fn course_on(&mut self, demand: &Demand, duration_s: f64) -> Option<Course> {
        let soil = self.soil.or_else(|| draw_soil(self.random, self.rover, demand))?;
        let rim_speed = self.uniform(0.021, 0.028);
        let rim_speed_m_s = draw_equal_speeds(self.random, rim_speed);
        let programme = draw_programme(self.random, vec![Command { from_s: START_S, rim_speed_m_s }]);
        Some(Course {
            duration_s,
            terrain: Terrain::default(),
            soil,
            changes: Vec::new(),
            programme,
            bogie_stop_rad: f64::INFINITY,
            faults: Vec::new(),
        })
    }

    fn level(&mut self) -> Option<Course> {
        self.course(0.03, 60.0)
    }

    fn spread(&mut self) -> Option<Course> {
        self.spread_course(0.05, 60.0)
    }

    fn hills(&mut self) -> Option<Course> {
        let mut course = self.course(0.20, 90.0)?;
        course.terrain.sides = self.hills_between((0.36, 1.0e3));
        Some(course)
    }

    fn hills_between(&mut self, between_m: (f64, f64)) -> PerSide<Vec<Shape>> {
        let steepest_rad = (9.0_f64.to_radians(), 15.0_f64.to_radians());
        let wavelengths_m = Range::logarithmic(1.0, 4.0);
        let hills = Hills { waves: 3, wavelengths_m, steepest_rad };
        PerSide { left: draw_hills(self.random, between_m, &hills), right: draw_hills(self.random, between_m, &hills) }
    }

    fn slope(&mut self) -> Option<Course> {
        let mut course = self.course(0.22, 60.0)?;
        let slope = libm::tan(10.0_f64.to_radians());
        course.terrain = on_both_sides(vec![Shape::Ramp { between_m: (-1.0e3, 1.0e3), slope, rounding_m: 1.0 }]);
        Some(course)
    }

    fn rock(&mut self) -> Option<Course> {
        let mut course = self.course(0.20, 100.0)?;
        let first_m = self.uniform(0.5, 0.7);
        let first = self.rock_at(first_m);
        let sides = [
            Some(first),
            (self.random.random::<f64>() < 0.5).then(|| {
                let second_m = first_m + self.uniform(0.2, 0.6);
                self.rock_at(second_m)
            }),
        ]
        .map(|rock| rock.into_iter().collect::<Vec<_>>());
        let [left, right] = sides;
        let mirrored = self.random.random::<f64>() < 0.5;
        course.terrain.sides = if mirrored { PerSide { left: right, right: left } } else { PerSide { left, right } };
        Some(course)
    }

    fn rock_at(&mut self, from_m: f64) -> Shape {
        Shape::Bump { from_m, length_m: self.uniform(0.5, 0.65), height_m: self.uniform(0.06, 0.08) }
    }

    fn dropout(&mut self) -> Option<Course> {
        let mut course = self.hills()?;
        const PATTERNS: [&str; 8] = [
            "velocity_*",
            "load_cell_*",
            "motor_torque_*",
            "wheel_rate_*",
            "bogie_angle_*",
            "rocker_*",
            "gyro_*",
            "accel_*",
        ];
        let mut time_s = 10.0;
        while time_s < course.duration_s - 10.0 {
            let group = PATTERNS[self.random.random_range(0..PATTERNS.len())];
            // One wheel's or side's sensor more often than all.
            let wheel = WHEEL_NAMES[self.random.random_range(0..WHEEL_NAMES.len())];
            let side = if wheel.ends_with('l') { "l" } else { "r" };
            let one = match group {
                "load_cell_*" | "motor_torque_*" | "wheel_rate_*" => group.replace('*', &format!("{wheel}_*")),
                "bogie_angle_*" => group.replace('*', &format!("{side}_*")),
                whole => whole.to_owned(),
            };
            let length_s = self.uniform(1.0, 6.0);
            let fault = Fault::new(Failure::Dropout, &one, (time_s, time_s + length_s)).ok()?;
            course.faults.push(fault);
            time_s += length_s + self.uniform(1.0, 5.0);
        }
        Some(course)
    }

    fn start_stop(&mut self) -> Option<Course> {
        let mut course = self.course(0.03, 60.0)?;
        let ahead = course.programme.commands.first()?.rim_speed_m_s;
        let times = [(START_S, 1.0), (14.0, 0.0), (24.0, 0.7), (34.0, 0.0), (40.0, -1.0), (54.0, 0.0)];
        let late = self.uniform(0.0, 2.0);
        course.programme.commands = times
            .map(|(from_s, share)| Command {
                from_s: if from_s > START_S { from_s + late } else { from_s },
                rim_speed_m_s: ahead.map_wheels(|speed| share * speed),
            })
            .to_vec();
        Some(course)
    }

    fn wheel_lift(&mut self) -> Option<Course> {
        let mut course = self.course(0.15, 70.0)?;
        let side = self.side();
        let hole = Shape::Bump {
            from_m: self.uniform(0.20, 0.30),
            length_m: self.uniform(0.7, 0.8),
            height_m: -self.uniform(0.11, 0.12),
        };
        // A middle wheel alone can hang: front and rear hold its side level, where any other two would tip it.
        course.terrain.under_one = Some((side, Axle::Middle, hole));
        course.bogie_stop_rad = self.uniform(8.0, 10.0).to_radians();
        Some(course)
    }

    fn side(&mut self) -> Side {
        if self.random.random::<f64>() < 0.5 { Side::Left } else { Side::Right }
    }

    fn wheel_blocked(&mut self) -> Option<Course> {
        let mut course = self.course(0.20, 60.0)?;
        let free = course.programme.commands.first()?.rim_speed_m_s;
        // A rear wheel is dragged along; one further ahead mostly digs in and holds the rover while the others spin.
        let axles = [Axle::Front, Axle::Middle, Axle::Rear, Axle::Rear];
        let axle = axles[self.random.random_range(0..axles.len())];
        let mut blocked: PerWheel<f64> = free;
        *blocked.of_mut(self.side()).of_mut(axle) = 0.0;
        let from_s = self.uniform(15.0, 20.0);
        let until_s = from_s + self.uniform(12.0, 18.0);
        course.programme.commands.push(Command { from_s, rim_speed_m_s: blocked });
        course.programme.commands.push(Command { from_s: until_s, rim_speed_m_s: free });
        Some(course)
    }

    fn soil_change(&mut self) -> Option<Course> {
        let mut course = self.spread_course(0.10, 120.0)?;
        let becomes = if self.random.random::<f64>() < 0.5 { Becomes::IceCemented } else { Becomes::Sublimated };
        course.changes = vec![Change { from_m: self.uniform(0.75, 0.85), becomes }];
        Some(course)
    }

    fn varied(&mut self) -> Option<Course> {
        const DURATION_S: f64 = 90.0;
        let spread = self.random.random::<f64>() < 0.5;
        let mut course = if spread {
            let pull_ratio = self.uniform(0.05, 0.22);
            self.spread_course(pull_ratio, DURATION_S)?
        } else {
            // A soil of the prior seldom makes wheels slip much, so that slips are drawn instead of soils.
            let slip = self.uniform(0.03, 0.5);
            let demand = Demand { pull_ratio: 0.05, level_slip: (0.85 * slip, 1.15 * slip), ..Demand::default() };
            self.course_on(&demand, DURATION_S)?
        };
        let pace = self.uniform(0.5, 1.1);
        for command in &mut course.programme.commands {
            command.rim_speed_m_s = command.rim_speed_m_s.map_wheels(|speed| pace * speed);
        }
        let (climbs, _) = pull_ratio(self.rover, &course.soil, HARD_SLIP)?;
        course.terrain.sides = draw_varied_ground(self.random, climbs);
        Some(course)
    }

    fn traverse(&mut self) -> Option<Course> {
        let mut course = self.spread_course(0.22, 150.0)?;
        let rim_speed = self.uniform(0.026, 0.028);
        let equal = Command { from_s: 35.0, rim_speed_m_s: draw_equal_speeds(self.random, rim_speed) };
        course.programme.commands.push(equal);
        let mut sides = self.hills_between((0.7, 2.0));
        let slope = libm::tan(self.uniform(5.0, 8.0).to_radians());
        let ramp = Shape::Ramp { between_m: (1.6, 2.4), slope, rounding_m: 0.5 };
        sides.as_array_mut().into_iter().for_each(|shapes| shapes.push(ramp));
        let rock_m = self.uniform(2.2, 2.3);
        let rock = self.rock_at(rock_m);
        let side = self.side();
        sides.of_mut(side).push(rock);
        course.terrain.sides = sides;
        let becomes = if self.random.random::<f64>() < 0.5 { Becomes::IceCemented } else { Becomes::Sublimated };
        course.changes = vec![Change { from_m: self.uniform(2.6, 2.7), becomes }];
        Some(course)
    }
}
