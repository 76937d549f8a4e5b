//! A wheel on its soil at some parameters: where it comes to rest under a load, and what its sensors then read.

use kapvik_firmware::dual::Dual;
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::effects::{Conditions, Effects, Grousers};
use kapvik_firmware::terramechanics::{ForceError, Memory, Quadrature, Readings, Soil, Wheel, WheelOnSoil, WheelTruth};

use super::fit::{CHANNELS, Derivatives, Latent, Prediction};

/// Derivatives that are carried along beside those by the free parameters: by slip, load and sinkage.
pub const SLOTS: usize = 3;

/// The sinkage has been found once a step changes its logarithm by less; what is left is corrected to first order.
const NEAR: f64 = 1e-3;
/// The step of ln z after which the next is likely to be near.
const SOON: f64 = 0.03;
/// Newton steps before the bracketed solve takes over.
const STEPS: usize = 12;
/// Sinkage over radius beyond which no load is looked for.
const BOTTOM: f64 = 0.9;
/// Sinkage over radius from which one is looked for at least.
const TOP: f64 = 1e-4;

/// A wheel, its soil and its effects in one scalar.
pub struct Site<S> {
    /// The wheel.
    pub wheel: Wheel<S>,
    /// Its grousers.
    pub grousers: Grousers<S>,
    /// The soil.
    pub soil: Soil<S>,
    /// What acts beside the seed's equations.
    pub effects: Effects<S>,
    /// Gravity.
    pub gravity_m_s2: S,
}

impl<S: Scalar> Site<S> {
    fn on_soil(&self) -> WheelOnSoil<'_, S> {
        WheelOnSoil {
            wheel: &self.wheel,
            grousers: &self.grousers,
            soil: &self.soil,
            effects: &self.effects,
            gravity_m_s2: self.gravity_m_s2,
            quadrature: Quadrature::FLIGHT,
        }
    }

    /// The same in another scalar.
    pub fn map<T>(&self, convert: impl Fn(S) -> T + Copy) -> Site<T> {
        Site {
            wheel: self.wheel.map(convert),
            grousers: self.grousers.map(convert),
            soil: self.soil.map(convert),
            effects: self.effects.map(convert),
            gravity_m_s2: convert(self.gravity_m_s2),
        }
    }
}

/// A site without derivatives but that by the sinkage, by which this is found.
pub struct Bare {
    plain: Site<f64>,
    by_sinkage: Site<Dual<f64, 1>>,
}

impl Bare {
    /// Of a site.
    pub fn new(plain: Site<f64>) -> Self {
        Self { by_sinkage: plain.map(Dual::constant), plain }
    }

    /// What is read of a row. The latent's sinkage becomes the guess that this was found from.
    pub fn values(
        &self,
        conditions: &Conditions<f64>,
        latent: &mut Latent,
        carried: &mut Carried<Dual<f64, 1>>,
    ) -> Option<[f64; CHANNELS]> {
        let (guess_m, found) = self.near(conditions, latent)?;
        let (slip, load_n) = (Dual::constant(latent.slip), Dual::constant(latent.load_n));
        let (truth, _) = settled(&found, slip, load_n, guess_m)?;
        latent.sinkage_m = guess_m;
        let readings = self.by_sinkage.on_soil().readings(&conditions.map(Dual::constant), &truth, &mut carried.memory);
        Some(in_order(&readings).map(|channel| channel.value))
    }

    /// A sinkage at which the soil nearly carries the load, and what it does there.
    fn near(&self, conditions: &Conditions<f64>, latent: &Latent) -> Option<(f64, WheelTruth<Dual<f64, 1>>)> {
        let look = |sinkage_m, _| {
            let found = self.forces(conditions, latent, sinkage_m)?;
            Ok((log_step(&found, latent, sinkage_m), found))
        };
        if let Some(near) = newton(self.start(latent), self.bottom_m(), false, look).ok()? {
            return Some(near);
        }
        let solved_m = self.solved(conditions, latent)?;
        Some((solved_m, self.forces(conditions, latent, solved_m).ok()?))
    }

