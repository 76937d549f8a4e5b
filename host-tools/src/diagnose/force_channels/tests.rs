//! Campaigns whose sensors are made to err by a known law, and measured ones.

use std::fmt::Write;
use std::path::Path;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::data::campaign::Carried;

const TOML: &str = "name = \"made\"\nkind = \"simulated\"\nsource = \"\"\ngravity_m_s2 = 9.81\n[wheel]\nradius_m = 0.1\n\
                    width_m = 0.1\n[soil]\n[noise]\n";
const HEADER: &str = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm,side_force_n,hours_since_zero,temperature_c\n";

/// One wheel state, without the sensors' errors.
#[derive(Clone, Copy)]
struct State {
    load_n: f64,
    pull_n: f64,
    torque_nm: f64,
    hours: f64,
    temperature_c: f64,
}

/// What a sensor adds to (load, side force).
type Law = fn(State) -> (f64, f64);

/// A made campaign's layout and scatter.
#[derive(Clone, Copy)]
struct Made {
    runs: usize,
    rows_per_run: usize,
    levels_n: &'static [f64],
    /// Scatter of the true load within a level, one standard deviation over the load.
    jitter: f64,
    /// Whether all runs are at one slip.
    still: bool,
    law: Law,
}

const PLAIN: Made =
    Made { runs: 30, rows_per_run: 1, levels_n: &[40.0, 80.0], jitter: 0.01, still: false, law: |_| (0.0, 0.0) };

impl Made {
    /// Forces in proportion to the true load, with saturating thrust: enough to be moved by slip and by load as forces are.
    fn csv(&self, seed: u64) -> String {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = move |std: f64| -> f64 {
            let drawn: f64 = StandardNormal.sample(&mut random);
            std * drawn
        };
        let mut csv = HEADER.to_owned();
        for run in 0..self.runs {
            let place = if self.still { 0.5 } else { ((run * 7) % self.runs) as f64 / self.runs as f64 };
            let slip = -0.6 + 1.4 * place;
            let set_n = self.levels_n[run % self.levels_n.len()];
            let load_n = set_n * (1.0 + normal(self.jitter));
            let hours = 4.0 * ((run * 11) % 17) as f64 / 17.0;
            let temperature_c = 20.0 + 3.0 * ((run * 5) % 13) as f64 / 13.0;
            for row in 0..self.rows_per_run {
                let pull_n = load_n * (0.35 * (slip / 0.2).tanh() - 0.1);
                let torque_nm = 0.05 * load_n * (0.4 + slip);
                let (load_off, side_off) = (self.law)(State { load_n, pull_n, torque_nm, hours, temperature_c });
                let fields = [
                    slip + normal(0.005),
                    load_n + load_off + normal(0.4),
                    pull_n + normal(0.5),
                    torque_nm + normal(0.02),
                    side_off + normal(0.3),
                    hours,
                    temperature_c,
                ];
                let fields = fields.map(|field| field.to_string()).join(",");
                writeln!(csv, "r{run},{row},{fields}").expect("text");
            }
        }
        csv
    }

    fn campaign(&self, seed: u64) -> Campaign {
        Campaign::parse(Path::new("made.csv"), &self.csv(seed), TOML).expect("a campaign")
    }
}

fn found(campaign: &Campaign) -> Vec<FoundEffect> {
    force_channels(campaign, &[]).effects().cloned().collect()
}

/// The one effect found, and how far its parameter is from the truth in standard deviations.
fn is_found(made: &Made, seed: u64, (id, form, parameter): (&str, &str, &str), truth: f64) {
    let found = found(&made.campaign(seed));
    let [effect] = found.as_slice() else { panic!("{form}: {found:?}") };
    assert_eq!((effect.id.as_str(), effect.form.as_str()), (id, form));
    let estimate = effect.parameters[parameter];
    assert!((estimate.value - truth).abs() < 3.0 * estimate.std, "{parameter} = {estimate:?}");
    assert!(estimate.std < 0.25 * truth.abs(), "{parameter} = {estimate:?}");
    assert!(effect.p_value < 0.01 && effect.gain_per_row > 0.0);
}

#[test]
fn each_law_of_a_sensor_is_found_by_its_name_and_size() {
    let with = |law: Law| Made { law, ..PLAIN };
    is_found(&with(|at| (-0.2 * at.pull_n.abs(), 0.0)), 1, ("guide-friction", "load", "mu"), 0.2);
    let into_load = ("crosstalk", "drawbar pull into load", "drawbar_pull_to_load");
    is_found(&with(|at| (0.15 * at.pull_n, 0.0)), 2, into_load, 0.15);
    is_found(&with(|at| (-0.9 * at.hours, 0.0)), 3, ("force-drift", "load with hours", "load_n_per_h"), -0.9);
    let warm = ("force-drift", "load with temperature", "load_n_per_c");
    is_found(&with(|at| (1.5 * at.temperature_c, 0.0)), 4, warm, 1.5);
    is_found(&with(|_| (0.0, 0.6)), 5, ("force-bias", "side force", "side_force_n"), 0.6);
    let hours = ("force-drift", "side force with hours", "side_force_n_per_h");
    is_found(&with(|at| (0.0, 0.3 * at.hours)), 6, hours, 0.3);
    let into_side = ("crosstalk", "load into side force", "load_to_side_force");
    is_found(&with(|at| (0.0, 0.02 * at.load_n)), 7, into_side, 0.02);
    let pull = ("crosstalk", "drawbar pull into side force", "drawbar_pull_to_side_force");
    is_found(&with(|at| (0.0, -0.05 * at.pull_n)), 8, pull, -0.05);
}

