//! The filters of one side, and what they say together.

use super::activity::{STANDING_M_S, TakenUp, take_up, what_it_does};
use super::attitude::Attitude;
use super::bogie_stop::AlongLinks;
use super::compaction::{Compaction, Correction};
use super::contact_angle::{self, ContactAngleFilter, SideReadings};
use super::digging_in::{DiggingIn, Rolled};
use super::doubt::Doubt;
use super::drawbar_split::DrawbarSplit;
use super::estimate::WheelActivity;
use super::hub_force::{self, ForceReadings, HubForceFilter};
use super::hub_on_ground::HubOnGround;
use super::joints::Joints;
use super::rim_speed::RimSpeed;
use super::scale::Scale;
use super::sensor_gate::Repeats;
use super::side_frame::{SENSORS, SideFrame};
use super::since_start::SinceStart;
use super::sinking::Sinking;
use super::slip_by_speeds::SpeedReadings;
use super::slip_torque::{self, DriveReadings, SlipTorqueFilter, WheelReadings};
use super::surprise::Surprises;
use super::track::{Met, Track};
use super::troubles::Troubles;
use super::turn::Turn;
use super::wheel_frame::WheelFrame;
use crate::filter::Innovation;
use crate::rover::{Axes, PerAxle, Planar, RollingMotion, Rover, Side, body_moment_nm};
use crate::scalar::Scalar;

/// A velocity of the axis that is off by so many standard deviations is a glitch, and nothing to tell the wheels.
const GLITCH: f64 = 8.0;
/// Below this force on its cell a wheel is lifted, over its load at rest; or below three standard deviations, but not above the other.
const LIFTED: f64 = 0.03;
const GREATEST_LIFTED: f64 = 0.09;
/// Where torques swing, wheels go up and down with the grousers, and links with them, which no sensor follows: one standard deviation of what
/// that adds to the speed of a hub, over the speed of its rim.
const SWINGS_HUB: f64 = 0.08;
/// What drifts with travel drifts a little at rest too: as if the wheel crept at this speed, m/s.
const CREEP: f64 = 1.0e-3;

/// The estimators of one side.
#[derive(Debug, Clone)]
pub(super) struct SideEstimator<S> {
    pub(super) rover: Rover<S>,
    y_m: S,
    pub(super) angles: ContactAngleFilter<S>,
    pub(super) wheels: PerAxle<SlipTorqueFilter<S>>,
    pub(super) forces: HubForceFilter<S>,
    pub(super) activity: PerAxle<WheelActivity>,
    since_start: PerAxle<SinceStart<S>>,
    pub(super) motion: RollingMotion<S>,
    pub(super) rims: RimSpeed<S>,
    /// Which wheels bear no load that their cells can tell from none.
    pub(super) lifted: PerAxle<bool>,
    /// Whether a wheel stands, or has just started.
    starts: bool,
    /// Whether the torque of a wheel swings.
    pub(super) swings: bool,
    /// Variance of the body's pitch where no accelerometer tells it: by that all contact angles err alike, which no force along them shows.
    pub(super) unfelt_pitch_variance: S,
    pub(super) digging_in: DiggingIn<S>,
    sinking: Sinking<S>,
    /// Of the front wheel, and of the bogie's two together.
    pub(super) compaction: [Compaction<S>; 2],
    /// What these tell of the contact angles.
    pub(super) corrections: PerAxle<Correction<S>>,
    pub(super) track: Track<S>,
    /// What the front wheel met where the middle and the rear wheel are.
    pub(super) met: [Option<Met<S>>; 2],
    /// By how much more of its load the middle wheel compacts the soil than the rear one, since they are on two soils.
    pub(super) unlike_share: S,
    pub(super) doubt: Doubt,
    /// One for a sensor that cannot be used in this frame.
    pub(super) silent: [S; SENSORS],
    /// Of the body, in yaw and in roll.
    turns: [Turn<S>; 2],
    told: SideInnovations<S>,
}