    /// What the soil does at a sinkage, with its derivative by that.
    fn forces(
        &self,
        conditions: &Conditions<f64>,
        latent: &Latent,
        sinkage_m: f64,
    ) -> Result<WheelTruth<Dual<f64, 1>>, ForceError> {
        let (slip, load_n) = (Dual::constant(latent.slip), Dual::constant(latent.load_n));
        let sinkage = Dual::variable(sinkage_m, 0);
        self.by_sinkage.on_soil().forces(&conditions.map(Dual::constant), slip, load_n, sinkage)
    }

    /// The sinkage by the bracketed solve.
    fn solved(&self, conditions: &Conditions<f64>, latent: &Latent) -> Option<f64> {
        let found = self.plain.on_soil().at_load(conditions, latent.slip, latent.load_n);
        found.ok().map(|truth| truth.sinkage_m)
    }

    /// Where a sinkage is looked for first.
    fn start(&self, latent: &Latent) -> f64 {
        latent.sinkage_m.clamp(TOP * self.plain.wheel.radius_m, self.bottom_m())
    }

    fn bottom_m(&self) -> f64 {
        BOTTOM * self.plain.wheel.radius_m
    }
}

/// A site with the derivatives by `N` variables: by the first `count` parameters, and in the last slots by slip, load and sinkage.
pub struct Sloped<'a, const N: usize> {
    bare: Bare,
    by_all: &'a Site<Dual<f64, N>>,
    count: usize,
}

impl<'a, const N: usize> Sloped<'a, N> {
    const SLIP: usize = N - 3;
    const LOAD: usize = N - 2;
    const SINKAGE: usize = N - 1;

    /// Of a site, plainly and with the derivatives by its `count` parameters.
    pub fn new(plain: Site<f64>, by_all: &'a Site<Dual<f64, N>>, count: usize) -> Self {
        Self { bare: Bare::new(plain), by_all, count }
    }

    /// What is read of a row, and how that changes. The latent's sinkage becomes the one that was found.
    pub fn predict(
        &self,
        conditions: &Conditions<f64>,
        latent: &mut Latent,
        carried: &mut Carried<Dual<f64, N>>,
    ) -> Option<Prediction> {
        let slip = Dual::variable(latent.slip, Self::SLIP);
        let load_n = Dual::variable(latent.load_n, Self::LOAD);
        let conditions_here = conditions.map(Dual::constant);
        let on_soil = self.by_all.on_soil();
        let forces =
            |sinkage_m| on_soil.forces(&conditions_here, slip, load_n, Dual::variable(sinkage_m, Self::SINKAGE)).ok();
        // All derivatives where this is likely to be the place, for they are had with the values.
        let look = |sinkage_m, is_soon: bool| match is_soon.then(|| forces(sinkage_m)).flatten() {
            Some(found) => Ok((log_step(&found, latent, sinkage_m), Some(found))),
            None => Ok((log_step(&self.bare.forces(conditions, latent, sinkage_m)?, latent, sinkage_m), None)),
        };
        let start_m = self.bare.start(latent);
        let (guess_m, found) = match newton(start_m, self.bare.bottom_m(), carried.was_near, look).ok()? {
            Some(near) => near,
            None => (self.bare.solved(conditions, latent)?, None),
        };
        carried.was_near = guess_m == start_m;
        let found = found.or_else(|| forces(guess_m))?;
        let (truth, sinkage_m) = settled(&found, slip, load_n, guess_m)?;
        latent.sinkage_m = sinkage_m;
        let readings = on_soil.readings(&conditions_here, &truth, &mut carried.memory);
        forget_latents::<N>(&mut carried.memory);
        Some(self.prediction(&readings))
    }

    fn prediction(&self, readings: &Readings<Dual<f64, N>>) -> Prediction {
        let channels = in_order(readings);
        let by = |slot: usize| -> [f64; CHANNELS] { std::array::from_fn(|channel| channels[channel].slopes[slot]) };
        let slopes = Derivatives {
            by_parameter: (0..self.count).map(by).collect(),
            by_slip: by(Self::SLIP),
            by_load: by(Self::LOAD),
        };
        Prediction { value: channels.map(|channel| channel.value), slopes }
    }
}

