//! A simulated drive, frame by frame.

use std::collections::VecDeque;

use kapvik_firmware::rover::{Axes, PerSide, Rover, Side};
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_firmware::terramechanics::Soil;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;

use super::audit::imbalance;
use super::balance::{Instant, Motion, WheelInstant, World};
use super::effects::RoverEffects;
use super::faults::{Fault, Faults};
use super::ground_soils::{Change, SoilsAlongTheWay};
use super::programme::Programme;
use super::scenario::{Draw, Scenario};
use super::sensors::{add_noise, readings};
use super::sliding::Sliding;
use super::stepper::{NoBalance, Stepper};
use crate::data::rover_file::RoverFile;
use crate::data::sensor_channels::standard_deviations;
use crate::data::truth_file::{TrueSoil, Truth, WheelTruth};
use crate::data::wheel_file::Grousers;

/// What every frame's bodies balance to, N and N·m.
pub const BALANCE: f64 = 1.0e-6;
/// Frames a second, unless asked otherwise.
pub const RATE_HZ: f64 = 10.0;

/// What can be asked of a drive beside its scenario.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// How long it takes, s; absent: as long as the scenario.
    pub duration_s: Option<f64>,
    /// Frames a second; absent: [`RATE_HZ`].
    pub rate_hz: Option<f64>,
    /// The soil it begins on; absent: drawn.
    pub soil: Option<Soil<f64>>,
    /// Another soil under the wheels of the right side; absent: the same.
    pub right_soil: Option<Soil<f64>>,
    /// Changes of the soil, in place of the scenario's; absent: the scenario's.
    pub changes: Option<Vec<Change>>,
    /// The wheels' grousers, which act only through an effect; absent: those of the assumed set K0.
    pub grousers: Option<Grousers>,
    /// When every wheel begins to turn the other way, s; absent: never.
    pub turns_back_s: Option<f64>,
    /// Effects on soil, sensors and drives.
    pub effects: RoverEffects,
    /// Faults of sensors, beside those of the scenario.
    pub faults: Vec<Fault>,
}

/// Why a drive ended before its time.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SimulationError {
    /// The prior has no soil for it.
    #[error("no soil of the prior carries this rover through this scenario: give one with --soil")]
    NoSoil,
    /// The wheels have no size.
    #[error("rolling-radius: expected one that leaves the wheels a radius above 0 m")]
    NoRadius,
    /// The rover cannot stand where it should start.
    #[error(
        "the rover does not stand on all its wheels where it should start: the soil is too weak for its weight, or its suspension \
         lifts a wheel"
    )]
    Standing,
    /// No motion balances the forces.
    #[error(
        "at {time_s:.2} s, {x_m:.2} m from the start, no motion balances the forces: the soil is too weak or the ground too \
         steep for this rover"
    )]
    Stuck {
        /// When, s.
        time_s: f64,
        /// Where, m.
        x_m: f64,
    },
    /// The soil does not give the pull.
    #[error(
        "at {time_s:.2} s, {x_m:.2} m from the start, the rover slides back while its wheels drive on: the soil is too weak or \
         the ground too steep for this rover"
    )]
    SlidesBack {
        /// When, s.
        time_s: f64,
        /// Where, m.
        x_m: f64,
    },
    /// A frame failed the independent check of its balance.
    #[error("at {time_s} s a body is out of balance by {worst} N or N·m: expected at most {BALANCE}")]
    Unbalanced {
        /// When, s.
        time_s: f64,
        /// By how much, N or N·m.
        worst: f64,
    },
}

/// A drive: an iterator over its frames, each with what was true. It ends at the first error.
#[derive(Debug, Clone)]
pub struct Traverse {
    world: World,
    programme: Programme,
    effects: RoverEffects,
    faults: Faults,
    stepper: Stepper,
    instant: Instant,
    sliding: Sliding,
    noise: SensorFrame,
    random: ChaCha8Rng,
    /// What the velocimeter would have said at the last instants, with their times in s.
    velocities: VecDeque<(f64, Axes<Option<f32>>)>,
    rate_hz: f64,
    frames: u64,
    next: u64,
}