/// What the measurements of a side told its filters in the last frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideInnovations<S> {
    /// Filter 1 of each wheel: rate and speed of the hub.
    pub wheels: PerAxle<Innovation<S, { slip_torque::MEASUREMENTS }>>,
    /// Filter 2, contact angles: velocity of the axis forward and up, angles of rocker and bogie, pitch of the body.
    pub angles: Innovation<S, { contact_angle::MEASUREMENTS }>,
    /// Filter 2, forces: the cells, the moments on bogie and rocker.
    pub forces: Innovation<S, { hub_force::MEASUREMENTS }>,
}

impl<S: Scalar> SideEstimator<S> {
    /// Estimators that know the rover alone. `phase` spreads costly work over frames.
    #[inline(never)] // where it is written to is at hand then, which shortens each store; flash is scarce
    pub fn new(rover: &Rover<S>, side: Side, phase: usize) -> Self {
        let wheel = |place: usize| SlipTorqueFilter::new(rover, phase + place);
        let angles = ContactAngleFilter::new(rover, phase);
        let scale = Scale::of(rover);
        Self {
            rover: *rover,
            y_m: rover.suspension.y_m(side),
            motion: angles.motion(),
            angles,
            wheels: PerAxle { front: wheel(0), middle: wheel(1), rear: wheel(2) },
            forces: HubForceFilter::new(rover, phase),
            activity: PerAxle::default(),
            since_start: PerAxle::all(SinceStart::standing()),
            rims: RimSpeed::unheard(),
            lifted: PerAxle::all(false),
            starts: true,
            swings: false,
            unfelt_pitch_variance: S::zero(),
            digging_in: DiggingIn::new(&scale),
            sinking: Sinking::new(&scale),
            compaction: [Compaction::new(); 2],
            corrections: PerAxle::all(Correction::none()),
            track: Track::new(&rover.suspension),
            met: [None; 2],
            unlike_share: S::zero(),
            doubt: Doubt::new(rover, phase),
            silent: [S::zero(); SENSORS],
            turns: [Turn::new(); 2],
            told: SideInnovations {
                wheels: PerAxle::all(Innovation::nothing()),
                angles: Innovation::nothing(),
                forces: Innovation::nothing(),
            },
        }
    }

    /// How often its filters were in trouble.
    pub fn troubles(&self) -> Troubles {
        let of_wheels = self.wheels.as_array().map(SlipTorqueFilter::troubles);
        let all = of_wheels.into_iter().chain([self.angles.troubles(), self.forces.troubles()]);
        all.fold(Troubles::default(), Troubles::plus)
    }

    /// What the measurements told in the last frame.
    pub fn innovations(&self) -> &SideInnovations<S> {
        &self.told
    }

    /// Whether its wheels roll as they will: none starts, stops or stands.
    pub fn is_steady(&self) -> bool {
        self.settled().into_array().into_iter().all(|settled| settled)
    }

    /// Which wheels do.
    pub(super) fn settled(&self) -> PerAxle<bool> {
        self.since_start.map(|wheel| wheel.is_steady())
    }

    /// How fast this side travels, m/s, forward or back.
    pub fn speed_m_s(&self) -> S {
        self.motion.axis_velocity_m_s.length()
    }

    /// Of its wheels together, what [`SlipTorqueFilter::gained`] gives.
    pub fn gained(&self) -> [S; 2] {
        let gained = self.wheels.as_array().map(SlipTorqueFilter::gained);
        gained.into_iter().fold([S::zero(); 2], |[holds, share], [one, other]| [holds + one, share + other])
    }

    /// Whether its rims turn back, by more than encoders say of rims that stand.
    pub fn rolls_back(&self) -> bool {
        self.rims.speed_m_s() < S::constant(-STANDING_M_S)
    }

    /// What is known of its joints and of how the axis rises.
    pub fn joints(&self) -> &Joints<S> {
        self.angles.joints()
    }

