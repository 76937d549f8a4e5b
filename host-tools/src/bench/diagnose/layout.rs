//! How a campaign is laid out: runs, and in each the rows with slip, load and what surrounds them.

use super::chance::Chance;
use super::site::Site;
use super::state::{Row, Setting};
use super::wants::Wants;
use crate::data::campaign::Channel;

/// Runs of a campaign.
const RUNS: (usize, usize) = (12, 60);
/// The same where few are wanted.
const FEW_RUNS: (usize, usize) = (4, 24);
/// Rows of a run that has more than one.
const ROWS: (usize, usize) = (3, 20);
/// The same where runs are few.
const ROWS_OF_FEW: (usize, usize) = (3, 60);
/// Most rows of a campaign.
const MOST_ROWS: usize = 600;
/// Share of campaigns of averaged windows: one row a run.
const WINDOWS_SHARE: f64 = 0.4;
/// Slips that are commanded.
const SLIPS: (f64, f64) = (0.02, 0.7);
/// Highest turn between rows, in spacings of grousers, at which a ripple is still told from a drift.
const FAST_ROWS: f64 = 0.45;

/// Rows, and what of their surroundings is worth a column.
#[derive(Debug, Clone)]
pub struct Layout {
    /// The rows, run by run.
    pub rows: Vec<Row>,
    /// How many runs there are.
    pub runs: usize,
    /// Rows in each run.
    pub rows_per_run: usize,
    /// Whether conditions repeat, so that the noise of a channel can be told from repeats.
    pub repeats: bool,
    /// Columns that say something here, whether the campaign has them or not.
    pub meaningful: Vec<Channel>,
}

/// What is commanded in a campaign.
struct Programme {
    slips: Slips,
    loads: Vec<f64>,
    load_spread: f64,
    rim_speeds_m_s: Vec<f64>,
    passes: usize,
    slip_angles_rad: Vec<f64>,
    pitch_std_rad: f64,
    /// Turn of the wheel from row to row, rad.
    turn_rad: f64,
    temperature_c: f64,
    temperature_span_c: f64,
    other: (f64, f64),
}

enum Slips {
    /// One of a few set levels in each run.
    Levels(Vec<f64>),
    /// Anywhere, but steady within a run.
    Spread,
    /// From one value to another within each run.
    Sweeps,
}

impl Layout {
    /// Draws a layout in which what is wanted can show.
    pub fn draw(chance: &mut Chance, site: &Site, wants: &Wants) -> Self {
        let (of_runs, of_rows) = if wants.few_runs { (FEW_RUNS, ROWS_OF_FEW) } else { (RUNS, ROWS) };
        let runs = chance.count(of_runs.0, of_runs.1);
        let single = !wants.long_runs && chance.happens(WINDOWS_SHARE);
        let rows_per_run = if single { 1 } else { chance.count(of_rows.0, of_rows.1).min(MOST_ROWS / runs) };
        let programme = Programme::draw(chance, site, wants, rows_per_run);
        let rows = (0..runs).flat_map(|run| programme.run(chance, site, run, rows_per_run)).collect();
        let levels = matches!(programme.slips, Slips::Levels(_));
        let repeats = rows_per_run >= 4 && !matches!(programme.slips, Slips::Sweeps) || (levels && runs >= 24);
        Self { rows, runs, rows_per_run, repeats, meaningful: programme.meaningful(site, rows_per_run) }
    }
}

impl Programme {
    fn draw(chance: &mut Chance, site: &Site, wants: &Wants, rows_per_run: usize) -> Self {
        let one_or_more = |chance: &mut Chance, several: bool, share: f64| several || chance.happens(share);
        let speeds = if one_or_more(chance, wants.speeds, 0.3) { chance.count(3, 6) } else { 1 };
        let slip_angles = if one_or_more(chance, wants.slip_angles, 0.1) {
            let most = chance.between(0.1, 0.35);
            [-1.0, -0.5, 0.0, 0.5, 1.0].map(|share| share * most).to_vec()
        } else {
            vec![0.0]
        };
        Self {
            slips: Slips::draw(chance, wants, rows_per_run),
            load_spread: if chance.happens(0.3) || wants.loads { chance.between(0.1, 0.45) } else { 0.01 },
            loads: load_levels(chance, site.load_n, wants.loads),
            rim_speeds_m_s: spread_levels(chance, speeds, (0.01, 0.4)),
            passes: if one_or_more(chance, wants.passes, 0.25) { chance.count(2, 6) } else { 1 },
            slip_angles_rad: slip_angles,
            pitch_std_rad: if one_or_more(chance, wants.pitches, 0.2) { chance.between(0.03, 0.2) } else { 0.0 },
            turn_rad: turn_between_rows(chance, site, wants),
            temperature_c: chance.between(-5.0, 25.0),
            temperature_span_c: chance.between(5.0, 25.0),
            other: (chance.between(0.0, 40.0), chance.between(10.0, 60.0)),
        }
    }

