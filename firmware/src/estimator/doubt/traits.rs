//! Which rover it is, for the network that tells how far its filters err.

use core::hint::black_box;

use super::inputs::to_octaves;
use crate::rover::{Rover, SensorNoise, Suspension};
use crate::scalar::Scalar;

/// Numbers that stay as they are all along a drive, in this order: octaves of the noise of encoders, drive torques, cells, angles,
/// accelerometer, gyro and velocimeter, of the wheel's radius and of the load at rest W₀ (9); where front hub, bogie pivot, middle and rear
/// hub are, forward and up, and how far off the body's plane (9); where the mass is, forward and up (2). Noise of forces is over W₀, of
/// torques over W₀ r, of accelerations over gravity, W₀ itself over r² times 1 MPa, all else in SI units; octaves are of 512 times that.
/// Lengths are in wheel diameters.
pub const TRAITS: usize = 20;

/// Numbers of which octaves are told.
const OCTAVES: usize = 9;
/// By what they are multiplied, so that those of the rovers learned from are some octaves around 1.
const TIMES: f64 = 512.0;
/// Unit of W₀/r², Pa.
const PRESSURE_PA: f64 = 1.0e6;

/// The traits of a rover.
pub fn traits<S: Scalar>(rover: &Rover<S>) -> [f32; TRAITS] {
    let SensorNoise { wheel_rate_rad_s, motor_torque_nm, load_cell_n, angle_rad, accel_m_s2, gyro_rad_s, velocity_m_s } =
        rover.noise;
    let Suspension { front_hub, bogie_pivot, middle_hub, rear_hub, half_track_m, centre_of_mass } = rover.suspension;
    let radius_m = rover.wheel.radius_m;
    let rest_n = rover.load_at_rest_n();
    let per_diameter = S::constant(0.5) / radius_m;
    let mut traits = [
        wheel_rate_rad_s,
        motor_torque_nm / (rest_n * radius_m),
        load_cell_n / rest_n,
        angle_rad,
        accel_m_s2 / rover.gravity_m_s2,
        gyro_rad_s,
        velocity_m_s,
        radius_m,
        rest_n / (radius_m * radius_m * S::constant(PRESSURE_PA)),
        front_hub.x,
        front_hub.z,
        bogie_pivot.x,
        bogie_pivot.z,
        middle_hub.x,
        middle_hub.z,
        rear_hub.x,
        rear_hub.z,
        half_track_m,
        centre_of_mass.x,
        centre_of_mass.z,
    ];
    let (sizes, lengths) = traits.split_at_mut(OCTAVES);
    to_octaves(sizes, &[S::constant(TIMES)]);
    black_box(lengths).iter_mut().for_each(|length| *length = *length * per_diameter);
    traits.map(S::to_f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(change: impl Fn(&mut Rover<f64>)) -> [f32; TRAITS] {
        let mut rover = Rover::assumed();
        change(&mut rover);
        traits(&rover)
    }

    #[test]
    fn each_number_of_a_rover_that_matters_is_seen_in_its_trait() {
        let nominal = of(|_| {});
        assert!(nominal.iter().all(|known| known.abs() < 8.0), "{nominal:?}");
        let changed: [(usize, [f32; TRAITS]); 6] = [
            (0, of(|rover| rover.noise.wheel_rate_rad_s *= 2.0)),
            (2, of(|rover| rover.noise.load_cell_n *= 2.0)),
            (6, of(|rover| rover.noise.velocity_m_s *= 2.0)),
            (9, of(|rover| rover.suspension.front_hub.x += 0.15)),
            (17, of(|rover| rover.suspension.half_track_m += 0.15)),
            (19, of(|rover| rover.suspension.centre_of_mass.z += 0.15)),
        ];
        for (place, traits) in changed {
            for (other, (now, before)) in traits.iter().zip(nominal).enumerate() {
                let expected = if other == place { 1.0 } else { 0.0 };
                assert!((now - before - expected).abs() < 1e-6, "{place}, {other}: {now}, {before}");
            }
        }
    }

    /// The same rover on another planet, with an accelerometer that is as good for it.
    #[test]
    fn what_is_the_same_but_for_its_size_has_the_same_shares() {
        let nominal = of(|_| {});
        let larger = of(|rover| {
            rover.mass_kg *= 8.0;
            rover.gravity_m_s2 *= 0.5;
            rover.noise.load_cell_n *= 4.0;
            rover.noise.motor_torque_nm *= 4.0;
            rover.noise.accel_m_s2 *= 0.5;
        });
        for (place, (now, before)) in larger.iter().zip(nominal).enumerate() {
            let expected = if place == 8 { 2.0 } else { 0.0 };
            assert!((now - before - expected).abs() < 1e-6, "{place}: {now}, {before}");
        }
    }
}
