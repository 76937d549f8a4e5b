//! What an effect may depend on.

use crate::scalar::Scalar;
use crate::terramechanics::{Soil, Wheel};

/// What is known of a wheel at an instant beside slip, load and forces. An effect does nothing where what it follows is
/// not known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Conditions<S> {
    /// Which pass over the same ground it is, from 1.
    pub pass: Option<S>,
    /// Temperature, °C.
    pub temperature_c: Option<S>,
    /// Time since the force sensors were zeroed, h.
    pub hours_since_zero: Option<S>,
    /// Speed of the hub along the ground, m/s.
    pub speed_m_s: Option<S>,
    /// Rate of the wheel, rad/s.
    pub wheel_rate_rad_s: Option<S>,
    /// Angle by which the wheel has turned, rad.
    pub wheel_angle_rad: Option<S>,
    /// Way travelled, m.
    pub travel_m: Option<S>,
    /// Pitch of rig or rover, rad, positive nose-up.
    pub pitch_rad: Option<S>,
    /// Slip angle, rad.
    pub slip_angle_rad: Option<S>,
    /// The slip that the soil under the wheel has felt, −1 … 1, where it is not the present one: a wheel digs over a way of
    /// about a contact length, not at once.
    pub felt_slip: Option<S>,
}

impl<S: Copy> Conditions<S> {
    /// The same conditions in another scalar.
    pub fn map<T>(&self, convert: impl Fn(S) -> T) -> Conditions<T> {
        Conditions {
            pass: self.pass.map(&convert),
            temperature_c: self.temperature_c.map(&convert),
            hours_since_zero: self.hours_since_zero.map(&convert),
            speed_m_s: self.speed_m_s.map(&convert),
            wheel_rate_rad_s: self.wheel_rate_rad_s.map(&convert),
            wheel_angle_rad: self.wheel_angle_rad.map(&convert),
            travel_m: self.travel_m.map(&convert),
            pitch_rad: self.pitch_rad.map(&convert),
            slip_angle_rad: self.slip_angle_rad.map(&convert),
            felt_slip: self.felt_slip.map(&convert),
        }
    }
}

/// The grousers of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grousers<S> {
    /// Height over the rim, m; 0 of a smooth wheel.
    pub height_m: S,
    /// How many there are around the rim.
    pub count: S,
}

impl<S: Scalar> Grousers<S> {
    /// Those of a smooth wheel.
    pub fn none() -> Self {
        Self { height_m: S::zero(), count: S::zero() }
    }

    /// The same grousers in another scalar.
    pub fn map<T>(self, convert: impl Fn(S) -> T) -> Grousers<T> {
        Grousers { height_m: convert(self.height_m), count: convert(self.count) }
    }
}

/// All that the effects on soil and contact look at.
#[derive(Debug, Clone, Copy)]
pub struct Circumstances<'a, S> {
    /// The wheel.
    pub wheel: &'a Wheel<S>,
    /// Its grousers.
    pub grousers: &'a Grousers<S>,
    /// The soil as the seed's equations see it, before any effect.
    pub soil: &'a Soil<S>,
    /// What else is known of the instant.
    pub conditions: &'a Conditions<S>,
    /// True slip, −1 … 1.
    pub slip: S,
    /// True normal load, N.
    pub load_n: S,
    /// Gravity, m/s².
    pub gravity_m_s2: S,
}

/// v/(rω) at a slip, −1 … 1: 1 − i when driving, 1/(1 + i) when braking.
pub fn speed_ratio<S: Scalar>(slip: S) -> S {
    if slip < S::zero() { S::one() / (S::one() + slip) } else { S::one() - slip }
}

impl<S: Scalar> Circumstances<'_, S> {
    /// The slip that the soil under the wheel has felt: as stated, or the present one.
    pub fn felt_slip(&self) -> S {
        self.conditions.felt_slip.unwrap_or(self.slip)
    }

    /// Rate of the wheel, rad/s: as stated, or from the speed over the ground and the slip. None of a wheel that spins on
    /// the spot or is locked, where it does not follow.
    pub fn wheel_rate_rad_s(&self) -> Option<S> {
        let ratio = speed_ratio(self.slip);
        let followed = self.conditions.speed_m_s.map(|speed| speed / (self.wheel.radius_m * ratio));
        self.conditions.wheel_rate_rad_s.or(followed).filter(|rate| rate.is_finite())
    }

    /// Speed of the hub over the ground, m/s: as stated, or from the rate of the wheel and the slip.
    pub fn speed_m_s(&self) -> Option<S> {
        let followed = self.conditions.wheel_rate_rad_s.map(|rate| rate * self.wheel.radius_m * speed_ratio(self.slip));
        self.conditions.speed_m_s.or(followed).filter(|speed| speed.is_finite())
    }

    /// Sine and cosine of the grousers' place: their count times the angle of the wheel. None of a smooth wheel.
    pub fn grouser_phase(&self) -> Option<(S, S)> {
        let angle = self.conditions.wheel_angle_rad?;
        (self.grousers.count > S::zero()).then(|| reduced(self.grousers.count * angle).sin_cos())
    }

    /// N_φ = tan²(45° + φ/2): Rankine's coefficient of passive pressure.
    pub fn passive_coefficient(&self) -> S {
        let sine = self.soil.friction_angle_rad.sin();
        (S::one() + sine) / (S::one() - sine)
    }

    /// Density of the soil, kg/m³: assumed (the simulants of the catalogue: 1330 … 1650).
    pub fn density_kg_m3(&self) -> S {
        S::constant(1600.0)
    }

    /// Weight of a volume of soil, N/m³, at its assumed density.
    pub fn unit_weight_n_m3(&self) -> S {
        self.density_kg_m3() * self.gravity_m_s2
    }
}

/// An angle brought to within half a turn of zero, so that single precision keeps its digits in the sine.
fn reduced<S: Scalar>(angle_rad: S) -> S {
    const TURN: f64 = core::f64::consts::TAU;
    let turns = f64::from(angle_rad.to_f32()) / TURN;
    angle_rad - S::constant(libm::round(turns) * TURN)
}
