//! Draws of the prior: a rover's wheels on a soil, as they truly are.

use kapvik_firmware::terramechanics::effects::{Effects, Grousers};
use kapvik_firmware::terramechanics::{Memory, Quadrature, Soil, Wheel, WheelOnSoil, WheelTruth};
use kapvik_firmware::wheel_state::{Slope, WHEELS, WheelNoise, WheelState};
use rayon::prelude::*;

use crate::error::HostError;

use super::drive::Drive;
use super::patches::Patches;
use super::world::World;
use crate::prior::{self, RelativeNoise};

/// Wheels of one instant, true to the wheel–soil equations and the effects of a world, and how noisily they will be seen.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The geometry that the wheels share.
    pub wheel: Wheel<f64>,
    /// The soil under all of them; on patchy ground the mean of what is under each.
    pub soil: Soil<f64>,
    /// True states; the sinkage is always there.
    pub wheels: heapless::Vec<WheelState, WHEELS>,
    /// What the sensors read of them but for their noise, where that is not the truth.
    pub misread: Option<heapless::Vec<WheelState, WHEELS>>,
    /// Standard deviations of what is seen.
    pub noise: WheelNoise,
    /// Whether the sinkage is seen.
    pub sinkage_seen: bool,
    /// The true slope and how well it is known, where it is seen.
    pub slope: Option<Slope>,
}

impl Scene {
    /// Lets the slope be seen. A rover that drives at steady speed on plane ground pulls itself up it, no more and no
    /// less: its tangent is the total drawbar pull over the total load.
    pub fn with_slope_seen(mut self, std_rad: f64) -> Self {
        self.slope = Some(Slope { angle_rad: slope_rad(&self.wheels), std_rad: std_rad as f32 });
        self
    }

    /// The same wheels as another pass of training sees them: in a share of [`prior::PRECISE_SHARE`] by Kapvik's sensors over
    /// many instants, else as noisily as here; the sinkage seen or not by chance. `share` gives numbers 0 … 1.
    pub fn seen_anew(&self, mut share: impl FnMut() -> f64) -> Self {
        let mut scene = self.clone();
        scene.sinkage_seen = share() < SINKAGE_SEEN_SHARE;
        if share() < prior::PRECISE_SHARE {
            let load_n =
                self.wheels.iter().map(|state| f64::from(state.load_n)).sum::<f64>() / self.wheels.len() as f64;
            scene.noise = noise(&self.wheel, load_n, [prior::PRECISE_AVERAGING.at(share()); 5]);
        }
        scene
    }

    /// What the sensors read but for their noise.
    pub fn read(&self) -> &[WheelState] {
        self.misread.as_ref().unwrap_or(&self.wheels)
    }
}

/// Share of the scenes for training in which the sinkage is seen.
const SINKAGE_SEEN_SHARE: f64 = 0.5;

/// The slope, rad, that wheels pull their rover up at steady speed.
fn slope_rad(wheels: &[WheelState]) -> f32 {
    let pull: f32 = wheels.iter().map(|state| state.drawbar_pull_n).sum();
    let load: f32 = wheels.iter().map(|state| state.load_n).sum();
    libm::atan2f(pull, load)
}

/// What a set of scenes is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Design {
    /// Mostly Kapvik, some other wheels; mostly six wheels at spread slips, some fewer or alike; all noise levels.
    Training,
    /// Kapvik, six wheels at slips from small to great, loads alike or not; all noise levels.
    Manoeuvre,
    /// Kapvik, six wheels at slips 0.05–0.60, loads within ±8 % of 65.4 N.
    Kapvik {
        /// Independent instants that are averaged.
        instants: u32,
        /// Whether the sinkage is seen.
        sinkage: bool,
    },
}

/// A point of the unit cube, coordinate by coordinate, low in discrepancy (Sobol', Owen-scrambled).
struct Shares {
    index: u32,
    seed: u32,
    dimension: u32,
}

