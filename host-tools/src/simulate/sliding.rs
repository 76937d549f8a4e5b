//! Whether a rover slides back while its wheels drive on: then rim and hub move oppositely, for which there is no slip.

use kapvik_firmware::rover::PerWheel;

use super::wheel_soil::STANDSTILL_M_S;

/// How far a rover may give way, m: it does so by some millimetres where it starts on a slope or a wheel is held.
const GIVES_WAY_M: f64 = 0.02;

/// How far a rover has come in the direction in which its wheels drive.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sliding {
    /// 1 forward, −1 backward, 0 where they stand.
    direction: f64,
    /// The furthest in that direction, m.
    furthest_m: f64,
}

impl Sliding {
    /// Whether it slides back, by the rim speeds and the place at the next instant.
    pub fn is_seen(&mut self, rim_speed_m_s: &PerWheel<f64>, x_m: f64) -> bool {
        let mean_m_s = rim_speed_m_s.iter_wheels().sum::<f64>() / 6.0;
        let direction = if mean_m_s.abs() > STANDSTILL_M_S { mean_m_s.signum() } else { 0.0 };
        let come_m = direction * x_m;
        if direction != self.direction {
            *self = Self { direction, furthest_m: come_m };
        }
        self.furthest_m = self.furthest_m.max(come_m);
        self.furthest_m - come_m > GIVES_WAY_M
    }
}
