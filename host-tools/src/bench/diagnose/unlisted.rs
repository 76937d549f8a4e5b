//! Effects that are in no list: what a diagnosis can see of them is the channel and the column.

use super::overlay::{Act, Place};
use super::state::State;
use super::wants::Wants;
use crate::data::campaign::Channel;

/// An effect that nobody declared and no catalogue has.
#[derive(Debug, Clone, Copy)]
pub struct Unlisted {
    /// What it is.
    pub law: &'static str,
    /// The channel that it acts on.
    pub channel: Channel,
    /// The column that it follows.
    pub column: &'static str,
    /// What a campaign must have for it.
    pub wants: fn() -> Wants,
    /// How it acts.
    pub act: Act,
}

impl Unlisted {
    /// The column where it is none that the format names.
    pub fn extra_column(&self) -> Option<&'static str> {
        Channel::from_name(self.column).is_none().then_some(self.column)
    }

    /// Whether it is what a sensor makes of its own quantity.
    pub fn is_of_a_sensor(&self) -> bool {
        self.column == self.channel.name()
    }
}

/// All of them.
pub const UNLISTED: [Unlisted; 15] = [
    Unlisted {
        law: "torque linear in temperature",
        channel: Channel::Torque,
        column: "temperature_c",
        wants: || Wants::columns(&[Channel::Torque, Channel::Temperature]),
        act: Act::State(|place, state, size| {
            state.torque_nm += size * moment_nm(place) * place.setting.temperature_c / 20.0;
        }),
    },
    Unlisted {
        law: "drawbar pull with the root of humidity",
        channel: Channel::DrawbarPull,
        column: "humidity",
        wants: || Wants::columns(&[Channel::DrawbarPull]),
        act: Act::State(|place, state, size| {
            state.drawbar_pull_n += size * place.load_n * libm::sqrt(place.setting.other.max(0.0) / 50.0);
        }),
    },
    Unlisted {
        law: "sinkage with slip times temperature",
        channel: Channel::Sinkage,
        column: "temperature_c",
        wants: || Wants::columns(&[Channel::Sinkage, Channel::Temperature]),
        act: Act::State(|place, state, size| {
            state.sinkage_m += size * place.sinkage_m * place.slip * place.setting.temperature_c / 10.0;
        }),
    },
    Unlisted {
        law: "torque with a wave along the travel",
        channel: Channel::Torque,
        column: "travel_m",
        wants: || Wants { long_runs: true, ..Wants::columns(&[Channel::Torque, Channel::Travel]) },
        act: Act::State(|place, state, size| {
            let phase = place.setting.travel_m / (1.3 * place.site.wheel.radius_m);
            state.torque_nm += size * moment_nm(place) * libm::sin(phase);
        }),
    },
    Unlisted {
        law: "side force linear in travel",
        channel: Channel::SideForce,
        column: "travel_m",
        wants: || Wants { long_runs: true, ..Wants::columns(&[Channel::SideForce, Channel::Travel]) },
        act: Act::State(|place, state, size| {
            state.side_force_n += size * place.site.load_n * place.setting.travel_m / place.site.wheel.radius_m;
        }),
    },
    Unlisted {
        law: "sinkage with the wheel's angle: an eccentric wheel",
        channel: Channel::Sinkage,
        column: "wheel_angle_rad",
        wants: || Wants { long_runs: true, ..Wants::columns(&[Channel::Sinkage, Channel::WheelAngle]) },
        act: Act::State(|place, state, size| {
            state.sinkage_m += size * place.site.wheel.radius_m * libm::sin(place.setting.wheel_angle_rad);
        }),
    },
    Unlisted {
        law: "drawbar pull linear in the supply's voltage",
        channel: Channel::DrawbarPull,
        column: "supply_voltage_v",
        wants: || Wants::columns(&[Channel::DrawbarPull]),
        act: Act::State(|place, state, size| {
            state.drawbar_pull_n += size * place.site.load_n * (place.setting.other - 40.0) / 20.0;
        }),
    },
    Unlisted {
        law: "torque with the square of hours since zero",
        channel: Channel::Torque,
        column: "hours_since_zero",
        wants: || Wants::columns(&[Channel::Torque, Channel::HoursSinceZero]),
        act: Act::State(|place, state, size| {
            let hours = place.setting.hours_since_zero;
            state.torque_nm += size * moment_nm(place) * hours * hours / 9.0;
        }),
    },
    Unlisted {
        law: "sinkage linear in pitch",
        channel: Channel::Sinkage,
        column: "pitch_rad",
        wants: || Wants { pitches: true, ..Wants::columns(&[Channel::Sinkage, Channel::Pitch]) },
        act: Act::State(|place, state, size| {
            state.sinkage_m += size * place.site.wheel.radius_m * place.setting.pitch_rad;
        }),
    },
    Unlisted {
        law: "side force with the logarithm of speed",
        channel: Channel::SideForce,
        column: "speed_m_s",
        wants: || Wants { speeds: true, ..Wants::columns(&[Channel::SideForce, Channel::Speed]) },
        act: Act::State(|place, state, size| {
            state.side_force_n += size * place.site.load_n * libm::log(place.setting.speed_m_s / 0.05);
        }),
    },
    Unlisted {
        law: "torque linear in the number of passes",
        channel: Channel::Torque,
        column: "pass",
        wants: || Wants { passes: true, ..Wants::columns(&[Channel::Torque, Channel::Pass]) },
        act: Act::State(|place, state: &mut State, size| {
            state.torque_nm += size * moment_nm(place) * (place.setting.pass - 1.0);
        }),
    },
    Unlisted {
        law: "gain of the drawbar pull's sensor",
        channel: Channel::DrawbarPull,
        column: "drawbar_pull_n",
        wants: || Wants::columns(&[Channel::DrawbarPull]),
        act: Act::State(|_, state, size| state.drawbar_pull_n *= 1.0 + size),
    },
    Unlisted {
        law: "gain of the sinkage's sensor",
        channel: Channel::Sinkage,
        column: "sinkage_m",
        wants: || Wants::columns(&[Channel::Sinkage]),
        act: Act::State(|_, state, size| state.sinkage_m *= 1.0 + size),
    },
    Unlisted {
        law: "friction in the guide of the drawbar pull's sensor",
        channel: Channel::DrawbarPull,
        column: "drawbar_pull_n",
        wants: || Wants::columns(&[Channel::DrawbarPull]),
        act: Act::State(|place, state, size| {
            let (pull_n, most_n) = (state.drawbar_pull_n, size * place.site.load_n);
            state.drawbar_pull_n -= pull_n.clamp(-most_n, most_n);
        }),
    },
    Unlisted {
        law: "torque sensor that saturates",
        channel: Channel::Torque,
        column: "torque_nm",
        wants: || Wants::columns(&[Channel::Torque]),
        act: Act::State(|place, state, size| {
            state.torque_nm /= 1.0 + size * state.torque_nm.abs() / moment_nm(place);
        }),
    },
];

/// A torque to compare with, N·m.
fn moment_nm(place: &Place<'_>) -> f64 {
    place.site.load_n * place.site.wheel.radius_m
}