impl Shares {
    /// Points in one Sobol' sequence; later ones start another, scrambled anew.
    const BLOCK: u32 = 1 << 16;
    /// Where the coordinates of effects begin: behind those of soil, wheels and noise, of which there are fewer.
    const OF_EFFECTS: u32 = 64;
    /// Where the coordinates of patches begin: behind those of effects.
    const OF_PATCHES: u32 = 160;

    fn new(index: u32, seed: u32) -> Self {
        let block = index / Self::BLOCK;
        Self { index: index % Self::BLOCK, seed: seed.wrapping_add(block.wrapping_mul(0x9e37_79b9)), dimension: 0 }
    }

    /// The same point, from a coordinate on.
    fn starting_at(&self, dimension: u32) -> Self {
        Self { dimension, ..*self }
    }

    fn next(&mut self) -> f64 {
        let share = sobol_burley::sample(self.index, self.dimension, self.seed);
        self.dimension += 1;
        f64::from(share)
    }
}

/// `count` scenes of the seed's world. The same seed gives the same scenes; draws that the soil cannot carry are left out
/// and replaced.
pub fn scenes(design: Design, count: usize, seed: u32) -> Vec<Scene> {
    gather(&World::seed(), design, count, seed, u32::MAX)
}

/// [`scenes`] of a world with effects.
///
/// # Errors
/// Where the effects leave next to no scene in which the soil carries the wheels.
pub fn scenes_in(world: &World, design: Design, count: usize, seed: u32) -> Result<Vec<Scene>, HostError> {
    const DRAWS_A_SCENE: u32 = 50;
    let draws = (count as u32).saturating_mul(DRAWS_A_SCENE).saturating_add(1000);
    let scenes = gather(world, design, count, seed, draws);
    if scenes.len() == count {
        return Ok(scenes);
    }
    Err(HostError::Failed(format!(
        "with the declared effects ({world}) the soil carries the wheels in {} of {draws} scenes: \
         expected effects of a size that a rover can drive with",
        scenes.len()
    )))
}

fn gather(world: &World, design: Design, count: usize, seed: u32, draws: u32) -> Vec<Scene> {
    let mut scenes = Vec::with_capacity(count);
    let mut next = 0_u32;
    while scenes.len() < count && next < draws {
        let wanted = (count - scenes.len()) as u32 + 16;
        scenes.par_extend((next..next + wanted).into_par_iter().filter_map(|index| draw(world, design, index, seed)));
        next += wanted;
    }
    scenes.truncate(count);
    scenes
}

fn draw(world: &World, design: Design, index: u32, seed: u32) -> Option<Scene> {
    let mut shares = Shares::new(index, seed);
    let (mut of_effects, mut of_patches) =
        (shares.starting_at(Shares::OF_EFFECTS), shares.starting_at(Shares::OF_PATCHES));
    let middle = [(); prior::SOIL_PARAMETERS].map(|()| shares.next());
    let ground = Ground {
        patches: Patches::draw(middle, world.patchy_share(), || of_patches.next()),
        drive: Drive::draw(|| of_effects.next()),
        effects: world.draw(|| of_effects.next()),
        faultless: world.is_without_effects(),
    };
    match design {
        Design::Training => draw_training(&mut shares, &ground, false),
        Design::Manoeuvre => draw_training(&mut shares, &ground, true),
        Design::Kapvik { instants, sinkage } => draw_kapvik(&mut shares, &ground, instants, sinkage),
    }
}

