//! Errors of a sensor that stand in no list: what it reads of a quantity is a law of that quantity itself, and of nothing else.
//!
//! A gain of the torque is a listed effect; those of the other channels are not, nor is what a sensor makes of small, of great, or of quickly
//! changing values. Each law has one size. They are here to be held against listed effects, and are never found as effects.

use kapvik_firmware::terramechanics::effects::{EffectInfo, Form, ParameterInfo, Role};

use super::fit::{CHANNELS, Prediction, Reading};
use super::measurements::Measurements;
use super::specification::EffectForm;
use crate::digits::significant;
use crate::statistics::sorted;

/// Of all readings, by size, the share that lies below the one which laws measure sizes by: a few gross errors lie beyond.
const SCALE_SHARE: f64 = 0.95;
/// Width of the bend of a sensor that is cut off, as a share of the scale.
const BEND: f64 = 0.01;
/// Least dead band, as a share of the scale: none has no slope.
const LEAST_BAND: f64 = 1e-4;
/// Rows of a run from which a delay shows.
const ROWS_OF_A_DELAY: usize = 4;

/// Digits of a size as it is told.
const DIGITS: usize = 3;
/// Units of the channels, in the order of [`Reading::ALL`].
const UNITS: [&str; CHANNELS] = ["N", "N·m", "m", "N", "", "N"];

/// How a sensor reads `true value → reading`, with a size x and the scale S of its channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Law {
    /// (1 + x) v.
    Gain,
    /// v + x v |v| / S.
    Bend,
    /// v − x S tanh(v / (x S)): a dead band, or friction of the sensor's guide.
    DeadBand,
    /// v u⁴ / (1 + u⁴), u = v / (x S): what is small is read as zero.
    Zeroed,
    /// min(v, (1 − x) S), its corner rounded.
    CutOff,
    /// A first-order lag of x rows.
    Late,
}

impl Law {
    const ALL: [(&'static str, Self); 6] = [
        (GAIN.name, Self::Gain),
        (BENT.name, Self::Bend),
        (DEAD_BAND.name, Self::DeadBand),
        (ZEROED.name, Self::Zeroed),
        (CUT_OFF.name, Self::CutOff),
        (LATE.name, Self::Late),
    ];
}

const GAIN: Form = form("gain", &["gain"]);
const BENT: Form = form("bent", &["bend"]);
const DEAD_BAND: Form = form("dead band", &["dead_band"]);
const ZEROED: Form = form("small values as zero", &["zeroed"]);
const CUT_OFF: Form = form("cut off", &["cut_off"]);
const LATE: Form = form("late", &["late_rows"]);

const PARAMETERS: &[ParameterInfo] = &[
    size("gain", -0.6, 1.5, 0.05),
    size("bend", -0.6, 2.0, 0.05),
    size("dead_band", 0.0, 0.9, 0.1),
    size("zeroed", 0.0, 0.9, 0.2),
    size("cut_off", 0.0, 0.9, 0.2),
    size("late_rows", 0.0, 30.0, 0.5),
];

/// The laws of each sensor, by the channel's column. What the list of effects has already is not here: the gain of a torque, and of a torque
/// that never changes its sign a dead band, which is an offset.
const SENSORS: &[EffectInfo] = &[
    sensor("drawbar_pull_n", &[GAIN, BENT, DEAD_BAND, ZEROED, CUT_OFF, LATE]),
    sensor("torque_nm", &[BENT, CUT_OFF, LATE]),
    sensor("sinkage_m", &[GAIN, BENT, CUT_OFF, LATE]),
    sensor("load_n", &[GAIN]),
];

const fn form(name: &'static str, free: &'static [&'static str]) -> Form {
    Form { name, free, set: &[], needs: &[] }
}

const fn size(name: &'static str, low: f64, high: f64, typical: f64) -> ParameterInfo {
    ParameterInfo { name, unit: "-", neutral: 0.0, low, high, typical, role: Role::Size }
}

const fn sensor(id: &'static str, forms: &'static [Form]) -> EffectInfo {
    EffectInfo {
        id,
        summary: "an error of the sensor with its own reading",
        words: &[],
        test: "",
        parameters: PARAMETERS,
        forms,
        any_size: true,
    }
}

/// The channel whose sensor a law is of; none of a listed effect.
pub fn channel_of(effect: &EffectForm) -> Option<Reading> {
    let channels = [Reading::DrawbarPull, Reading::Torque, Reading::Sinkage, Reading::Load];
    let place = SENSORS.iter().position(|sensor| sensor.id == effect.info.id)?;
    channels.get(place).copied()
}

/// Whether a sensor reads late by a law.
pub fn is_late(law: &EffectForm) -> bool {
    law.form.name == LATE.name
}

/// Every law of every sensor that the measurements could show.
pub fn sensor_laws(measurements: &Measurements) -> Vec<EffectForm> {
    let is_long = measurements.rows_of_run.iter().any(|rows| rows.len() >= ROWS_OF_A_DELAY);
    let shows = |law: &EffectForm| {
        let is_measured = channel_of(law).is_some_and(|channel| measurements.has(channel));
        let is_set = measurements.is_load_set && channel_of(law) == Some(Reading::Load);
        is_measured && !is_set && (is_long || !is_late(law))
    };
    SENSORS.iter().flat_map(EffectForm::each_of).filter(shows).collect()
}

/// A sensor that reads by a law, in a model.
#[derive(Debug, Clone, Copy)]
pub struct SensorLaw {
    channel: usize,
    law: Law,
    scale: f64,
    /// The place of its size among the model's parameters.
    place: usize,
}

/// A reading, with its derivatives by the true value and by the law's size.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Read {
    value: f64,
    by_true: f64,
    by_size: f64,
}

impl SensorLaw {
    /// That of an effect's form whose size stands at a place; none of a listed effect.
    pub fn of(effect: &EffectForm, measurements: &Measurements, place: usize) -> Option<Self> {
        let channel = channel_of(effect)?.index();
        let (_, law) = Law::ALL.into_iter().find(|(name, _)| *name == effect.form.name)?;
        let sizes = sorted(measurements.rows.iter().filter_map(|row| row.readings[channel]).map(f64::abs));
        let scale = *sizes.get((SCALE_SHARE * sizes.len() as f64) as usize)?;
        (scale > 0.0).then_some(Self { channel, law, scale, place })
    }