impl Traverse {
    /// A drive of a scenario. The same arguments give the same frames, to the bit.
    ///
    /// # Errors
    /// Where no soil allows it, or the rover does not stand at its start.
    pub fn new(scenario: Scenario, seed: u64, rover: &Rover<f64>, options: &Options) -> Result<Self, SimulationError> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut draw = Draw { random: &mut random, rover, soil: options.soil };
        let course = scenario.draw(&mut draw).ok_or(SimulationError::NoSoil)?;
        let mut truly = *rover;
        let excess = options.effects.library.rolling_radius.map_or(0.0, |wrong| wrong.excess);
        truly.wheel.radius_m = rover.wheel.radius_m / (1.0 + excess) + options.effects.rolling_radius_m;
        if truly.wheel.radius_m <= 0.0 {
            return Err(SimulationError::NoRadius);
        }
        let mut programme = course.programme;
        if let Some(share) = options.effects.rim_wander {
            programme.wander.iter_wheels_mut().for_each(|wander| wander.share = share);
        }
        if let Some(at_s) = options.turns_back_s {
            programme.turn_back(at_s);
        }
        let grousers = options.grousers.unwrap_or(RoverFile::assumed().grousers);
        let changes = options.changes.clone().unwrap_or(course.changes);
        let world = World {
            rover: truly,
            terrain: course.terrain,
            soils: SoilsAlongTheWay::new(
                PerSide { left: course.soil, right: options.right_soil.unwrap_or(course.soil) },
                &changes,
            ),
            grousers: grousers.of_library(),
            effects: options.effects.library,
            bogie_stop_rad: course.bogie_stop_rad,
        };
        let (stepper, instant) = Stepper::at_rest(&world).ok_or(SimulationError::Standing)?;
        let rate_hz = options.rate_hz.unwrap_or(RATE_HZ);
        // A stream of its own: what is drawn for the course does not move the noise.
        random.set_stream(1);
        random.set_word_pos(0);
        Ok(Self {
            world,
            programme,
            effects: options.effects,
            faults: Faults::new([course.faults, options.faults.clone()].concat()),
            stepper,
            instant,
            sliding: Sliding::default(),
            noise: standard_deviations(&rover.noise.map(|std| std as f32)),
            random,
            velocities: VecDeque::new(),
            rate_hz,
            frames: frames_within(options.duration_s.unwrap_or(course.duration_s), rate_hz),
            next: 0,
        })
    }

    /// How many frames it has, those that a fault loses among them.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// The soils, ground and rover that it goes over.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The rover at the frame that was given last.
    pub fn instant(&self) -> &Instant {
        &self.instant
    }

    /// All frames.
    ///
    /// # Errors
    /// The first.
    pub fn run(self) -> Result<Vec<(SensorFrame, Truth)>, SimulationError> {
        self.collect()
    }

    /// Time of a frame, µs.
    fn time_us(&self, frame: u64) -> u64 {
        frame_time_us(frame, self.rate_hz)
    }

    fn advance(&mut self) -> Result<(), SimulationError> {
        let to_s = 1.0e-6 * self.time_us(self.next) as f64;
        let rim_speeds = |time_s: f64| self.programme.at(time_s).map_wheels(|turn| turn.rim_speed_m_s);
        let reached = self.stepper.advance(&self.world, to_s, rim_speeds);
        let x_m = self.instant.motion.pose.x;
        let reached = reached.map_err(|NoBalance { after_s }| SimulationError::Stuck { time_s: after_s, x_m })?;
        self.instant = reached.unwrap_or(self.instant);
        let Motion { pose, rim_speed_m_s, .. } = &self.instant.motion;
        match self.sliding.is_seen(rim_speed_m_s, pose.x) {
            true => Err(SimulationError::SlidesBack { time_s: to_s, x_m: pose.x }),
            false => Ok(()),
        }
    }

    /// The frame of the present instant; `None` where a fault loses it.
    fn frame(&mut self) -> Result<Option<(SensorFrame, Truth)>, SimulationError> {
        let time_us = self.time_us(self.next);
        let time_s = 1.0e-6 * time_us as f64;
        let worst = imbalance(&self.world, &self.instant).worst();
        if worst.is_nan() || worst > BALANCE {
            return Err(SimulationError::Unbalanced { time_s, worst });
        }
        let turns = self.programme.at(time_s);
        let mut frame = readings(&self.world, &self.instant, &turns, time_s, &self.effects);
        frame.time_us = time_us;
        frame.velocity_m_s = self.late_velocity(time_s, frame.velocity_m_s);
        add_noise(&mut frame, &self.noise, &mut self.random);
        let truth = self.truth(time_us);
        Ok(self.faults.applied(&frame).map(|frame| (frame, truth)))
    }

    /// What the velocimeter says, as late as it is: between the two frames around that time.
    fn late_velocity(&mut self, time_s: f64, now: Axes<Option<f32>>) -> Axes<Option<f32>> {
        let seen_s = time_s - self.effects.latency_s;
        self.velocities.push_back((time_s, now));
        while self.velocities.get(1).is_some_and(|(after_s, _)| *after_s <= seen_s) {
            self.velocities.pop_front();
        }
        let Some(&(before_s, before)) = self.velocities.front() else { return now };
        let Some(&(after_s, after)) = self.velocities.get(1) else { return before };
        let share = ((seen_s - before_s) / (after_s - before_s)).clamp(0.0, 1.0) as f32;
        let mix = |before: Option<f32>, after: Option<f32>| Some(before? + share * (after? - before?));
        Axes { x: mix(before.x, after.x), y: mix(before.y, after.y), z: mix(before.z, after.z) }
    }

    fn truth(&self, time_us: u64) -> Truth {
        let pose = self.instant.motion.pose;
        let world = &self.world;
        let soil = |soil: Soil<f64>| true_soil(&soil, world.rover.wheel.width_m);
        let wheel = |side: Side, wheel: &WheelInstant| WheelTruth {
            slip: wheel.motion.slip(),
            resistive_torque_nm: wheel.forces.torque_nm,
            contact_angle_rad: wheel.contact_angle_rad,
            normal_load_n: wheel.forces.load_n,
            drawbar_pull_n: wheel.forces.drawbar_pull_n,
            sinkage_m: wheel.motion.sinkage_m.max(0.0),
            side_force_n: wheel.side_force_n,
            soil: soil(world.soils.under(side, pose.x + pose.into_world(wheel.hub_m).x)),
        };
        Truth {
            time_us,
            wheels: Side::ALL
                .zip(self.instant.wheels)
                .map(|(side, wheels)| wheels.map(|instant| wheel(side, &instant))),
            soil: soil(world.soils.at(pose.x)),
            x_m: pose.x,
            z_m: pose.z,
            pitch_rad: pose.pitch,
            roll_rad: pose.roll,
        }
    }
}