/// A number that no wheel can have felt is left out here, too: one such would hide what all others show.
#[test]
fn a_gross_error_hides_nothing() {
    let made = Made { law: |_| (0.0, 0.6), ..PLAIN };
    let text = made.csv(5);
    let side = text.lines().nth(1).and_then(|row| row.rsplit(',').nth(2)).expect("a side force");
    let spoiled = Campaign::parse(Path::new("made.csv"), &text.replacen(side, "2000", 1), TOML).expect("a campaign");
    assert!(spoiled.gross_error(0).is_some());
    let [sound, beside] = [&made.campaign(5), &spoiled].map(found);
    let size = |found: &[FoundEffect]| found[0].parameters["side_force_n"].value;
    assert!(beside.len() == 1 && (size(&beside) - size(&sound)).abs() < 0.1, "{beside:?}, {sound:?}");
}

#[test]
fn torque_is_told_from_drawbar_pull_or_the_doubt_is_said() {
    let made = Made { law: |at| (1.5 * at.torque_nm, 0.0), runs: 60, ..PLAIN };
    let found = force_channels(&made.campaign(9), &[]);
    let names = found.effects().map(|effect| effect.form.as_str()).chain(found.caveats().map(String::as_str));
    assert!(names.into_iter().any(|name| name.contains("torque into load")), "{found:?}");
}

#[test]
fn two_laws_are_found_one_after_the_other() {
    let made = Made { law: |at| (-0.25 * at.pull_n.abs() + 0.8 * at.hours, 0.0), runs: 50, ..PLAIN };
    let found = found(&made.campaign(10));
    let mut ids: Vec<&str> = found.iter().map(|effect| effect.id.as_str()).collect();
    ids.sort_unstable();
    assert_eq!(ids, ["force-drift", "guide-friction"]);
}

/// A true load that scatters moves the forces with it: no error of a sensor.
#[test]
fn clean_campaigns_show_nothing() {
    let layouts = [
        PLAIN,
        Made { jitter: 0.05, ..PLAIN },
        Made { levels_n: &[60.0], jitter: 0.08, ..PLAIN },
        Made { runs: 16, rows_per_run: 4, jitter: 0.02, ..PLAIN },
        Made { runs: 60, rows_per_run: 6, levels_n: &[20.0, 40.0, 80.0], jitter: 0.04, ..PLAIN },
    ];
    let each = 80;
    let fired = |made: &Made| (0..each).filter(|seed| !found(&made.campaign(100 + seed)).is_empty()).count();
    let alarms: Vec<usize> = layouts.iter().map(fired).collect();
    assert!(alarms.iter().sum::<usize>() as f64 <= 0.02 * (each as usize * layouts.len()) as f64, "{alarms:?}");
}

#[test]
fn one_run_constant_slip_and_equal_loads_say_nothing_of_the_load() {
    let law: Law = |at| (-0.3 * at.pull_n.abs(), 0.0);
    assert_eq!(found(&Made { runs: 1, rows_per_run: 40, law, ..PLAIN }.campaign(11)), []);
    let equal = "run,t_s,slip,load_n,drawbar_pull_n\n".to_owned()
        + &(0..20)
            .map(|run| format!("r{run},0,{},50,{}\n", 0.04 * f64::from(run), 0.5 * f64::from(run)))
            .collect::<String>();
    let equal = Campaign::parse(Path::new("equal.csv"), &equal, TOML).expect("a campaign");
    assert_eq!(found(&equal), []);
    // At one slip the forces follow the scatter of the load, and nothing tells which follows which.
    let jittered = Made { jitter: 0.05, levels_n: &[60.0], still: true, ..PLAIN };
    assert_eq!(found(&jittered.campaign(12)), []);
}

/// Load lost per horizontal force on the rig's measured steady runs: 0.135 ± 0.015 by a least-squares line through them
/// (reading = 25.0 N − 0.135 |DP|), and a side force that grows by about 0.23 N in an hour.
#[test]
fn the_measured_rig_loses_load_and_its_side_force_drifts() {
    let campaign = Carried::CmuSmoothStraight.campaign().expect("the project's own figures");
    let found = force_channels(&campaign, &[]);
    let mu = found.effects().find_map(|effect| effect.parameters.get("mu")).expect("guide friction");
    assert!((mu.value - 0.135).abs() < 0.003 && (mu.std - 0.015).abs() < 0.002, "{mu:?}");
    let side = found.effects().find_map(|effect| effect.parameters.get("side_force_n_per_h")).expect("a drift");
    assert!((side.value - 0.23).abs() < 0.06 && side.std < 0.06, "{side:?}");
}
