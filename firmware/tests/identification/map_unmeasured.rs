//! Maximum a posteriori where drawbar pull or torque was not measured.

use kapvik_firmware::identification::map::identify;
use kapvik_firmware::identification::{Observation, Refusal, SoilPrior};
use kapvik_firmware::terramechanics::effects::Effects;

use super::map_design::{Design, TABLE_1, WHEEL, assert_near, lose_pull, lose_torque};

/// What was not measured has no weight, whatever number stands in its place: as if it had been measured a million times worse. Without
/// both nothing tells the soil's strength.
#[test]
fn what_was_not_measured_says_nothing() {
    let seen = Design::MEAN_OF_100.observe(&TABLE_1, &Effects::none(), 6, 1.0).expect("carried");
    let with = |change: &dyn Fn(&mut Observation<f64>)| {
        let mut seen = seen.clone();
        seen.iter_mut().for_each(change);
        identify(&WHEEL, &seen, &SoilPrior::usual())
    };
    let all = with(&|_| ()).expect("an estimate");
    let hardly = |lose: fn(&mut Observation<f64>)| {
        let mut without = seen[0];
        lose(&mut without);
        with(&move |seen| {
            for (std, lost) in [
                (&mut seen.noise.drawbar_pull_n, without.noise.drawbar_pull_n),
                (&mut seen.noise.torque_nm, without.noise.torque_nm),
            ] {
                *std *= if lost.is_finite() { 1.0 } else { 1e6 };
            }
        })
    };
    for lose in [lose_torque as fn(&mut Observation<f64>), lose_pull] {
        let (lost, hardly) = (with(&lose).expect("an estimate"), hardly(lose).expect("an estimate"));
        assert_near(lost.friction_angle_rad.mean, hardly.friction_angle_rad.mean, 1e-6);
        assert_near(lost.ln_shear_modulus.mean, hardly.ln_shear_modulus.mean, 1e-6);
        assert_eq!(all.residuals - lost.residuals, 6);
        assert_eq!(lost.degrees_of_freedom, 12);
        assert!(lost.friction_angle_rad.std > 1.2 * all.friction_angle_rad.std, "{lost:?}");
    }
    let neither = with(&|seen| {
        lose_pull(seen);
        lose_torque(seen);
    });
    assert_eq!(neither.err(), Some(Refusal::OutOfRange));
}