    /// Takes a frame.
    pub fn tick(&mut self, step_s: S, frame: &SideFrame<S>, attitude: &Attitude<S>) -> Surprises {
        let mut surprises = Surprises::default();
        let frame = &self.without_glitches(step_s, frame, &mut surprises);
        self.doubt.take_turns(step_s.to_f32());
        self.unfelt_pitch_variance = attitude.unfelt_variance();
        let mut readings = self.side_readings(step_s, frame);
        self.silent = frame.silent(&readings.axis_velocity_m_s);
        self.follow_rims(step_s, &frame.wheel_rate_rad_s, readings.axis_velocity_m_s.x);
        let slopes = *self.sinking.slopes();
        let before = self.angles.angles();
        self.told.angles =
            self.angles.tick(step_s, self.rims.speed_m_s(), &slopes, attitude, &readings, &self.rover.noise);
        surprises.of_side(&self.told.angles);
        let [of_velocity, ..] = &self.told.angles.residuals;
        if of_velocity.is_beyond(S::constant(GLITCH)) {
            readings.axis_velocity_m_s.x = None;
        }
        // What the torques and the memory said of the frame before is asked once more, of the forces.
        let turned = self.angles.angles().zip(before).map(|(now, before)| now - before);
        let corrections = self.corrections.as_mut().zip(turned).into_array();
        corrections.into_iter().for_each(|(correction, by_rad)| correction.turn_path(by_rad));
        self.motion = self.angles.motion();
        let wheels = self.wheel_frames(&readings, self.angles.body_pitch());
        self.tick_wheels(step_s, frame, &wheels, &mut surprises);
        self.tick_forces(step_s, frame, attitude, &mut surprises);
        let loads = self.forces.beyond_rest_n().zip(frame.load_cell_n).map(|(load, cell)| cell.map(|_| load));
        let travel_m = self.speed_m_s() * step_s;
        self.sinking.follow(if self.rolls_back() { -travel_m } else { travel_m }, &loads);
        self.follow_compaction(travel_m);
        self.follow_track(step_s, frame.gyro_rad_s.z);
        surprises
    }

    /// The frame without what drives say of their torques where that is a glitch.
    fn without_glitches(&mut self, step_s: S, frame: &SideFrame<S>, surprises: &mut Surprises) -> SideFrame<S> {
        let mut frame = *frame;
        let travel_m = self.speed_m_s() * step_s;
        let wheels = self.wheels.as_mut().zip(self.since_start.as_ref()).zip(surprises.wheels.as_mut());
        let told = frame.motor_torque_nm.as_mut().zip(frame.wheel_rate_rad_s);
        for (((filter, since_start), surprise), (torque, rate)) in wheels.zip(told).into_array() {
            let readings = DriveReadings {
                torque_nm: *torque,
                torque_std_nm: self.rover.noise.motor_torque_nm,
                rate_rad_s: rate,
                settled: since_start.has_settled(),
            };
            let believed = filter.believed_torque_nm(step_s, travel_m, &readings);
            surprise.motor_torque = torque.is_some() && believed.is_none();
            *torque = believed;
        }
        frame
    }

    fn side_readings(&mut self, step_s: S, frame: &SideFrame<S>) -> SideReadings<S> {
        let (Axes { x, z, .. }, turning) = (frame.velocity_m_s, frame.gyro_rad_s);
        let [yaw, roll] = &mut self.turns;
        let (x, std_x) = yaw.at_end(x, turning.z, -self.y_m, step_s, &self.rover.noise);
        let (z, std_z) = roll.at_end(z, turning.x, self.y_m, step_s, &self.rover.noise);
        SideReadings {
            axis_velocity_m_s: Planar { x, z },
            velocity_std_m_s: Planar { x: std_x, z: std_z },
            rocker_angle_rad: frame.rocker_angle_rad,
            bogie_angle_rad: frame.bogie_angle_rad,
            runs_of_forces: self.forces.runs().above(contact_angle::RUN_OF_FORCES),
            starts: self.starts,
            turns_per_m: self.met.map(|met| met.map(|met| met.turns_per_m)),
        }
    }

    fn follow_rims(&mut self, step_s: S, rates: &PerAxle<Option<S>>, velocity_m_s: Option<S>) {
        let (rocker, bogie) = (self.motion.rocker_rate_rad_s, self.motion.bogie_rate_rad_s);
        let links = PerAxle { front: rocker, middle: bogie, rear: bogie };
        let speeds_m_s =
            rates.zip(links).map(|(rate, link)| rate.map(|rate| (rate - link) * self.rover.wheel.radius_m));
        self.rims.follow(step_s, &speeds_m_s, velocity_m_s);
    }

