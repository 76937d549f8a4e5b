//! The soil under each wheel at each instant, and under the rover over time.

use heapless::Vec;

use super::resistance_watch::Stiffness;
use super::rover_soil::RoverSoil;
use super::soil_average::SoilAverage;
use super::soil_change::SoilChangeDetector;
use crate::estimator::{Estimate, WheelActivity, WheelEstimate};
use crate::frozen;
use crate::math;
use crate::rover::{PerSide, PerWheel, Rover};
use crate::soil::{Refusal, SoilEstimate, is_known_slip, rover_outputs, wheel_soil};
use crate::terramechanics::Wheel;
use crate::wheel_state::{SoilQuery, WHEELS, WheelNoise, WheelState};

/// What is left of a standard deviation that averages away, when the network is asked what lasts.
const HARDLY_ANY: f32 = 0.2;

/// A wheel whose slip is known no better, as one without an encoder, is left out of the soil under the rover: the network is told one standard
/// deviation of slip for all wheels.
const UNTOLD_SLIP: f32 = 0.1;

/// A wheel whose pull is known by so many times less than that of the best one is left out: the network is told one standard deviation of
/// pull for all wheels, and takes what they are off by for chance, wheel by wheel. Where a load cell or a bogie's angle is silent it is not.
const WORSE_KNOWN: f32 = 2.0;
/// A pull whose standard deviation is less than this share of the rover's weight, or 1.5 % of what a wheel carries, is known well.
const WELL_KNOWN: f32 = 0.0025;

/// The networks' users in flight.
#[derive(Debug, Clone)]
pub struct SoilOverTime {
    wheel: Wheel<f32>,
    /// A pull that is known so well, N, takes part whatever the others do.
    well_known_n: f32,
    average: SoilAverage,
    changes: SoilChangeDetector,
    /// Which side rolled back when its front wheel last rolled.
    backward: PerSide<bool>,
    /// Whether the angles of contacts are surmised. The networks know no such errors.
    surmises_contacts: bool,
    /// Every other frame the rover network is asked what would last without noise.
    asks_what_lasts: bool,
}

