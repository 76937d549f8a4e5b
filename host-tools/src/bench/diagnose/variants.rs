//! Listed effects by other equations than the library's: what is measured need not follow the law that we wrote down.
//!
//! Most of the laws are ones that the literature has for the same effect.

use kapvik_firmware::terramechanics::Soil;

use super::overlay::{Act, Place};
use super::site::Site;
use super::state::{Row, State};
use super::stress::{StressPoint, janosi_hanamoto_pa, strength_pa};
use super::wants::Wants;
use crate::data::campaign::Channel;

/// A listed effect by another law.
#[derive(Debug, Clone, Copy)]
pub struct Variant {
    /// The effect's id.
    pub id: &'static str,
    /// The law's name.
    pub law: &'static str,
    /// Sizes that are looked at, from 0.
    pub greatest: f64,
    /// Whether it may act the other way round.
    pub signed: bool,
    /// What a campaign must have for it.
    pub wants: fn() -> Wants,
    /// How it acts.
    pub act: Act,
}

const fn variant(id: &'static str, law: &'static str, greatest: f64, wants: fn() -> Wants, act: Act) -> Variant {
    Variant { id, law, greatest, signed: false, wants, act }
}

const fn signed(id: &'static str, law: &'static str, greatest: f64, wants: fn() -> Wants, act: Act) -> Variant {
    Variant { id, law, greatest, signed: true, wants, act }
}

/// All of them.
pub const VARIANTS: [Variant; 19] = [
    variant("slip-sinkage", "z₀ (1 + s)/(1 − s/2), partly (Lyasko)", 2.0, sinkage, Act::Sinkage(lyasko)),
    variant("slip-sinkage", "z₀ (1 + S s)", 3.0, sinkage, Act::Sinkage(|place, size| 1.0 + size * place.slip)),
    variant("grouser-ripple", "two harmonics", 0.5, fast_rows, Act::State(two_harmonics)),
    variant("multi-pass", "stiffness linear in passes", 1.0, passes, Act::Soil(stiffness_by_pass)),
    variant("multi-pass", "stiffness, c and tan φ grow with passes", 0.5, passes, Act::Soil(strength_by_pass)),
    variant("lateral-slip", "saturating side friction, passive wedge", 1.5, slip_angles, Act::State(side_friction)),
    variant("bulldozing", "resistance beyond a tenth of the radius", 2.0, Wants::default, Act::State(late_bulldozing)),
    variant("interface-friction", "smooth cap", 3.0, Wants::default, Act::Shear(smooth_cap)),
    variant("shear-hump", "added (j/K) e^(1 − j/K)", 1.5, Wants::default, Act::Shear(added_hump)),
    signed("peak-stress-shift", "quadratic in slip", 1.0, Wants::default, Act::Soil(peak_by_slip_squared)),
    signed("load-stiffening", "stiffness linear in load", 0.9, loads, Act::Soil(stiffness_by_load)),
    variant("sinkage-lag", "two stages one after the other", 4.0, travel, Act::Run(two_stage_lag)),
    signed("rate", "stiffness linear in speed", 0.9, speeds, Act::Soil(stiffness_by_speed)),
    variant("rate", "drag of viscous soil, linear in speed", 1.0, speeds, Act::State(viscous_drag)),
    variant("drive-friction", "Stribeck", 1.0, wheel_rates, Act::State(stribeck)),
    variant("drive-friction", "offset and a share of |T|", 1.0, torque, Act::State(loaded_friction)),
    signed("force-drift", "creep, ln(1 + t/τ)", 0.5, hours, Act::State(creeping_drift)),
    variant("guide-friction", "rounded at zero", 0.9, Wants::default, Act::State(rounded_guide)),
    signed("rolling-radius", "velocity scale that follows sinkage", 1.0, sinkage, Act::State(camera_height)),
];

fn sinkage() -> Wants {
    Wants::columns(&[Channel::Sinkage])
}

fn torque() -> Wants {
    Wants::columns(&[Channel::Torque])
}

fn fast_rows() -> Wants {
    Wants { grousers: true, fast_rows: true, long_runs: true, ..Wants::columns(&[Channel::WheelAngle]) }
}