    /// What the sensor does, with the size that a fit came to and one standard deviation of it.
    pub fn in_words(&self, size: f64, std: f64) -> String {
        let digits = |value: f64| significant(value, DIGITS);
        let measured = |at: f64| {
            format!("{} ± {} {}", digits(at * self.scale), significant(std * self.scale, 2), UNITS[self.channel])
        };
        let number = |value: f64| format!("{} ± {}", digits(value), significant(std, 2));
        match self.law {
            Law::Gain => format!("a gain of {} in place of 1", number(1.0 + size)),
            Law::Bend => {
                let at = format!("{} {}", digits(self.scale), UNITS[self.channel]);
                format!("a reading that is bent by {} of itself at {at}", number(size))
            }
            Law::DeadBand => format!("a dead band, or friction, of {}", measured(size)),
            Law::Zeroed => format!("what is less than some {} read as zero", measured(size)),
            Law::CutOff => format!("a reading that is cut off at {}", measured(1.0 - size)),
            Law::Late => format!("a reading that is late by {} rows", number(size)),
        }
    }

    /// Makes true values of the rows of a run readings, with all derivatives.
    pub fn read(&self, parameters: &[f64], rows: &mut [Prediction]) {
        let Some(&size) = parameters.get(self.place) else { return };
        let mut before: Option<Prediction> = None;
        for row in rows {
            let Read { value, by_true, by_size } = match (&before, self.law) {
                (Some(before), Law::Late) => late(row.value[self.channel], before.value[self.channel], size),
                _ => self.at(row.value[self.channel], size),
            };
            row.value[self.channel] = value;
            let slopes = &mut row.slopes;
            let by_all = slopes.by_parameter.iter_mut().chain([&mut slopes.by_slip, &mut slopes.by_load]);
            by_all.for_each(|by| by[self.channel] *= by_true);
            if let (Some(before), Law::Late) = (&before, self.law) {
                for (by, then) in slopes.by_parameter.iter_mut().zip(&before.slopes.by_parameter) {
                    by[self.channel] += (1.0 - by_true) * then[self.channel];
                }
            }
            if let Some(own) = slopes.by_parameter.get_mut(self.place) {
                own[self.channel] += by_size;
            }
            if self.law == Law::Late {
                before = Some(row.clone());
            }
        }
    }

    /// The same without derivatives.
    pub fn read_values(&self, parameters: &[f64], rows: &mut [[f64; CHANNELS]]) {
        let Some(&size) = parameters.get(self.place) else { return };
        let mut before: Option<f64> = None;
        for row in rows {
            let value = &mut row[self.channel];
            *value = match (before, self.law) {
                (Some(before), Law::Late) => late(*value, before, size).value,
                _ => self.at(*value, size).value,
            };
            before = Some(*value);
        }
    }