    /// The rows of a run, the slip and load steady up to what a controller leaves.
    fn run(&self, chance: &mut Chance, site: &Site, run: usize, rows: usize) -> Vec<Row> {
        let (from, to) = self.slips.of_run(chance, run);
        let load_n = chance.pick(&self.loads) * (1.0 + chance.between(-self.load_spread, self.load_spread));
        let rate_rad_s = chance.pick(&self.rim_speeds_m_s) / site.wheel.radius_m;
        let first_turn_rad = if rows > 1 { chance.between(0.0, std::f64::consts::TAU) } else { 0.0 };
        let start = Setting {
            pass: 1.0 + (run % self.passes) as f64,
            temperature_c: self.temperature_c + chance.between(0.0, self.temperature_span_c),
            hours_since_zero: chance.between(0.0, 6.0),
            wheel_rate_rad_s: rate_rad_s,
            speed_m_s: 0.0,
            wheel_angle_rad: first_turn_rad,
            travel_m: 0.0,
            pitch_rad: chance.normal(self.pitch_std_rad),
            slip_angle_rad: chance.pick(&self.slip_angles_rad),
            other: self.other.0 + chance.between(0.0, self.other.1),
        };
        let warming_c = chance.between(-1.0, 1.0);
        // Recording starts some way after the wheel does.
        let mut travel_m = if rows > 1 { chance.between(0.05, 2.0) * site.contact_length_m() } else { 0.0 };
        let step = |place: usize| {
            let share = if rows > 1 { place as f64 / (rows - 1) as f64 } else { 0.0 };
            let slip = (from + (to - from) * share + chance.normal(0.004)).clamp(0.005, 0.75);
            let turn_rad = turned(self.turn_rad, place, chance.between(0.98, 1.02));
            let speed_m_s = rate_rad_s * site.wheel.radius_m * (1.0 - slip);
            let t_s = turn_rad / rate_rad_s;
            if place > 0 {
                travel_m += speed_m_s * self.turn_rad / rate_rad_s;
            }
            let setting = Setting {
                temperature_c: start.temperature_c + warming_c * share,
                hours_since_zero: start.hours_since_zero + t_s / 3600.0,
                speed_m_s,
                wheel_angle_rad: start.wheel_angle_rad + turn_rad,
                travel_m,
                ..start
            };
            Row { run, t_s, slip, load_n: load_n * (1.0 + chance.normal(0.005)), setting }
        };
        (0..rows).map(step).collect()
    }

    /// The optional columns that say something about this programme.
    fn meaningful(&self, site: &Site, rows_per_run: usize) -> Vec<Channel> {
        let mut columns = vec![Channel::Temperature, Channel::HoursSinceZero, Channel::Speed, Channel::WheelRate];
        let fast = site.grouser_pitch_rad().is_none_or(|pitch_rad| self.turn_rad < FAST_ROWS * pitch_rad);
        let conditional = [
            (Channel::Pass, self.passes > 1),
            (Channel::Travel, rows_per_run > 1),
            (Channel::WheelAngle, rows_per_run > 1 && fast),
            (Channel::Pitch, self.pitch_std_rad > 0.0),
            (Channel::SlipAngle, self.slip_angles_rad.len() > 1),
        ];
        columns.extend(conditional.into_iter().filter(|(_, holds)| *holds).map(|(column, _)| column));
        columns
    }
}

impl Slips {
    fn draw(chance: &mut Chance, wants: &Wants, rows_per_run: usize) -> Self {
        if rows_per_run > 1 && (wants.changing_slip || chance.happens(0.3)) {
            return Self::Sweeps;
        }
        if chance.happens(0.5) {
            return Self::Spread;
        }
        let count = chance.count(4, 8);
        let (low, high) = (chance.between(SLIPS.0, 0.1), chance.between(0.4, SLIPS.1));
        Self::Levels((0..count).map(|level| low + (high - low) * level as f64 / (count - 1) as f64).collect())
    }

    /// The slips with which a run begins and ends.
    fn of_run(&self, chance: &mut Chance, run: usize) -> (f64, f64) {
        match self {
            Self::Levels(levels) => (levels[run % levels.len()], levels[run % levels.len()]),
            Self::Spread => {
                let slip = chance.between(SLIPS.0, SLIPS.1);
                (slip, slip)
            }
            Self::Sweeps => (chance.between(SLIPS.0, SLIPS.1), chance.between(SLIPS.0, SLIPS.1)),
        }
    }
}

/// How far the wheel has turned at a row, rad, where it turns so far between rows: the first of them at so many times the rate that was asked
/// for, any others as asked for, so that no row is earlier than the one before it.
fn turned(between_rows_rad: f64, place: usize, rate: f64) -> f64 {
    let first = place.min(ROWS.1);
    between_rows_rad * first as f64 * rate + between_rows_rad * (place - first) as f64
}

/// One load or three.
fn load_levels(chance: &mut Chance, mean_n: f64, several: bool) -> Vec<f64> {
    if several || chance.happens(0.4) {
        let spread = chance.between(0.15, 0.5);
        vec![mean_n * (1.0 - spread), mean_n, mean_n * (1.0 + spread)]
    } else {
        vec![mean_n]
    }
}

/// As many levels as asked for, evenly in the logarithm over a good part of a range.
fn spread_levels(chance: &mut Chance, count: usize, range: (f64, f64)) -> Vec<f64> {
    if count == 1 {
        return vec![chance.log_between(range.0, range.1)];
    }
    let (low, high) = (range.0 * chance.between(1.0, 2.0), range.1 * chance.between(0.5, 1.0));
    (0..count).map(|level| low * libm::pow(high / low, level as f64 / (count - 1) as f64)).collect()
}

/// How far the wheel turns from row to row.
fn turn_between_rows(chance: &mut Chance, site: &Site, wants: &Wants) -> f64 {
    match site.grouser_pitch_rad() {
        Some(pitch_rad) if wants.fast_rows => chance.between(0.1, FAST_ROWS) * pitch_rad,
        _ if wants.changing_slip => chance.between(0.2, 1.0) * site.contact_length_m() / site.wheel.radius_m,
        _ => chance.log_between(0.02, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_ROWS, turned};

    #[test]
    fn each_row_of_a_run_is_later_than_the_one_before_it() {
        for place in 1..MOST_ROWS {
            assert!(turned(0.1, place, 0.98) > turned(0.1, place - 1, 1.02), "row {place}");
        }
    }
}