/// What goes along a run from row to row.
pub struct Carried<S> {
    memory: Memory<S>,
    /// Whether the sinkage was found where it was first looked for: then it will be so again.
    was_near: bool,
}

impl<S> Carried<S> {
    /// At the start of a run.
    pub fn start() -> Self {
        Self { memory: Memory::start(), was_near: true }
    }
}

/// Newton's method on ln W over ln z. `look` is told a sinkage and whether it is likely to be near, and says how far ln z is off
/// there, if the soil tells, and what else was seen; none where the method leads nowhere.
fn newton<T>(
    start_m: f64,
    bottom_m: f64,
    is_near: bool,
    look: impl Fn(f64, bool) -> Result<(Option<f64>, T), ForceError>,
) -> Result<Option<(f64, T)>, ForceError> {
    let (mut sinkage_m, mut is_soon) = (start_m, is_near);
    for _ in 0..STEPS {
        let (step, seen) = look(sinkage_m, is_soon)?;
        let Some(step) = step else { break };
        if step.abs() < NEAR {
            return Ok(Some((sinkage_m, seen)));
        }
        sinkage_m = (sinkage_m * step.clamp(-1.0, 1.0).exp()).min(bottom_m);
        is_soon = step.abs() < SOON;
    }
    Ok(None)
}

/// The step of ln z towards the latent's load, by what the soil does at a sinkage; none where that says nothing of it. The last
/// slot is that of the sinkage.
fn log_step<const N: usize>(found: &WheelTruth<Dual<f64, N>>, latent: &Latent, sinkage_m: f64) -> Option<f64> {
    let carried = &found.load_n;
    let by_ln_sinkage = carried.slopes[N - 1] * sinkage_m;
    let is_told = carried.value > 0.0 && by_ln_sinkage > 0.0;
    is_told.then(|| (latent.load_n / carried.value).ln() * carried.value / by_ln_sinkage)
}

/// The true state at a slip and a load, with its derivatives by all but the sinkage, which has the last slot; and the sinkage. From
/// what the soil does at a near guess of it.
fn settled<const N: usize>(
    found: &WheelTruth<Dual<f64, N>>,
    slip: Dual<f64, N>,
    load_n: Dual<f64, N>,
    guess_m: f64,
) -> Option<(WheelTruth<Dual<f64, N>>, f64)> {
    let by_sinkage = found.load_n.slopes[N - 1];
    if by_sinkage.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
        return None;
    }
    // Where the load is met, a change of anything moves the sinkage so that it stays met; and the sinkage that met it nearly is
    // moved the rest.
    let mut carried = found.load_n;
    carried.slopes[N - 1] = 0.0;
    let missing = load_n - carried;
    let by_each: [f64; N] = std::array::from_fn(|slot| missing.slopes[slot] / by_sinkage);
    let step_m = missing.value / by_sinkage;
    let settle = |channel: Dual<f64, N>| {
        let by = channel.slopes[N - 1];
        let mut settled = channel;
        settled.value += by * step_m;
        settled.slopes[N - 1] = 0.0;
        for (slope, each) in settled.slopes.iter_mut().zip(&by_each) {
            *slope += by * each;
        }
        settled
    };
    let truth = WheelTruth {
        slip,
        load_n,
        drawbar_pull_n: settle(found.drawbar_pull_n),
        torque_nm: settle(found.torque_nm),
        sinkage_m: settle(Dual::variable(guess_m, N - 1)),
        side_force_n: settle(found.side_force_n),
    };
    Some((truth, guess_m + step_m))
}

/// The readings in the order of [`super::fit::Reading::ALL`].
fn in_order<S: Copy>(readings: &Readings<S>) -> [S; CHANNELS] {
    [
        readings.drawbar_pull_n,
        readings.torque_nm,
        readings.sinkage_m,
        readings.side_force_n,
        readings.slip,
        readings.load_n,
    ]
}

/// Slip and load of a row are not those of the next: what the memory carries on depends on the parameters alone.
fn forget_latents<const N: usize>(memory: &mut Memory<Dual<f64, N>>) {
    if let Some((sinkage_m, _)) = &mut memory.lagging {
        sinkage_m.slopes[N - 3..].fill(0.0);
    }
}