    /// What is read of a true value; the first of a run is read at once.
    fn at(&self, v: f64, size: f64) -> Read {
        let scale = self.scale;
        match self.law {
            Law::Gain => Read { value: (1.0 + size) * v, by_true: 1.0 + size, by_size: v },
            Law::Bend => {
                let bent = v * v.abs() / scale;
                Read { value: v + size * bent, by_true: 1.0 + 2.0 * size * v.abs() / scale, by_size: bent }
            }
            Law::DeadBand => {
                let band = size.max(LEAST_BAND) * scale;
                let (u, held) = (v / band, (v / band).tanh());
                let slope = 1.0 - held * held;
                Read { value: v - band * held, by_true: held * held, by_size: scale * (u * slope - held) }
            }
            Law::Zeroed => {
                let u = v / (size.max(LEAST_BAND) * scale);
                let fourth = u.powi(4);
                let share = 1.0 / (1.0 + fourth.recip());
                let by_ln_u = 4.0 * share * (1.0 - share);
                Read { value: v * share, by_true: share + by_ln_u, by_size: -v * by_ln_u / size.max(LEAST_BAND) }
            }
            Law::CutOff => {
                let width = BEND * scale;
                let over = (v - (1.0 - size) * scale) / width;
                let share = 1.0 / (1.0 + (-over).exp());
                let beyond = width * (over.max(0.0) + (-over.abs()).exp().ln_1p());
                Read { value: v - beyond, by_true: 1.0 - share, by_size: -share * scale }
            }
            Law::Late => Read { value: v, by_true: 1.0, by_size: 0.0 },
        }
    }
}

/// A reading that follows the true value from the one before with a lag of so many rows; the derivative by what was read before is one less
/// that by the true value.
fn late(v: f64, before: f64, rows: f64) -> Read {
    let new = 1.0 / (1.0 + rows);
    Read { value: before + new * (v - before), by_true: new, by_size: -new * new * (v - before) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::fit::Derivatives;
    use crate::diagnose::measurements::column_name;

    const STEP: f64 = 1e-6;

    fn law(law: Law) -> SensorLaw {
        SensorLaw { channel: 0, law, scale: 10.0, place: 1 }
    }

    /// Three rows whose true value is a constant and the first parameter times 1, 2, 3.
    fn rows(parameters: &[f64]) -> Vec<Prediction> {
        let row = |k: f64| {
            let of_first = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0].map(|one| one * k);
            Prediction {
                value: of_first.map(|by| by * parameters[0] - 2.0),
                slopes: Derivatives {
                    by_parameter: vec![of_first, [0.0; CHANNELS]],
                    by_slip: of_first,
                    by_load: [0.0; CHANNELS],
                },
            }
        };
        [1.0, 2.0, 3.0].map(row).to_vec()
    }

    #[test]
    fn each_sensor_is_named_by_its_column() {
        for form in SENSORS.iter().flat_map(EffectForm::each_of) {
            assert_eq!(channel_of(&form).map(column_name), Some(form.info.id));
        }
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        for (name, kind) in Law::ALL {
            for parameters in [[2.0, 0.3], [4.0, 0.05], [0.5, 0.2], [3.5, 0.15]] {
                let law = law(kind);
                let mut with = rows(&parameters);
                law.read(&parameters, &mut with);
                for (place, moved) in [[STEP, 0.0], [0.0, STEP]].into_iter().enumerate() {
                    let at = |sign: f64| {
                        let there = [parameters[0] + sign * moved[0], parameters[1] + sign * moved[1]];
                        let mut values: Vec<_> = rows(&there).iter().map(|row| row.value).collect();
                        law.read_values(&there, &mut values);
                        values
                    };
                    for ((row, up), down) in with.iter().zip(at(1.0)).zip(at(-1.0)) {
                        let slope = (up[0] - down[0]) / (2.0 * STEP);
                        let told = row.slopes.by_parameter[place][0];
                        assert!(
                            (slope - told).abs() < 1e-5 * (1.0 + slope.abs()),
                            "{name} {parameters:?}: {told}, {slope}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_law_without_size_reads_the_truth() {
        for (name, kind) in Law::ALL {
            for v in [-6.0, -0.5, 0.4, 9.0] {
                let read = law(kind).at(v, 0.0).value;
                assert!((read - v).abs() < 0.01, "{name}: {read} of {v}");
            }
        }
    }

    #[test]
    fn what_small_and_great_values_become() {
        let read = |kind, v: f64, size: f64| law(kind).at(v, size).value;
        assert!(read(Law::DeadBand, 0.5, 0.3).abs() < 0.02 && (read(Law::DeadBand, -9.0, 0.3) + 6.0).abs() < 0.05);
        assert!(read(Law::Zeroed, 0.5, 0.3).abs() < 0.01 && (read(Law::Zeroed, 9.0, 0.3) - 9.0).abs() < 0.2);
        assert!((read(Law::CutOff, 9.0, 0.3) - 7.0).abs() < 0.01 && (read(Law::CutOff, 5.0, 0.3) - 5.0).abs() < 0.01);
    }
}
