//! Reference vectors computed with SciPy; `vectors.py` beside this file writes them.

use kapvik_firmware::terramechanics::{Soil, Wheel};

use super::{forces, reference};

/// The columns of `vectors.csv`.
struct Vector {
    wheel: Wheel<f64>,
    soil: Soil<f64>,
    slip: f64,
    sinkage_m: f64,
    drawbar_pull_n: f64,
    load_n: f64,
    torque_nm: f64,
}

fn vectors() -> [Vector; 32] {
    let rows = include_str!("vectors.csv").lines().skip(1);
    rows.map(|row| {
        let numbers: Vec<f64> = row.split(',').map(|field| field.parse().expect("a number")).collect();
        let [n, k_c, k_phi, c, phi, k, c1, c2, eta, r, b, slip, z, pull, load, torque] = numbers[..] else {
            panic!("a vector has 16 columns: {row}")
        };
        Vector {
            wheel: Wheel { radius_m: r, width_m: b },
            soil: Soil {
                sinkage_exponent: n,
                cohesive_modulus: k_c,
                frictional_modulus: k_phi,
                cohesion_pa: c,
                friction_angle_rad: phi,
                shear_modulus_m: k,
                peak_stress_c1: c1,
                peak_stress_c2: c2,
                rebound_ratio: eta,
            },
            slip,
            sinkage_m: z,
            drawbar_pull_n: pull,
            load_n: load,
            torque_nm: torque,
        }
    })
    .collect::<Vec<_>>()
    .try_into()
    .unwrap_or_else(|found: Vec<Vector>| panic!("{} vectors instead of 32", found.len()))
}

#[test]
fn the_library_agrees_with_scipy() {
    for v in vectors() {
        let found = forces(&v.wheel, &v.soil, v.slip, v.sinkage_m);
        let tolerance = 1e-7 * v.load_n;
        assert!((found.drawbar_pull_n - v.drawbar_pull_n).abs() < tolerance, "{found:?} {}", v.drawbar_pull_n);
        assert!((found.load_n - v.load_n).abs() < tolerance, "{found:?} {}", v.load_n);
        assert!((found.torque_nm - v.torque_nm).abs() < tolerance * v.wheel.radius_m, "{found:?} {}", v.torque_nm);
    }
}

/// The reference integrator of these tests is judged by the same vectors, and more strictly.
#[test]
fn the_reference_integrator_agrees_with_scipy() {
    for v in vectors() {
        let found = reference::forces(&v.wheel, &v.soil, v.slip, v.sinkage_m);
        let tolerance = 1e-11 * found.stresses_n;
        assert!((found.drawbar_pull_n - v.drawbar_pull_n).abs() < tolerance, "{found:?} {}", v.drawbar_pull_n);
        assert!((found.load_n - v.load_n).abs() < tolerance, "{found:?} {}", v.load_n);
        assert!((found.torque_nm - v.torque_nm).abs() < tolerance * v.wheel.radius_m, "{found:?} {}", v.torque_nm);
    }
}
