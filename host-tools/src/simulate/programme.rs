//! What the drives are told: a rim speed for each wheel over time.

use kapvik_firmware::rover::PerWheel;

use super::terrain::smooth_step;

/// A new set of rim speeds from a time on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command {
    /// When, s.
    pub from_s: f64,
    /// Rim speeds, m/s, positive forward.
    pub rim_speed_m_s: PerWheel<f64>,
}

/// The commands of a drive. The drives follow each within [`RAMP_S`], without jerk, and the wheels turn at exactly that.
#[derive(Debug, Clone, PartialEq)]
pub struct Programme {
    /// In the order of time; the rover stands before the first.
    pub commands: Vec<Command>,
    /// Slow wandering of the speeds about the command, one wheel unlike the other.
    pub wander: PerWheel<Wander>,
}

/// How long the drives take from one speed to the next, s.
pub const RAMP_S: f64 = 1.5;

/// A slow sine by which a drive's speed departs from its command.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wander {
    /// Amplitude as a share of the speed.
    pub share: f64,
    /// Angular frequency, rad/s.
    pub rate_rad_s: f64,
    /// Phase, rad.
    pub phase_rad: f64,
}

/// How a wheel turns against its link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelTurn {
    /// Rim speed rω, m/s.
    pub rim_speed_m_s: f64,
    /// Its rate of change, m/s².
    pub rim_acceleration_m_s2: f64,
}

impl Programme {
    /// From a time on every wheel turns the other way, at the speed that it was to have.
    pub fn turn_back(&mut self, at_s: f64) {
        let back = |speeds: &mut PerWheel<f64>| speeds.iter_wheels_mut().for_each(|speed| *speed = -*speed);
        let later = self.commands.partition_point(|command| command.from_s < at_s);
        self.commands[later..].iter_mut().for_each(|command| back(&mut command.rim_speed_m_s));
        if let Some(before) = later.checked_sub(1) {
            let mut turned = Command { from_s: at_s, ..self.commands[before] };
            back(&mut turned.rim_speed_m_s);
            self.commands.insert(later, turned);
        }
    }

    /// How the wheels turn at a time.
    pub fn at(&self, time_s: f64) -> PerWheel<WheelTurn> {
        let mut turns = PerWheel::<WheelTurn>::default();
        let mut before = PerWheel::<f64>::default();
        for command in &self.commands {
            let step = smooth_step((time_s - command.from_s) / RAMP_S);
            for ((turn, from), to) in
                turns.iter_wheels_mut().zip(before.iter_wheels()).zip(command.rim_speed_m_s.iter_wheels())
            {
                turn.rim_speed_m_s += step.value * (to - from);
                turn.rim_acceleration_m_s2 += step.slope / RAMP_S * (to - from);
            }
            before = command.rim_speed_m_s;
        }
        for (turn, wander) in turns.iter_wheels_mut().zip(self.wander.iter_wheels()) {
            *turn = wander.applied(*turn, time_s);
        }
        turns
    }
}

impl Wander {
    fn applied(&self, turn: WheelTurn, time_s: f64) -> WheelTurn {
        let (sine, cosine) = libm::sincos(self.rate_rad_s * time_s + self.phase_rad);
        let factor = 1.0 + self.share * sine;
        let growth = self.share * self.rate_rad_s * cosine;
        WheelTurn {
            rim_speed_m_s: factor * turn.rim_speed_m_s,
            rim_acceleration_m_s2: factor * turn.rim_acceleration_m_s2 + growth * turn.rim_speed_m_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::rover::{PerAxle, PerSide};

    use super::{Command, Programme, Wander};

    #[test]
    fn a_rover_that_turns_back_goes_as_far_the_other_way() {
        let commands = [(1.0, 0.02), (6.0, 0.03)]
            .map(|(from_s, speed)| Command { from_s, rim_speed_m_s: PerSide::both(PerAxle::all(speed)) })
            .to_vec();
        let mut programme = Programme { commands, wander: PerSide::default() };
        programme.turn_back(4.0);
        let speed = |time: f64| programme.at(time).right.middle.rim_speed_m_s;
        for (time, expected) in [(3.0, 0.02), (5.6, -0.02), (8.0, -0.03)] {
            assert!((speed(time) - expected).abs() < 1.0e-12, "at {time} s: {}", speed(time));
        }
    }

    #[test]
    fn accelerations_are_the_rates_of_the_speeds() {
        let speeds = |speed: f64| PerSide { left: PerAxle::all(speed), right: PerAxle::all(-0.5 * speed) };
        let commands = [(1.0, 0.02), (6.0, 0.0), (7.0, -0.01)]
            .map(|(from_s, speed)| Command { from_s, rim_speed_m_s: speeds(speed) })
            .to_vec();
        let wander = PerSide::both(PerAxle::all(Wander { share: 0.02, rate_rad_s: 0.7, phase_rad: 1.0 }));
        let programme = Programme { commands, wander };
        assert_eq!(programme.at(0.5).left.front.rim_speed_m_s, 0.0);
        for place in 0..1000 {
            let time = 0.01 * f64::from(place);
            let speed = |time: f64| programme.at(time).right.rear.rim_speed_m_s;
            let expected = (speed(time + 1.0e-5) - speed(time - 1.0e-5)) / 2.0e-5;
            assert!((programme.at(time).right.rear.rim_acceleration_m_s2 - expected).abs() < 1.0e-9, "at {time} s");
        }
    }
}