    fn tick_wheels(
        &mut self,
        step_s: S,
        frame: &SideFrame<S>,
        wheels: &PerAxle<WheelFrame<S>>,
        surprises: &mut Surprises,
    ) {
        let noise = &self.rover.noise;
        let roughness = self.angles.roughness();
        let swung_hub = if self.swings { S::constant(SWINGS_HUB) } else { S::zero() };
        let others_stand = self.rims.speed_m_s().abs() < S::constant(STANDING_M_S);
        let others_rad_s = self.rims.speed_m_s() / self.rover.wheel.radius_m;
        let (mut taken_up, mut swings) = (TakenUp::default(), false);
        let filters = self.wheels.as_mut().zip(self.activity.as_mut().zip(self.since_start.as_mut()));
        let told = self.told.wheels.as_mut().zip(surprises.wheels.as_mut());
        let rates = frame.wheel_rate_rad_s.zip(frame.wheel_rate_repeats);
        let inputs = wheels.as_ref().zip(rates.zip(frame.motor_torque_nm));
        for (((filter, (activity, since_start)), (told, surprise)), (wheel, ((rate, repeats), torque))) in
            filters.zip(told).zip(inputs).into_array()
        {
            let rate = rate.map(|rate| rate - wheel.link_rate_rad_s);
            if rate.is_none() && (others_stand || since_start.starts()) {
                filter.suppose_rate(others_rad_s);
            }
            // Of one that starts with the others the filter knows only that it stood, and would take it for blocked.
            let turns = since_start.starts() && !others_stand;
            let rim = self.rover.wheel.radius_m * filter.rate_before(rate, turns);
            let now = what_it_does(rim, wheel.hub_speed_m_s, *activity);
            let speeds = SpeedReadings {
                rate_rad_s: rate,
                hub_speed_m_s: wheel.measured_hub_speed_m_s.filter(|_| now == WheelActivity::Rolling),
                hub_speed_std_m_s: wheel.hub_speed_std_m_s + swung_hub * rim.abs(),
            };
            taken_up |= take_up(filter, (activity, since_start), now, &speeds, step_s);
            let speed = rim.abs().max(wheel.hub_speed_m_s.abs()).max(S::constant(CREEP));
            let readings = WheelReadings {
                speeds,
                rate_std_rad_s: noise.wheel_rate_rad_s * repeats.of_noise(),
                rate_repeats: repeats != Repeats::Not,
                side_swings: self.swings,
                shared_speed_std_m_s: noise.velocity_m_s,
                roughness,
                settled: since_start.has_settled(),
                link_rate_rad_s: wheel.link_rate_rad_s,
                rover_gained: frame.rover_gained,
                motor_torque_nm: torque,
                motor_torque_std_nm: noise.motor_torque_nm,
            };
            *told = filter.tick(step_s, speed * step_s, &readings);
            surprise.of_wheel(told);
            swings |= filter.swings();
        }
        self.note(taken_up, swings);
        let rolled = Rolled {
            stands: taken_up.stands,
            speed_m_s: self.speed_m_s(),
            rim_speed_m_s: self.rims.speed_m_s(),
            step_s,
        };
        self.digging_in.follow(&rolled, &mut self.angles);
    }

    /// What wheels that start, settle or swing make of the forces.
    fn note(&mut self, taken_up: TakenUp, swings: bool) {
        (self.starts, self.swings) = (taken_up.starts, swings);
        if taken_up.starts || swings {
            self.forces.unsettle();
        }
        if taken_up.settles {
            self.forces.settle();
        }
    }