fn passes() -> Wants {
    Wants { passes: true, ..Wants::columns(&[Channel::Pass]) }
}

fn slip_angles() -> Wants {
    Wants { slip_angles: true, ..Wants::columns(&[Channel::SlipAngle]) }
}

fn loads() -> Wants {
    Wants { loads: true, ..Wants::default() }
}

fn travel() -> Wants {
    Wants { long_runs: true, changing_slip: true, ..Wants::columns(&[Channel::Travel, Channel::Sinkage]) }
}

fn speeds() -> Wants {
    Wants { speeds: true, ..Wants::columns(&[Channel::Speed]) }
}

fn wheel_rates() -> Wants {
    Wants { speeds: true, ..Wants::columns(&[Channel::Torque, Channel::WheelRate]) }
}

fn hours() -> Wants {
    Wants::columns(&[Channel::HoursSinceZero])
}

fn stiffer(soil: &Soil<f64>, factor: f64) -> Soil<f64> {
    let factor = factor.max(0.05);
    Soil {
        cohesive_modulus: factor * soil.cohesive_modulus,
        frictional_modulus: factor * soil.frictional_modulus,
        ..*soil
    }
}

fn lyasko(place: &Place<'_>, size: f64) -> f64 {
    1.0 + size * ((1.0 + place.slip) / (1.0 - 0.5 * place.slip) - 1.0)
}

/// Passive earth pressure coefficient N_φ = tan²(45° + φ/2).
fn passive(soil: &Soil<f64>) -> f64 {
    let tangent = libm::tan(std::f64::consts::FRAC_PI_4 + 0.5 * soil.friction_angle_rad);
    tangent * tangent
}

/// Weight of a loose soil, N/m³.
const SOIL_WEIGHT: f64 = 1600.0 * 9.81;

fn two_harmonics(place: &Place<'_>, state: &mut State, size: f64) {
    let phase = f64::from(place.site.grousers.count) * place.setting.wheel_angle_rad;
    let wave = libm::sin(phase) + 0.4 * libm::sin(2.0 * phase + 1.0);
    state.drawbar_pull_n += size * place.load_n * wave;
    state.torque_nm += 0.8 * size * place.load_n * place.site.wheel.radius_m * wave;
}

fn stiffness_by_pass(place: &Place<'_>, size: f64) -> Soil<f64> {
    stiffer(&place.site.soil, 1.0 + size * (place.setting.pass - 1.0))
}

fn strength_by_pass(place: &Place<'_>, size: f64) -> Soil<f64> {
    let (soil, factor) = (&place.site.soil, 1.0 + size * (place.setting.pass - 1.0));
    let friction_angle_rad = libm::atan(factor * libm::tan(soil.friction_angle_rad));
    Soil { cohesion_pa: factor * soil.cohesion_pa, friction_angle_rad, ..stiffer(soil, factor) }
}

/// μ W (1 − e^(−12 |β|)) and the passive wedge beside the contact, against the sideways motion.
fn side_friction(place: &Place<'_>, state: &mut State, size: f64) {
    let (soil, angle_rad) = (&place.site.soil, place.setting.slip_angle_rad);
    let chord_m = libm::sqrt(2.0 * place.sinkage_m * place.site.wheel.radius_m);
    let friction_n =
        0.6 * libm::tan(soil.friction_angle_rad) * place.load_n * (1.0 - libm::exp(-12.0 * angle_rad.abs()));
    let depth_m = place.sinkage_m;
    let wedge_n = chord_m
        * (0.5 * SOIL_WEIGHT * depth_m * depth_m * passive(soil) + 2.0 * soil.cohesion_pa * depth_m)
        * libm::sin(angle_rad.abs());
    state.side_force_n += size * angle_rad.signum() * (friction_n + wedge_n);
    state.drawbar_pull_n -= size * friction_n * libm::tan(angle_rad.abs());
}

fn late_bulldozing(place: &Place<'_>, state: &mut State, size: f64) {
    let beyond = (place.sinkage_m / place.site.wheel.radius_m - 0.1).max(0.0);
    state.drawbar_pull_n -= size * place.load_n * beyond;
}

