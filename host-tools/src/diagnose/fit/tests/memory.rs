//! Noise of which neighbouring rows share a part.

use super::toy::{Linear, Terms, blank, free, plain, random, red};
use crate::diagnose::fit::{CHANNELS, Reading, Start, fit};

const RUNS: usize = 8;
const ROWS: usize = 20;
const CAMPAIGNS: u64 = 200;

/// How many campaigns of one constant drawbar pull are found to remember, whose noise keeps a share from row to row.
fn remembering(kept: f64) -> usize {
    let terms = Terms {
        constant: [0.0; CHANNELS],
        parameters: vec![[1.0; CHANNELS]],
        slip: [0.0; CHANNELS],
        load: [0.0; CHANNELS],
    };
    let model = Linear { coordinates: vec![free("a")], terms: vec![terms; RUNS * ROWS] };
    let remembers = |seed: &u64| {
        let mut random = random(*seed);
        let mut noise = None;
        let rows: Vec<_> = (0..RUNS * ROWS)
            .map(|index| {
                let now = red(noise.filter(|_| index % ROWS > 0), kept, &mut random);
                noise = Some(now);
                let mut row = blank(index / ROWS);
                row.readings[Reading::DrawbarPull.index()] = Some(5.0 + now);
                row
            })
            .collect();
        fit(&model, &rows, &Start::at(vec![0.0], &rows), &plain()).expect("a fit").rows_per_reading() > 1.0
    };
    (0..CAMPAIGNS).filter(remembers).count()
}

/// Three standard errors of one channel: once in 740 campaigns by chance.
#[test]
fn independent_noise_remembers_nothing() {
    assert!(remembering(0.0) <= 3, "{}", remembering(0.0));
}

/// Of 152 pairs of neighbours a correlation of 0.5 is six standard errors.
#[test]
fn noise_that_remembers_half_is_noticed() {
    assert!(remembering(0.5) >= CAMPAIGNS as usize * 95 / 100, "{}", remembering(0.5));
}
