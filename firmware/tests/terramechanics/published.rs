//! Figures worked out elsewhere.

use kapvik_firmware::terramechanics::sinkage_for_load;

use super::{forces, kapvik_wheel, table_1_sand};

/// Slip, drawbar pull (N), torque (N·m) and sinkage (mm) of a 75 × 70 mm wheel under 65.4 N on the seed's Table 1 sand,
/// computed from equations 1–11 with SciPy.
const OPERATING_POINTS: [(f64, f64, f64, f64); 6] = [
    (0.05, -4.31, 1.10, 17.9),
    (0.10, -1.77, 1.30, 17.9),
    (0.20, 2.09, 1.62, 18.1),
    (0.30, 4.75, 1.85, 18.3),
    (0.40, 6.55, 2.02, 18.5),
    (0.60, 8.42, 2.24, 19.2),
];

#[test]
fn operating_points_of_a_kapvik_sized_wheel() {
    for (slip, pull_n, torque_nm, sinkage_mm) in OPERATING_POINTS {
        let z = sinkage_for_load(&kapvik_wheel(), &table_1_sand(), slip, 65.4).expect("carried");
        let found = forces(&kapvik_wheel(), &table_1_sand(), slip, z);
        // Half a digit of the figure, and one per cent.
        assert!((found.drawbar_pull_n - pull_n).abs() < 0.005 + 0.01 * pull_n.abs(), "DP at {slip}: {found:?}");
        assert!((found.torque_nm - torque_nm).abs() < 0.005 + 0.01 * torque_nm, "T at {slip}: {found:?}");
        assert!((1e3 * z - sinkage_mm).abs() < 0.05 + 0.01 * sinkage_mm, "z at {slip}: {z}");
    }
}