impl SoilOverTime {
    /// Nothing is known of the soil.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn new(rover: &Rover<f32>) -> Self {
        let suspension = &rover.suspension;
        let wheelbase_m = suspension.front_hub.x - (suspension.bogie_pivot.x + suspension.rear_hub.x);
        Self {
            wheel: rover.wheel,
            well_known_n: WELL_KNOWN * rover.mass_kg * rover.gravity_m_s2,
            average: SoilAverage::new(false),
            changes: SoilChangeDetector::new(rover.wheel.radius_m, wheelbase_m),
            backward: PerSide::both(false),
            surmises_contacts: false,
            asks_what_lasts: false,
        }
    }

    /// Takes the wheels after some travel, m, which side rolls back, and whether angles of contacts are surmised. Writes the soil under each
    /// to `wheel_soils`, and gives that under the rover.
    pub fn tick(
        &mut self,
        wheels: &PerWheel<WheelEstimate>,
        backward: PerSide<bool>,
        travel_m: f32,
        surmises_contacts: bool,
        wheel_soils: &mut PerWheel<Result<SoilEstimate, Refusal>>,
    ) -> Result<RoverSoil, Refusal> {
        self.surmises_contacts = surmises_contacts;
        let mirrored;
        let wheels = if backward.left || backward.right {
            mirrored = in_direction_of_travel(wheels, backward);
            &mirrored
        } else {
            wheels
        };
        let left_again = self.follow_direction(wheels, backward);
        for (soil, wheel) in wheel_soils.iter_wheels_mut().zip(wheels.iter_wheels()) {
            *soil = self.under_wheel(wheel);
        }
        let change = self.changes.tick(wheels, travel_m);
        if change.is_some() || left_again {
            self.average = SoilAverage::new(change == Some(Stiffness::Rises));
        }
        self.under_rover(wheels, travel_m)
    }

    /// Whether the rover turned back off a soil that it was on its way onto.
    fn follow_direction(&mut self, wheels: &PerWheel<WheelEstimate>, backward: PerSide<bool>) -> bool {
        let before = self.backward;
        let rolls = wheels.as_ref().map(|side| side.front.activity == WheelActivity::Rolling);
        self.backward = rolls.zip(backward.zip(before)).map(|(rolls, (now, before))| if rolls { now } else { before });
        self.backward != before && self.changes.turn_back()
    }

    /// The per-wheel network is not told the slope, which would tell it what all wheels pull together: it has learned that from rovers whose
    /// slips were drawn one by one, while those of a rover that drives hang on each other and on the soil.
    fn under_wheel(&self, wheel: &WheelEstimate) -> Result<SoilEstimate, Refusal> {
        let state = state_of(wheel).ok_or(Refusal::NotRolling)?;
        // What the wheels share: the one that is asked for stands by itself.
        let shared = SoilQuery { wheel: self.wheel, noise: noise_of(wheel), slope: None, wheels: Vec::new() };
        wheel_soil(&shared, &state)
    }

    /// The wheels that the rover network is told of: known, on the newest soil, and known not much worse than the best.
    #[inline(never)] // flash is scarcer than the time of a call
    fn taking_part(&self, wheels: &PerWheel<WheelEstimate>) -> PerWheel<bool> {
        let newest = self.changes.on_newest_soil();
        let std = |(wheel, newest): (&WheelEstimate, bool)| {
            if newest && is_known(wheel) { wheel.drawbar_pull_n.std } else { f32::INFINITY }
        };
        let stds = wheels.as_ref().zip(newest).map(|(side, newest)| side.as_ref().zip(newest).map(std));
        let least = stds.iter_wheels().fold(f32::INFINITY, |least, std| if *std < least { *std } else { least });
        let most = if WORSE_KNOWN * least > self.well_known_n { WORSE_KNOWN * least } else { self.well_known_n };
        stds.map_wheels(|std| std < most)
    }

    fn under_rover(&mut self, wheels: &PerWheel<WheelEstimate>, travel_m: f32) -> Result<RoverSoil, Refusal> {
        let taking_part = self.taking_part(wheels);
        let mut states = Vec::<WheelState, WHEELS>::new();
        let mut squares = [0.0_f32; 4];
        let mut shared = 0.0;
        for (wheel, _) in wheels.iter_wheels().zip(taking_part.iter_wheels()).filter(|(_, takes_part)| **takes_part) {
            let WheelNoise { drawbar_pull_n, load_n, torque_nm, slip, .. } = noise_of(wheel);
            let stds = [drawbar_pull_n, load_n, torque_nm, slip];
            squares.iter_mut().zip(stds).for_each(|(square, std)| *square += std * std);
            shared += wheel.shared_slip_std * wheel.shared_slip_std;
            state_of(wheel).into_iter().for_each(|state| {
                let _ = states.push(state);
            });
        }
        if states.is_empty() {
            // While nothing rolls, what was learned stays.
            return self.fused(taking_part, Refusal::NotRolling);
        }
        let count = states.len() as f32;
        let [drawbar_pull_n, load_n, torque_nm, slip] = squares.map(|square| math::sqrt(square / count));
        let noise = WheelNoise { drawbar_pull_n, load_n, torque_nm, slip, sinkage_m: 1.0 };
        let query = SoilQuery { wheel: self.wheel, noise, slope: None, wheels: states };
        // What a network refuses to look at leaves what was learned before.
        let refusal = self.take(query, math::sqrt(shared / count), travel_m).err();
        self.fused(taking_part, refusal.unwrap_or(Refusal::NotRolling))
    }

    /// Asks the rover network, in turn as it is and what would last without noise.
    fn take(&mut self, mut query: SoilQuery, shared_slip_std: f32, travel_m: f32) -> Result<(), Refusal> {
        self.asks_what_lasts = !self.asks_what_lasts;
        // Either is asked in every other frame, and stands for the travel of two.
        let travel_m = travel_m + travel_m;
        if self.asks_what_lasts && self.average.has_begun() {
            let noise = &mut query.noise;
            let lasting = HARDLY_ANY * noise.slip;
            noise.slip = if shared_slip_std > lasting { shared_slip_std } else { lasting };
            noise.drawbar_pull_n *= HARDLY_ANY;
            noise.load_n *= HARDLY_ANY;
            noise.torque_nm *= HARDLY_ANY;
            let (outputs, _) = rover_outputs(&query)?;
            self.average.take_noiseless(&outputs, travel_m);
        } else {
            let (outputs, inside) = rover_outputs(&query)?;
            self.average.take(&outputs, inside && !self.surmises_contacts, travel_m);
        }
        Ok(())
    }

    /// What is known of the soil over time; where that is nothing, why.
    fn fused(&self, wheels: PerWheel<bool>, nothing: Refusal) -> Result<RoverSoil, Refusal> {
        let outputs = self.average.outputs().ok_or(nothing)?;
        let inside = self.average.inside_training_range();
        Ok(RoverSoil {
            estimate: SoilEstimate::of_outputs(&frozen::ROVER.posterior, &outputs, inside),
            wheels,
            instants: self.average.instants(),
            changes: self.changes.changes(),
        })
    }
}

/// The wheels as if those that roll back rolled forward, seen in a mirror: their pulls and torques change signs.
fn in_direction_of_travel(wheels: &PerWheel<WheelEstimate>, backward: PerSide<bool>) -> PerWheel<WheelEstimate> {
    let mut wheels = *wheels;
    let PerSide { left, right } = wheels.as_mut().zip(backward);
    for (side, _) in [left, right].into_iter().filter(|(_, backward)| *backward) {
        for wheel in side.as_array_mut() {
            wheel.resistive_torque_nm.value = -wheel.resistive_torque_nm.value;
            wheel.drawbar_pull_n.value = -wheel.drawbar_pull_n.value;
        }
    }
    wheels
}

/// Whether the rover network knows such wheels: under load, rolling, not braked, and slipping by what can be told.
fn is_known(wheel: &WheelEstimate) -> bool {
    let slips = |slip: Estimate| is_known_slip(slip.value, slip.std) && slip.std < UNTOLD_SLIP;
    state_of(wheel).is_some() && wheel.slip.is_some_and(slips)
}

/// The state that a network takes; none of a wheel that does not roll under load.
fn state_of(wheel: &WheelEstimate) -> Option<WheelState> {
    let slip = wheel.slip.filter(|_| wheel.activity == WheelActivity::Rolling)?;
    Some(WheelState {
        drawbar_pull_n: wheel.drawbar_pull_n.value,
        load_n: wheel.normal_load_n.value,
        torque_nm: wheel.resistive_torque_nm.value,
        slip: slip.value,
        sinkage_m: None,
    })
}

fn noise_of(wheel: &WheelEstimate) -> WheelNoise {
    WheelNoise {
        drawbar_pull_n: wheel.drawbar_pull_n.std,
        load_n: wheel.normal_load_n.std,
        torque_nm: wheel.resistive_torque_nm.std,
        slip: wheel.slip.map_or(1.0, |slip| slip.std),
        sinkage_m: 1.0,
    }
}
