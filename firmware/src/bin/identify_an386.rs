//! What the methods of the literature cost on the target: six wheels at one instant. Run under `-icount shift=0`; an image of
//! its own, since the flight image holds none of them.
#![no_std]
#![no_main]

use kapvik_board_an386::{bench::Bench, entry, exit};
use kapvik_firmware::fingerprint::SOILS;
use kapvik_firmware::identification::Assumed;
use kapvik_firmware::identification::ding::{DingBounds, ding};
use kapvik_firmware::identification::hutangkabodee::hutangkabodee;
use kapvik_firmware::identification::iagnemma::{IagnemmaAssumptions, Recursive, iagnemma};
use kapvik_firmware::identification::ray::ray;
use kapvik_firmware::identification::trial::{WHEEL, six_wheels, with_error};
use kapvik_firmware::terramechanics::Soil;

/// Soils that the multiple models choose from: the cost grows in proportion.
const BANK: usize = 16;

#[entry]
fn main() -> ! {
    let bench = Bench::start();
    let [sand, ..] = SOILS;
    let Some(seen) = six_wheels(&sand) else { exit(1) };
    let bounds = DingBounds::usual();
    let modulus = Assumed { value: sand.shear_modulus_m, std: 0.003 };
    let assumed = IagnemmaAssumptions { shear_modulus_m: modulus, cohesion_pa: None };
    let bank: [Soil<f32>; BANK] = core::array::from_fn(|place| {
        let share = place as f32 / BANK as f32;
        Soil { friction_angle_rad: 0.35 + 0.4 * share, shear_modulus_m: 0.02 - 0.01 * share, ..sand }
    });
    // A line each: name, by how many standard deviations the first wheel's torque is off, the method.
    bench.kernel("iagnemma", -1.0, 1.0, |off| iagnemma(&WHEEL, &with_error(&seen, off), &assumed).is_ok());
    if let Ok(mut line) = Recursive::new(&assumed, 0.98) {
        let mut turn = seen.iter().cycle();
        bench.kernel("iagnemma_update", -1.0, 1.0, |_| {
            let taken = turn.next().is_some_and(|one| line.add(&WHEEL, one).is_ok());
            (taken, line.identified().is_ok())
        });
    }
    bench.kernel("ding", -1.0, 1.0, |off| ding(&WHEEL, &with_error(&seen, off), &bounds).is_ok());
    bench.kernel("hutangkabodee", -1.0, 1.0, |off| hutangkabodee(&WHEEL, &with_error(&seen, off), &sand).is_ok());
    bench.kernel("ray_16_soils", -1.0, 1.0, |off| ray(&WHEEL, &with_error(&seen, off), &bank).is_ok());
    exit(0)
}
