//! The filter beside others: instructions and stack of a step, and what becomes of each after the same faults.
//! Prints the lines of the measuring image, and of its own:
//!
//! ```text
//! object NAME_SIZE BYTES
//! survival NAME FAULT GOOD STEPS TOLD PEAK END
//! ```
#![no_std]
#![no_main]

mod contender;
mod faults;
mod kfilter_crate;
mod minikalman_crate;
mod multicalc_crate;
mod ours;

use kapvik_board_an386::{bench::Bench, entry, exit};
use kapvik_firmware::filter::trial::{Scales, Trial};
use semihosting::println;

use contender::{Answer, Contender};
use kfilter_crate::Kfilter;
use multicalc_crate::Multicalc;
use ours::Ours;

#[entry]
fn main() -> ! {
    let bench = Bench::start();
    compare(
        &bench,
        "kapvik",
        started::<Ours<6, false, true>, 6, 6>,
        started::<Ours<12, false, true>, 12, 18>,
        started::<Ours<3, true, true>, 3, 2>,
    );
    compare(
        &bench,
        "kapvik-gate-open",
        started::<Ours<6, false, false>, 6, 6>,
        started::<Ours<12, false, false>, 12, 18>,
        started::<Ours<3, true, false>, 3, 2>,
    );
    compare(
        &bench,
        "kfilter",
        started::<Kfilter<6, 6, 13, false>, 6, 6>,
        started::<Kfilter<12, 18, 25, false>, 12, 18>,
        started::<Kfilter<3, 2, 7, true>, 3, 2>,
    );
    compare(
        &bench,
        "multicalc",
        started::<Multicalc<6, 6, false>, 6, 6>,
        started::<Multicalc<12, 18, false>, 12, 18>,
        started::<Multicalc<3, 2, true>, 3, 2>,
    );
    compare(
        &bench,
        "minikalman",
        minikalman_crate::six_by_six,
        minikalman_crate::twelve_by_eighteen,
        minikalman_crate::drifting,
    );
    exit(0)
}

/// Cost and survival of a filter, given how it starts in each of three sizes: the small one drifts.
fn compare<S, L, D>(
    bench: &Bench,
    name: &str,
    six: impl Fn(&Scales) -> S,
    twelve: impl Fn(&Scales) -> L,
    three: impl Fn(&Scales) -> D,
) where
    S: FnMut(Option<&[f32; 6]>) -> Answer<6>,
    L: FnMut(Option<&[f32; 18]>) -> Answer<12>,
    D: FnMut(Option<&[f32; 2]>) -> Answer<3>,
{
    cost(bench, name, "6_6", &six);
    cost(bench, name, "12_18", &twelve);
    faults::all(name, &six);
    faults::stiff(name, &six);
    faults::stiff(name, &twelve);
    faults::drift(name, &three);
}

/// The step of a filter of these scales.
fn started<C: Contender<N, M>, const N: usize, const M: usize>(
    scales: &Scales,
) -> impl FnMut(Option<&[f32; M]>) -> Answer<N> + use<C, N, M> {
    let mut contender = C::start(scales);
    move |measured| contender.step(measured)
}

/// What a step of a filter costs that runs on, measurement after measurement.
fn cost<const N: usize, const M: usize, C: FnMut(Option<&[f32; M]>) -> Answer<N>>(
    bench: &Bench,
    name: &str,
    size: &str,
    start: impl Fn(&Scales) -> C,
) {
    const STEPS: usize = 64;
    let scales = Scales::NOMINAL;
    let mut trial = Trial::<N, M>::new(1, scales);
    let measured: [[f32; M]; STEPS] = [(); STEPS].map(|()| trial.measure());
    let mut step = start(&scales);
    println!("object {name}_{size} {}", size_of_val(&step));
    bench.kernel(format_args!("{name}_{size}"), 0.0, (STEPS - 1) as f32, |place| step(measured.get(place as usize)));
}