fn draw_training(shares: &mut Shares, ground: &Ground, is_manoeuvre: bool) -> Option<Scene> {
    let kapvik = shares.next() < prior::KAPVIK_SHARE || is_manoeuvre;
    let kapvik_loads_n = if is_manoeuvre { prior::MANOEUVRE_LOADS_N } else { prior::KAPVIK_LOADS_N };
    let (radius, width, load) = (shares.next(), shares.next(), shares.next());
    let radius_m = prior::RADIUS_M.at(radius);
    let other = Wheel { radius_m, width_m: radius_m * prior::WIDTH_RATIO.at(width) };
    let (wheel, grousers, load_n) = if kapvik {
        (prior::KAPVIK_WHEEL, prior::KAPVIK_GROUSERS, kapvik_loads_n.at(load))
    } else {
        let load_n = prior::PRESSURE_PA.at(load) * other.radius_m * other.width_m;
        (other, ground.drive.other_grousers(other.radius_m), load_n)
    };
    let load_spread = if is_manoeuvre { prior::MANOEUVRE_LOAD_SPREAD } else { prior::LOAD_SPREAD };
    let spread = load_spread.at(shares.next());
    let slips = if is_manoeuvre { Slips::of_manoeuvre(shares) } else { Slips::draw(shares) };
    let noise = draw_noise(shares, &wheel, load_n);
    let (fewer, count) = (shares.next(), shares.next());
    let count =
        if fewer < prior::WHOLE_ROVER_SHARE || is_manoeuvre { WHEELS } else { 1 + (count * WHEELS as f64) as usize };
    let sinkage_seen = shares.next() < SINKAGE_SEEN_SHARE;
    let (slope_seen, slope_std) = (shares.next() < 0.7, prior::SLOPE_STD_RAD.at(shares.next()));
    let mut asked = heapless::Vec::new();
    for place in 0..count {
        let slip = slips.of(place, count, shares.next());
        let load = load_n * (1.0 + spread * (2.0 * shares.next() - 1.0));
        asked.push((slip, load)).ok()?;
    }
    let (wheels, misread) = ground.states(&wheel, &grousers, &asked)?;
    let scene = Scene { wheel, soil: ground.patches.mean(count), wheels, misread, noise, sinkage_seen, slope: None };
    // Only all the wheels of a rover together tell the slope.
    Some(if slope_seen && count == WHEELS { scene.with_slope_seen(slope_std) } else { scene })
}

/// How slip differs among the wheels of an instant.
struct Slips {
    ends: (f64, f64),
    /// One wheel in each of as many equal steps as there are wheels, instead of anywhere between the ends.
    stepped: bool,
}

impl Slips {
    /// Most scenes have wheels driven at deliberately different rim speeds.
    fn draw(shares: &mut Shares) -> Self {
        let (stepped, one, two) = (shares.next() < prior::SPREAD_SHARE, shares.next(), shares.next());
        let (low, high) =
            if stepped { (prior::SPREAD_SLIP_LOW, prior::SPREAD_SLIP_HIGH) } else { (prior::SLIP, prior::SLIP) };
        Self { ends: (low.at(one), high.at(two)), stepped }
    }

    fn of_manoeuvre(shares: &mut Shares) -> Self {
        let ends = (prior::MANOEUVRE_SLIP_LOW.at(shares.next()), prior::MANOEUVRE_SLIP_HIGH.at(shares.next()));
        Self { ends, stepped: true }
    }

    fn of(&self, place: usize, count: usize, share: f64) -> f64 {
        let share = if self.stepped { (place as f64 + share) / count as f64 } else { share };
        self.ends.0 + (self.ends.1 - self.ends.0) * share
    }
}

fn draw_kapvik(shares: &mut Shares, ground: &Ground, instants: u32, sinkage: bool) -> Option<Scene> {
    let wheel = prior::KAPVIK_WHEEL;
    let mut asked = heapless::Vec::new();
    for place in 0..WHEELS {
        let slip = 0.05 + 0.55 * place as f64 / (WHEELS - 1) as f64;
        let load = prior::KAPVIK_LOAD_N * (1.0 + prior::KAPVIK_LOAD_SPREAD * (2.0 * shares.next() - 1.0));
        asked.push((slip, load)).ok()?;
    }
    let (wheels, misread) = ground.states(&wheel, &prior::KAPVIK_GROUSERS, &asked)?;
    let noise = noise(&wheel, prior::KAPVIK_LOAD_N, [1.0 / libm::sqrt(f64::from(instants)); 5]);
    Some(Scene { wheel, soil: ground.patches.mean(WHEELS), wheels, misread, noise, sinkage_seen: sinkage, slope: None })
}

