//! What the sensors see of a scene.

use kapvik_firmware::wheel_state::{Slope, SoilQuery, WheelState};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::scene::Scene;

/// One noisy observation of a scene.
pub fn observe(scene: &Scene, random: &mut ChaCha8Rng) -> SoilQuery {
    let noise = scene.noise;
    let mut normal = || -> f32 { StandardNormal.sample(random) };
    let seen = |state: &WheelState| {
        let sinkage_m = state.sinkage_m.filter(|_| scene.sinkage_seen);
        WheelState { sinkage_m, ..*state }.blurred(&noise, &mut normal)
    };
    let wheels = scene.read().iter().map(seen).collect();
    let slope = scene.slope.map(|slope| Slope { angle_rad: slope.angle_rad + slope.std_rad * normal(), ..slope });
    SoilQuery { wheel: scene.wheel.map(|metres| metres as f32), noise, slope, wheels }
}
