//! How noisy one row is, and how noisy a mean of rows.

use kapvik_firmware::wheel_state::WheelNoise;
use serde::Serialize;

use crate::data::campaign::like_rows::{Pairing, SlipAndLoad, like_pairs};
use crate::data::campaign::{Campaign, Channel};
use crate::prior::{AVERAGING, INSTANT_NOISE};
use crate::statistics::{robust_std, root_mean_square};

use super::combine::MeanState;

/// Where a standard deviation comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoiseSource {
    /// `[noise]` of the campaign states it.
    Campaign,
    /// Estimated from the differences between rows of one run alike in slip and load.
    Repeats,
    /// Nothing says it: that of the flight sensors at this load and radius.
    FlightSensors,
}

/// One standard deviation of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelStd {
    /// In the channel's unit.
    pub std: f64,
    /// Where it comes from.
    pub source: NoiseSource,
}

/// How noisy one row is, for each channel of a wheel state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorNoise {
    /// Of the drawbar pull, N.
    pub drawbar_pull: ChannelStd,
    /// Of the load, N.
    pub load: ChannelStd,
    /// Of the torque, N·m.
    pub torque: ChannelStd,
    /// Of the slip.
    pub slip: ChannelStd,
    /// Of the sinkage, m.
    pub sinkage: ChannelStd,
}

/// Fewest pairs of like rows that say something: their standard deviation is then known to a fifth of itself.
const LEAST_PAIRS: usize = 12;
/// Loads of like rows differ by no more than this share.
const LIKE_LOAD: f64 = 0.1;
/// Times what is usual from which a difference between like rows is a gross error's.
const FAR_OUT: f64 = 6.0;

/// What a rig sets, and a file may hold to be exact. No method can weigh by nothing: such a channel is taken to be as good as the networks know
/// any, the mean of 400 instants of the flight sensors.
const SET: [Channel; 2] = [Channel::Slip, Channel::Load];

impl SensorNoise {
    /// The noise of a campaign's rows: stated, else from repeats, else that of the flight sensors.
    ///
    /// Slip is never taken from repeats: like rows are found by their slip.
    pub fn of(campaign: &Campaign) -> Self {
        let pairs = of_each_run(campaign);
        let scale = INSTANT_NOISE.on(mean_load(campaign), campaign.wheel.radius_m);
        let channel = |channel, flight_sensors| {
            let stated = campaign.noise.of(channel).map(|std| ChannelStd {
                std: if std == 0.0 && SET.contains(&channel) { AVERAGING.low * flight_sensors } else { std },
                source: NoiseSource::Campaign,
            });
            let repeats =
                || Some(ChannelStd { std: from_pairs(campaign, &pairs, channel)?, source: NoiseSource::Repeats });
            let fallback = ChannelStd { std: flight_sensors, source: NoiseSource::FlightSensors };
            stated.or_else(|| if channel == Channel::Slip { None } else { repeats() }).unwrap_or(fallback)
        };
        Self {
            drawbar_pull: channel(Channel::DrawbarPull, scale.drawbar_pull_n),
            load: channel(Channel::Load, scale.load_n),
            torque: channel(Channel::Torque, scale.torque_nm),
            slip: channel(Channel::Slip, scale.slip),
            sinkage: channel(Channel::Sinkage, scale.sinkage_m),
        }
    }

    /// That of each channel.
    pub fn by_channel(&self) -> [(Channel, ChannelStd); 5] {
        [
            (Channel::DrawbarPull, self.drawbar_pull),
            (Channel::Load, self.load),
            (Channel::Torque, self.torque),
            (Channel::Slip, self.slip),
            (Channel::Sinkage, self.sinkage),
        ]
    }