impl Iterator for Traverse {
    type Item = Result<(SensorFrame, Truth), SimulationError>;
    fn next(&mut self) -> Option<Self::Item> {
        while self.next < self.frames {
            let advanced = if self.next > 0 { self.advance() } else { Ok(()) };
            let frame = advanced.and_then(|()| self.frame());
            self.next = if frame.is_err() { self.frames } else { self.next + 1 };
            if let Some(frame) = frame.transpose() {
                return Some(frame);
            }
        }
        None
    }
}

/// Time of a frame of so many a second, µs.
pub fn frame_time_us(frame: u64, rate_hz: f64) -> u64 {
    libm::round(frame as f64 * 1.0e6 / rate_hz) as u64
}

/// Frames of a drive, from its start on; the last may be at its end.
fn frames_within(duration_s: f64, rate_hz: f64) -> u64 {
    // The product of a whole number of frames may fall short of it by rounding.
    const ROUNDING: f64 = 1.0e-6;
    1 + libm::floor(duration_s * rate_hz + ROUNDING) as u64
}

fn true_soil(soil: &Soil<f64>, width_m: f64) -> TrueSoil {
    TrueSoil {
        cohesion_pa: soil.cohesion_pa,
        friction_angle_rad: soil.friction_angle_rad,
        shear_modulus_m: soil.shear_modulus_m,
        stiffness_pa_m_n: soil.stiffness(width_m),
        sinkage_exponent: soil.sinkage_exponent,
    }
}

#[cfg(test)]
mod tests {
    use super::frames_within;

    #[test]
    fn the_last_frame_is_at_the_end() {
        for rate_hz in [1.0, 4.0, 10.0, 20.0, 30.0, 50.0, 100.0] {
            for hundredths in 1..=3000_u64 {
                let duration_s = hundredths as f64 / 100.0;
                // Whole hundredths of frames: exact.
                let expected = 1 + hundredths * rate_hz as u64 / 100;
                assert_eq!(frames_within(duration_s, rate_hz), expected, "{duration_s} s at {rate_hz} Hz");
            }
        }
    }
}
