//! What the sensors see of a scene.

use kapvik_firmware::wheel_state::{Slope, SoilQuery, WheelState};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::scene::Scene;

/// One noisy observation of a scene.
pub fn observe(scene: &Scene, random: &mut ChaCha8Rng) -> SoilQuery {
    let noise = scene.noise;
    let mut blur = |value: f32, std: f32| {
        let normal: f32 = StandardNormal.sample(random);
        value + std * normal
    };
    let wheels = scene
        .read()
        .iter()
        .map(|state| WheelState {
            drawbar_pull_n: blur(state.drawbar_pull_n, noise.drawbar_pull_n),
            load_n: blur(state.load_n, noise.load_n),
            torque_nm: blur(state.torque_nm, noise.torque_nm),
            slip: blur(state.slip, noise.slip),
            sinkage_m: state.sinkage_m.filter(|_| scene.sinkage_seen).map(|z| blur(z, noise.sinkage_m)),
        })
        .collect();
    let slope = scene.slope.map(|slope| Slope { angle_rad: blur(slope.angle_rad, slope.std_rad), ..slope });
    SoilQuery { wheel: scene.wheel.map(|metres| metres as f32), noise, slope, wheels }
}