/// The wheels of a scene.
type States = heapless::Vec<WheelState, WHEELS>;

/// What the wheels of a scene drive on, and how.
struct Ground {
    patches: Patches,
    drive: Drive,
    effects: Effects<f64>,
    /// There is no effect that could make a sensor misread.
    faultless: bool,
}

impl Ground {
    /// The true states of wheels at (slip, load), and what the sensors read of them but for their noise; none where a
    /// wheel would be stuck, or is read as one without load.
    fn states(
        &self,
        wheel: &Wheel<f64>,
        grousers: &Grousers<f64>,
        asked: &heapless::Vec<(f64, f64), WHEELS>,
    ) -> Option<(States, Option<States>)> {
        let soils: [Soil<f64>; WHEELS] = std::array::from_fn(|place| self.patches.under(place));
        let on_soil = |place: usize| WheelOnSoil {
            wheel,
            grousers,
            soil: &soils[place],
            effects: &self.effects,
            gravity_m_s2: prior::GRAVITY_M_S2,
            quadrature: Quadrature::for_scalar::<f64>(),
        };
        // The pitch follows from the pulls, and none of these from the pitch.
        let truth = |(place, (slip, load_n)): (usize, &(f64, f64))| {
            let truth = on_soil(place).at_load(&self.drive.at(place, 0.0), *slip, *load_n).ok()?;
            (truth.sinkage_m <= prior::DEEPEST * wheel.radius_m).then_some(WheelTruth { load_n: *load_n, ..truth })
        };
        let truths: heapless::Vec<_, WHEELS> = asked.iter().enumerate().map(truth).collect::<Option<_>>()?;
        let wheels: States = truths.iter().map(|truth| WheelState::from(*truth).map(|number| number as f32)).collect();
        if self.faultless {
            return Some((wheels, None));
        }
        let pitch_rad = f64::from(slope_rad(&wheels));
        let read = |(place, truth): (usize, &WheelTruth<f64>)| {
            let readings = on_soil(place).readings(&self.drive.at(place, pitch_rad), truth, &mut Memory::start());
            (readings.load_n > 0.0).then_some(WheelState {
                drawbar_pull_n: readings.drawbar_pull_n as f32,
                load_n: readings.load_n as f32,
                torque_nm: readings.torque_nm as f32,
                slip: readings.slip as f32,
                sinkage_m: Some(readings.sinkage_m as f32),
            })
        };
        Some((wheels, Some(truths.iter().enumerate().map(read).collect::<Option<_>>()?)))
    }
}

/// Half of the scenes have Kapvik's sensors, averaged over more or fewer instants; half have others.
fn draw_noise(shares: &mut Shares, wheel: &Wheel<f64>, load_n: f64) -> WheelNoise {
    let averaging = prior::AVERAGING.at(shares.next());
    let kapvik = shares.next() < 0.5;
    let factors = [(); 5].map(|()| {
        let other = prior::OTHER_SENSOR.at(shares.next());
        averaging * if kapvik { 1.0 } else { other }
    });
    noise(wheel, load_n, factors)
}

fn noise(wheel: &Wheel<f64>, load_n: f64, factors: [f64; 5]) -> WheelNoise {
    let instant = prior::INSTANT_NOISE;
    let [drawbar_pull, load, torque, slip, sinkage] = factors;
    let relative = RelativeNoise {
        drawbar_pull: drawbar_pull * instant.drawbar_pull,
        load: load * instant.load,
        torque: torque * instant.torque,
        slip: slip * instant.slip,
        sinkage: sinkage * instant.sinkage,
    };
    relative.on(load_n, wheel.radius_m).map(|std| std as f32)
}