/// τ / (1 + (τ/cap)⁴)^¼ with cap = σ tan φ / size.
fn smooth_cap(place: &Place<'_>, point: &StressPoint, size: f64) -> f64 {
    let plain_pa = janosi_hanamoto_pa(place, point);
    let friction_pa = (point.normal_pa * libm::tan(place.site.soil.friction_angle_rad)).max(1.0);
    let over = size * plain_pa / friction_pa;
    plain_pa / libm::sqrt(libm::sqrt(1.0 + over * over * over * over))
}

fn added_hump(place: &Place<'_>, point: &StressPoint, size: f64) -> f64 {
    let relative = point.displacement_m / place.site.soil.shear_modulus_m;
    janosi_hanamoto_pa(place, point) + size * strength_pa(place, point) * relative * libm::exp(1.0 - relative)
}

fn peak_by_slip_squared(place: &Place<'_>, size: f64) -> Soil<f64> {
    let soil = place.site.soil;
    Soil { peak_stress_c1: soil.peak_stress_c1 + size * place.slip * place.slip, ..soil }
}

fn stiffness_by_load(place: &Place<'_>, size: f64) -> Soil<f64> {
    stiffer(&place.site.soil, 1.0 + size * (place.load_n / place.site.load_n - 1.0))
}

/// Against 0.2 m/s, where the soil begins to answer to speed.
fn stiffness_by_speed(place: &Place<'_>, size: f64) -> Soil<f64> {
    stiffer(&place.site.soil, 1.0 + size * place.setting.speed_m_s / 0.2)
}

/// Against 0.2 m/s and a sinkage of half a radius.
fn viscous_drag(place: &Place<'_>, state: &mut State, size: f64) {
    let depth = 2.0 * place.sinkage_m / place.site.wheel.radius_m;
    state.drawbar_pull_n -= size * place.site.load_n * depth * place.setting.speed_m_s / 0.2;
}

fn stribeck(place: &Place<'_>, state: &mut State, size: f64) {
    let relative = place.setting.wheel_rate_rad_s / 0.5;
    let breakaway = 1.0 + 0.8 * libm::exp(-relative * relative);
    state.torque_nm += size * breakaway * place.site.load_n * place.site.wheel.radius_m;
}

fn loaded_friction(place: &Place<'_>, state: &mut State, size: f64) {
    let offset_nm = 0.6 * place.site.load_n * place.site.wheel.radius_m;
    state.torque_nm += size * (offset_nm + 0.3 * state.torque_nm.abs());
}

fn creeping_drift(place: &Place<'_>, state: &mut State, size: f64) {
    state.drawbar_pull_n += size * place.site.load_n * libm::log1p(place.setting.hours_since_zero / 0.2);
}

/// The load that friction of a vertical guide takes: |F| rounded off at zero.
fn rounded_guide(place: &Place<'_>, state: &mut State, size: f64) {
    let force_n = state.drawbar_pull_n;
    state.load_n -= size * force_n * libm::tanh(force_n / (0.03 * place.site.load_n));
}

/// A camera that looks down from two radii sees the ground come nearer as the wheel sinks.
fn camera_height(place: &Place<'_>, state: &mut State, size: f64) {
    state.slip -= size * (1.0 - place.slip) * place.sinkage_m / (2.0 * place.site.wheel.radius_m);
}

/// The measured sinkage runs after the true one over a length (in contact lengths: the size), twice.
fn two_stage_lag(site: &Site, rows: &[Row], states: &mut [State], size: f64) {
    let length_m = (size * site.contact_length_m()).max(1e-9);
    let mut stages = states.first().map_or([0.0; 2], |state| [state.sinkage_m; 2]);
    let mut travel_m = rows.first().map_or(0.0, |row| row.setting.travel_m);
    for (row, state) in rows.iter().zip(states) {
        let share = 1.0 - libm::exp(-2.0 * (row.setting.travel_m - travel_m) / length_m);
        travel_m = row.setting.travel_m;
        stages[0] += share * (state.sinkage_m - stages[0]);
        stages[1] += share * (stages[0] - stages[1]);
        state.sinkage_m = stages[1];
    }
}