    fn tick_forces(&mut self, step_s: S, frame: &SideFrame<S>, attitude: &Attitude<S>, surprises: &mut Surprises) {
        let torques = self.wheels.as_ref().zip(frame.motor_torque_nm).map(|(filter, motor)| {
            let [_, torque, _] = *filter.estimate().mean();
            let [_, variance, _] = filter.estimate().variances();
            let noise = self.rover.noise.motor_torque_nm;
            // White noise of the drive's sensor comes through the filter slower, not less: what counts over time is that
            // of the sensor. Without the sensor it is what the filter does not know.
            let held = motor.map_or(torque, |motor| filter.held_by_link_nm(motor, noise));
            (held, if motor.is_some() { noise * noise } else { variance + noise * noise })
        });
        let noise = &self.rover.noise;
        let body = body_moment_nm(&self.rover, attitude.specific_force_m_s2());
        let centre = self.rover.suspension.centre_of_mass;
        let arm_squared = centre.x * centre.x + centre.z * centre.z;
        let half = S::constant(0.5);
        let half_mass = half * self.rover.mass_kg;
        let body_variance = half_mass * half_mass * attitude.force_variance(noise.accel_m_s2) * arm_squared;
        let lifted = self.lifted;
        let readings = ForceReadings {
            cells_n: frame.load_cell_n,
            cell_std_n: noise.load_cell_n,
            bogie_hangs: lifted.middle || lifted.rear,
            all_roll: self.activity.into_array().into_iter().all(|activity| activity == WheelActivity::Rolling),
            bogie_moment_nm: (torques.middle.0 + torques.rear.0, (torques.middle.1 + torques.rear.1).sqrt()),
            rocker_moment_nm: (torques.front.0 - half * body, (torques.front.1 + body_variance).sqrt()),
        };
        let [.., rocker_pitch, bogie_pitch, _] = *self.angles.estimate().mean();
        let told = self.told_along_links();
        let travel = self.rims.speed_m_s().abs().max(S::constant(CREEP)) * step_s;
        self.told.forces = self.forces.tick((step_s, travel), bogie_pitch - rocker_pitch, &told, &readings);
        surprises.of_cells(&self.told.forces);
        self.lifted = self.lifted();
    }

    fn lifted(&self) -> PerAxle<bool> {
        let at_rest_n = self.rover.load_at_rest_n();
        let (least, greatest) = (S::constant(LIFTED) * at_rest_n, S::constant(GREATEST_LIFTED) * at_rest_n);
        let [front, middle, rear, ..] = self.forces.estimate().stds();
        self.forces
            .cells_n()
            .zip(PerAxle { front, middle, rear })
            .map(|(force, std)| force < (S::constant(3.0) * std).max(least).min(greatest))
    }

    /// What torques and loads tell of the forces along the links: by the split of a bogie's pull, and by what of the torques has not compacted
    /// the soil before.
    fn told_along_links(&self) -> AlongLinks<S> {
        let PerAxle { front, middle, rear } = self.on_ground(&self.forces.forces_n(), &self.corrections);
        let [of_front, of_bogie] = &self.compaction;
        let along = |pull: S, wheel: &HubOnGround<S>| pull * wheel.angle.1 - wheel.wheel.load_n * wheel.angle.0;
        let split = self.split_of_pull(&middle, &rear);
        let half = S::constant(0.5);
        let both = |sum: S| {
            [along(half * (sum + split.difference_n), &middle), along(half * (sum - split.difference_n), &rear)]
        };
        let [of_middle, of_rear] = both(middle.drawbar_pull_n + rear.drawbar_pull_n);
        let [told_of_middle, told_of_rear] = both(of_bogie.pull_n(&[&middle.wheel, &rear.wheel]));
        AlongLinks {
            are_known: of_front.is_known() && of_bogie.is_known(),
            difference_n: of_middle - of_rear,
            rocker_n: along(of_front.pull_n(&[&front.wheel]), &front),
            bogie_n: told_of_middle + told_of_rear,
        }
    }

    /// How the wheels of the bogie share their pull.
    #[inline(never)] // flash is scarcer than the time of a call
    pub(super) fn split_of_pull(&self, middle: &HubOnGround<S>, rear: &HubOnGround<S>) -> DrawbarSplit<S> {
        let sum = middle.drawbar_pull_n + rear.drawbar_pull_n;
        let wheels = (&middle.wheel, &rear.wheel);
        let split = DrawbarSplit::by_torque(wheels.0, wheels.1, sum).on_two_soils(wheels, self.unlike_share);
        split.while_digging(wheels, sum, self.digging_in.variance())
    }
}
