//! What acts on the rover beside the wheel–soil equations: by id, with a value.

/// Effects on sensors and drives, each absent at zero.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SensorEffects {
    /// Coulomb friction of each drive, N·m at the wheel, against its turning.
    pub drive_friction_nm: f64,
    /// Viscous friction of each drive, N·m·s/rad at the wheel.
    pub drive_viscosity_nm_s: f64,
    /// Gain error of the drive torques.
    pub torque_scale: f64,
    /// Offset of every load cell, N.
    pub force_bias_n: f64,
    /// Drift of every load cell, N per hour.
    pub force_drift_n_h: f64,
    /// Share of the force along the link that leaks into the load cell.
    pub crosstalk: f64,
    /// By how much the wheels' radius exceeds that of the rover file, m.
    pub rolling_radius_m: f64,
    /// Nose-up tilt at which accelerometer and gyro are mounted, rad.
    pub pitch_misalignment_rad: f64,
    /// Gain error of the velocimeter.
    pub velocity_scale: f64,
    /// How late the velocimeter is, s.
    pub latency_s: f64,
}

/// An effect as the command line names it.
pub struct KnownEffect {
    /// Its id.
    pub id: &'static str,
    /// What its value is.
    pub value: &'static str,
    place: fn(&mut SensorEffects) -> &mut f64,
}

/// Every effect that can be asked for. Effects of the soil are not among them: they belong to the wheel–soil equations.
pub const KNOWN: [KnownEffect; 10] = [
    KnownEffect {
        id: "drive-friction",
        value: "Coulomb friction at the wheel, N·m",
        place: |e| &mut e.drive_friction_nm,
    },
    KnownEffect {
        id: "drive-viscosity",
        value: "viscous friction at the wheel, N·m·s/rad",
        place: |e| &mut e.drive_viscosity_nm_s,
    },
    KnownEffect { id: "torque-scale", value: "gain error of the drive torques", place: |e| &mut e.torque_scale },
    KnownEffect { id: "force-bias", value: "offset of the load cells, N", place: |e| &mut e.force_bias_n },
    KnownEffect { id: "force-drift", value: "drift of the load cells, N/h", place: |e| &mut e.force_drift_n_h },
    KnownEffect {
        id: "crosstalk",
        value: "share of the force along the link in the load cells",
        place: |e| &mut e.crosstalk,
    },
    KnownEffect {
        id: "rolling-radius",
        value: "wheel radius over that of the rover file, m",
        place: |e| &mut e.rolling_radius_m,
    },
    KnownEffect {
        id: "pitch-misalignment",
        value: "nose-up tilt of accelerometer and gyro, rad",
        place: |e| &mut e.pitch_misalignment_rad,
    },
    KnownEffect { id: "velocity-scale", value: "gain error of the velocimeter", place: |e| &mut e.velocity_scale },
    KnownEffect { id: "latency", value: "delay of the velocimeter, s", place: |e| &mut e.latency_s },
];

impl SensorEffects {
    /// Sets the effect of that id; false where there is none.
    pub fn set(&mut self, id: &str, value: f64) -> bool {
        let known = KNOWN.iter().find(|known| known.id == id);
        known.map(|known| *(known.place)(self) = value).is_some()
    }

    /// Friction of a drive that turns, N·m; none of one that stands.
    pub fn friction_nm(&self, rate_rad_s: f64) -> f64 {
        let sign = if rate_rad_s == 0.0 { 0.0 } else { rate_rad_s.signum() };
        sign * self.drive_friction_nm + rate_rad_s * self.drive_viscosity_nm_s
    }
}