    /// The noise of a mean state: infinite of a pull or a torque that none of its rows has.
    pub fn of_mean(&self, state: &MeanState) -> WheelNoise<f64> {
        let per_reading = &state.rows_per_reading;
        let mean_of = |one: ChannelStd, rows: usize, per_reading: f64| {
            one.std * (per_reading / rows.max(1) as f64).min(1.0).sqrt()
        };
        let mean_of_some = |one: ChannelStd, rows: usize, per_reading: f64| {
            if rows == 0 { f64::INFINITY } else { mean_of(one, rows, per_reading) }
        };
        WheelNoise {
            drawbar_pull_n: mean_of_some(self.drawbar_pull, state.with.drawbar_pull, per_reading.drawbar_pull),
            load_n: mean_of(self.load, state.rows, per_reading.load),
            torque_nm: mean_of_some(self.torque, state.with.torque, per_reading.torque),
            slip: mean_of(self.slip, state.rows, per_reading.slip),
            sinkage_m: mean_of(self.sinkage, state.with.sinkage, per_reading.sinkage),
        }
    }
}

/// The noise that the networks are told of several wheels: one number for all of them, the root mean square.
///
/// No channel is held to be better than the mean of 400 instants of the flight sensors: the networks have seen little
/// that is.
pub fn noise_for_networks(noises: &[WheelNoise<f64>], mean_load_n: f64, radius_m: f64) -> WheelNoise {
    let least = INSTANT_NOISE.on(mean_load_n, radius_m);
    let told = |of: fn(&WheelNoise<f64>) -> f64, least: f64| {
        root_mean_square(noises.iter().map(of)).max(AVERAGING.low * least) as f32
    };
    WheelNoise {
        drawbar_pull_n: told(|noise| noise.drawbar_pull_n, least.drawbar_pull_n),
        load_n: told(|noise| noise.load_n, least.load_n),
        torque_nm: told(|noise| noise.torque_nm, least.torque_nm),
        slip: told(|noise| noise.slip, least.slip),
        sinkage_m: told(|noise| noise.sinkage_m, least.sinkage_m),
    }
}

fn mean_load(campaign: &Campaign) -> f64 {
    let loads = campaign.sound_rows().filter_map(|row| campaign.value(row, Channel::Load));
    let (sum, count) = loads.fold((0.0, 0.0), |(sum, count), load| (sum + load.abs(), count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

/// Pairs of rows of one run that are alike in slip and load; no row is in two pairs.
fn of_each_run(campaign: &Campaign) -> Vec<[usize; 2]> {
    let state = |place| {
        let (slip, load_n) = (campaign.value(place, Channel::Slip)?, campaign.value(place, Channel::Load)?);
        Some(SlipAndLoad { place, slip, load_n })
    };
    let pairs = |(_, mut rows): (&str, Vec<usize>)| {
        rows.retain(|row| campaign.gross_error(*row).is_none());
        rows.sort_by(|one, other| campaign.rows()[*one].t_s.total_cmp(&campaign.rows()[*other].t_s));
        like_pairs(rows.into_iter().filter_map(state).collect(), LIKE_LOAD, Pairing::Apart, |_, _| true)
    };
    campaign.runs().into_iter().flat_map(pairs).collect()
}

/// Half the mean square of the differences is the variance, but for those of gross errors.
fn from_pairs(campaign: &Campaign, pairs: &[[usize; 2]], channel: Channel) -> Option<f64> {
    let difference = |&[one, other]: &[usize; 2]| Some(campaign.value(one, channel)? - campaign.value(other, channel)?);
    let differences: Vec<f64> = pairs.iter().filter_map(difference).collect();
    // More than half of them are nothing where a logger rounds: then what is usual tells nothing.
    let usual = Some(robust_std(differences.iter().copied())).filter(|usual| *usual > 0.0).unwrap_or(f64::INFINITY);
    let near = differences.iter().filter(|difference| difference.abs() <= FAR_OUT * usual);
    let squares: Vec<f64> = near.map(|difference| difference * difference).collect();
    let count = squares.len();
    let std = (count >= LEAST_PAIRS).then(|| (0.5 * squares.iter().sum::<f64>() / count as f64).sqrt());
    // Where all are alike, a logger rounds: that tells nothing of the noise.
    std.filter(|std| *std > 0.0)
}
