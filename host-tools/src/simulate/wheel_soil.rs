//! What the soil does to a wheel that may drive forward, stand or back up.

use kapvik_firmware::terramechanics::effects::Conditions;
use kapvik_firmware::terramechanics::{ForceError, WheelForces, WheelOnSoil, WheelTruth, deepest_sinkage};

/// Speed below which a wheel counts as standing, m/s: a tenth of a millimetre a second.
///
/// Equations 1–11 know only the ratio of two speeds, and only one direction of travel. Around standstill slip is measured
/// against this speed, and the forces of both directions are blended; forty times as fast both are exact to the last bit.
pub const STANDSTILL_M_S: f64 = 1.0e-4;

/// By how much the load grows with the slope at which a wheel moves into the soil: ż over the faster of rim and hub.
///
/// Massless links on this soil are unstable without damping of the sinking motion: sinking slows the hub, which slips
/// more and finds less support. Taken relative to the speed, as the soil's forces know only ratios of speeds, a damping
/// that is enough at one speed is at every other, and down to standstill. At 2 cm/s and a sixth of Kapvik's weight this
/// one is 3.4 kN·s/m; half of it is too little on some soils of the prior when the rover starts. Of a
/// load it makes up at most 0.05 % on level ground, 1.3 % on hills, 4 % on rocks, and 25 % while a wheel sinks into loosened
/// soil (one drive each).
const SINKING_DAMPING: f64 = 1.0;

/// Speed below which soil whose stiffness or strength follows the speed answers as at this one, m/s: a power of the speed
/// would leave no soil under a rover that stands.
const ANSWERING_M_S: f64 = 1.0e-3;

/// How a wheel moves on the soil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelMotion {
    /// Rim speed rω of the absolute wheel rate, m/s.
    pub rim_speed_m_s: f64,
    /// Speed of the hub along the terrain, m/s.
    pub hub_speed_m_s: f64,
    /// Sinkage, m; below zero the wheel is in the air.
    pub sinkage_m: f64,
    /// Rate of the sinkage, m/s.
    pub sinking_m_s: f64,
}

impl WheelMotion {
    /// Slip of the direction of travel, −1 … 1; none where the wheel stands.
    ///
    /// Of a wheel that backs up it is that of the mirrored wheel, so that driving is positive in both directions; where rim and hub
    /// move oppositely it is 1 of a rim that drives forward, and −1 of one that turns back.
    pub fn slip(&self) -> Option<f64> {
        let fastest = self.rim_speed_m_s.abs().max(self.hub_speed_m_s.abs());
        let backs_up = self.rim_speed_m_s <= 0.0 && self.hub_speed_m_s <= 0.0;
        (fastest > STANDSTILL_M_S).then(|| if backs_up { -self.forward_slip() } else { self.forward_slip() })
    }

    /// (rω − v) over the faster of both; at most 1, where rim and hub move oppositely.
    fn forward_slip(&self) -> f64 {
        ((self.rim_speed_m_s - self.hub_speed_m_s) / self.fastest_m_s()).clamp(-1.0, 1.0)
    }

    /// The faster of rim and hub, which goes over into [`STANDSTILL_M_S`] at standstill.
    fn fastest_m_s(&self) -> f64 {
        let fastest = self.rim_speed_m_s.abs().max(self.hub_speed_m_s.abs());
        fastest + STANDSTILL_M_S * libm::exp(-fastest / STANDSTILL_M_S)
    }

    /// The forces of the soil; none of a wheel in the air. The load contains the damping of the sinking motion.
    ///
    /// `conditions` are those of the wheel; its speed over the ground is this motion's.
    ///
    /// # Errors
    /// Where the wheel has sunk too deep for the equations, or a force overflows.
    pub fn forces(
        &self,
        on_soil: &WheelOnSoil<'_, f64>,
        conditions: &Conditions<f64>,
    ) -> Result<WheelForces<f64>, ForceError> {
        if self.sinkage_m <= 0.0 {
            return Ok(WheelForces { drawbar_pull_n: 0.0, load_n: 0.0, torque_nm: 0.0 });
        }
        if self.sinkage_m > deepest_sinkage(on_soil.wheel) {
            return Err(ForceError::Sinkage);
        }
        let slip = self.forward_slip();
        let share = 0.5 + 0.5 * libm::tanh((self.rim_speed_m_s + self.hub_speed_m_s) / STANDSTILL_M_S);
        let mut sum = WheelForces { drawbar_pull_n: 0.0, load_n: 0.0, torque_nm: 0.0 };
        for (share, sign) in [(share, 1.0), (1.0 - share, -1.0)] {
            if share > 0.0 {
                let mirrored = Conditions {
                    speed_m_s: Some(libm::hypot(self.hub_speed_m_s, ANSWERING_M_S)),
                    wheel_angle_rad: conditions.wheel_angle_rad.map(|angle| sign * angle),
                    ..*conditions
                };
                let forces = at_own_load(on_soil, &mirrored, sign * slip, self.sinkage_m)?;
                sum.drawbar_pull_n += share * sign * forces.drawbar_pull_n;
                sum.load_n += share * forces.load_n;
                sum.torque_nm += share * sign * forces.torque_nm;
            }
        }
        sum.load_n *= 1.0 + SINKING_DAMPING * self.sinking_m_s / self.fastest_m_s();
        Ok(sum)
    }
}

/// What effects follow under a wheel that stands on fresh soil.
pub fn standing_conditions() -> Conditions<f64> {
    Conditions { pass: Some(1.0), speed_m_s: Some(ANSWERING_M_S), ..Conditions::default() }
}

/// The forces at a sinkage, where effects that follow the load see the load that these forces carry.
fn at_own_load(
    on_soil: &WheelOnSoil<'_, f64>,
    conditions: &Conditions<f64>,
    slip: f64,
    sinkage_m: f64,
) -> Result<WheelTruth<f64>, ForceError> {
    const STEPS: usize = 40;
    const LEAST_LOAD_N: f64 = 1.0e-3;
    // Without such an effect the first answer is the last, whatever load is said.
    let at = |ln_load: f64| on_soil.forces(conditions, slip, libm::exp(ln_load), sinkage_m);
    // Where the search starts, about a wheel's load on Kapvik; what it finds is the same from elsewhere.
    const START_N: f64 = 50.0;
    let mut ln_load = libm::log(START_N);
    let mut truth = at(ln_load)?;
    if !on_soil.effects.follow_load() {
        return Ok(truth);
    }
    // By secants on what is missing in the logarithm of the load.
    let missing = |truth: &WheelTruth<f64>, ln_load: f64| libm::log(truth.load_n.max(LEAST_LOAD_N)) - ln_load;
    let mut before = (ln_load, missing(&truth, ln_load));
    ln_load += before.1;
    for _ in 0..STEPS {
        truth = at(ln_load)?;
        let now = (ln_load, missing(&truth, ln_load));
        let slope = (now.1 - before.1) / (now.0 - before.0);
        if now.1.abs() < 1.0e-12 || !slope.is_normal() {
            return Ok(truth);
        }
        before = now;
        ln_load -= (now.1 / slope).clamp(-2.0, 2.0);
    }
    Err(ForceError::Sinkage)
}
