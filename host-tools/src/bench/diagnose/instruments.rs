//! The instruments of a drawn campaign: what they measure, how noisily, and what their files look like.

use super::chance::Chance;
use super::layout::Layout;
use super::shared_errors::{Shared, SharedErrors};
use super::site::Site;
use super::state::{LOAD, MEASURED, SLIP, State};
use super::wants::Wants;
use crate::data::campaign::Channel;
use crate::prior::{INSTANT_NOISE, Range};

/// Factor on the noise of an instant of drawbar pull, torque and sinkage.
const NOISE_FACTOR: Range = Range { low: 0.2, high: 2.0, logarithmic: true };
/// Noise of the slip.
const SLIP_NOISE: Range = Range { low: 0.003, high: 0.02, logarithmic: true };
/// Noise of the load over the mean load.
const LOAD_NOISE: Range = Range { low: 0.005, high: 0.02, logarithmic: true };
/// A channel's resolution over its noise.
const RESOLUTION: Range = Range { low: 0.05, high: 0.5, logarithmic: true };
/// How far an outlier lies off, in standard deviations of the noise.
const OUTLIER: Range = Range { low: 8.0, high: 25.0, logarithmic: true };

/// Instruments.
#[derive(Debug, Clone)]
pub struct Instruments {
    /// One standard deviation of each channel of [`MEASURED`]; none where it is not measured.
    pub noise: [Option<f64>; 6],
    /// Whether each of these is stated in the campaign's file.
    pub stated: [bool; 6],
    /// The last digit that is written of each channel, in its unit.
    resolution: [f64; 6],
    /// One standard deviation of a channel's offset from run to run.
    pub offset_std: [f64; 6],
    /// What else the rows of a run share.
    shared: Shared,
    /// Share of fields with an outlier.
    pub outliers: f64,
    /// Share of fields that are empty.
    pub missing: f64,
}

impl Instruments {
    /// Draws the instruments of a campaign.
    pub fn draw(chance: &mut Chance, site: &Site, layout: &Layout, wants: &Wants, errors: SharedErrors) -> Self {
        let noise = draw_noise(chance, site, layout, wants);
        let resolution = noise.map(|std| std.map_or(1.0, |std| decimal_step(std * chance.of(RESOLUTION))));
        let mut stated = noise.map(|std| std.is_some());
        if layout.repeats && chance.happens(0.2) {
            stated[chance.pick(&[0, 1, 2])] = false;
        }
        // With one row a run an offset would be nothing but more noise than is stated.
        let offsets = errors == SharedErrors::Usual && layout.rows_per_run >= 4 && chance.happens(0.25);
        let offset_std = std::array::from_fn(|place| {
            let std = noise[place].filter(|_| offsets && place < 3);
            std.map_or(0.0, |std| std * chance.between(0.3, 1.0))
        });
        let outliers = if chance.happens(0.25) { chance.between(0.005, 0.02) } else { 0.0 };
        let missing = if chance.happens(0.25) { chance.between(0.01, 0.06) } else { 0.0 };
        let shared = Shared::draw(chance, errors);
        Self { noise, stated, resolution, offset_std, shared, outliers, missing }
    }

    /// Whether a channel of [`MEASURED`] is measured.
    pub fn measures(&self, place: usize) -> bool {
        self.noise[place].is_some()
    }

    /// The last digit that is written of a channel of [`MEASURED`], in its unit.
    pub fn resolution(&self, place: usize) -> f64 {
        self.resolution[place]
    }

    /// What stands in the file for each row of a campaign, from the readings that sensors without noise would give.
    pub fn measure(&self, chance: &mut Chance, layout: &Layout, readings: &[State]) -> Vec<[Option<f64>; 6]> {
        let offsets: Vec<[f64; 6]> = (0..layout.runs).map(|_| self.offset_std.map(|std| chance.normal(std))).collect();
        let shared = self.shared.errors(chance, layout);
        let rows = layout.rows.iter().zip(readings).zip(&shared);
        rows.map(|((row, reading), shared)| self.measure_row(chance, &offsets[row.run], shared, reading)).collect()
    }

    fn measure_row(
        &self,
        chance: &mut Chance,
        offset: &[f64; 6],
        shared: &[f64; 6],
        reading: &State,
    ) -> [Option<f64>; 6] {
        let values = reading.channels();
        std::array::from_fn(|place| {
            let std = self.noise[place]?;
            let gone = place < 4 && chance.happens(self.missing);
            let astray =
                if place < 4 && chance.happens(self.outliers) { chance.sign() * chance.of(OUTLIER) } else { 0.0 };
            let value = values[place] + offset[place] + chance.normal(std) + (shared[place] + astray) * std;
            let bounded = if place == SLIP { value.clamp(-1.0, 1.0) } else { value };
            (!gone).then_some((bounded / self.resolution[place]).round() * self.resolution[place])
        })
    }
}

fn draw_noise(chance: &mut Chance, site: &Site, layout: &Layout, wants: &Wants) -> [Option<f64>; 6] {
    let relative = INSTANT_NOISE;
    let (load_n, radius_m) = (site.load_n, site.wheel.radius_m);
    let mut std = [0.0; 6];
    std[0] = chance.of(NOISE_FACTOR) * relative.drawbar_pull * load_n;
    std[1] = chance.of(NOISE_FACTOR) * relative.torque * load_n * radius_m;
    std[2] = chance.of(NOISE_FACTOR) * relative.sinkage * radius_m;
    std[3] = chance.of(NOISE_FACTOR) * relative.drawbar_pull * load_n;
    std[SLIP] = chance.of(SLIP_NOISE);
    std[LOAD] = chance.of(LOAD_NOISE) * load_n;
    let sideways = layout.meaningful.contains(&Channel::SlipAngle);
    let there = [
        true,
        chance.happens(0.85),
        chance.happens(0.95),
        chance.happens(if sideways { 0.8 } else { 0.1 }),
        true,
        true,
    ];
    std::array::from_fn(|place| (there[place] || wants.columns.contains(&MEASURED[place])).then_some(std[place]))
}

/// 1, 2 or 5 times a power of ten, at most `most`.
fn decimal_step(most: f64) -> f64 {
    let decade = libm::pow(10.0, libm::log10(most).floor());
    let step = [5.0, 2.0].into_iter().find(|step| step * decade <= most).unwrap_or(1.0);
    step * decade
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resolution_is_a_round_number() {
        for (most, expected) in [(0.0123, 0.01), (0.023, 0.02), (0.6, 0.5), (1.0, 1.0), (8.0e-5, 5.0e-5)] {
            assert!((decimal_step(most) / expected - 1.0).abs() < 1e-9, "{most}");
        }
    }
}
