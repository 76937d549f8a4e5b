use kapvik_firmware::network::*;
use kapvik_host::train::{adam::*, example::*, observe::*, prior, scene::*, trainable::*};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::time::Instant;

fn examples(
    scenes: &[Scene],
    norm: &RoverNormalisation,
    mean: [f64; 3],
    std: [f64; 3],
    seed: u64,
) -> Vec<Example<RoverInput>> {
    scenes
        .par_iter()
        .enumerate()
        .map(|(i, s)| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            rng.set_stream(i as u64);
            let q = observe(s, &mut rng);
            let t = targets(s);
            Example {
                input: norm.apply(&rover_features(&q)),
                target: std::array::from_fn(|k| ((t[k] - mean[k]) / std[k]) as f32),
            }
        })
        .collect()
}
fn main() {
    let n: usize = std::env::args().nth(1).map_or(100_000, |s| s.parse().unwrap());
    let epochs: usize = std::env::args().nth(2).map_or(60, |s| s.parse().unwrap());
    let t0 = Instant::now();
    let train = scenes(Design::Training, n, 1);
    println!("scenes {:?}", t0.elapsed());
    let raw: Vec<_> = train
        .iter()
        .take(30000)
        .map(|s| {
            let mut r = ChaCha8Rng::seed_from_u64(0);
            rover_features(&observe(s, &mut r))
        })
        .collect();
    let norm = RoverNormalisation::new(&raw);
    let pr = |r: prior::Range| {
        if r.logarithmic {
            (0.5 * (r.low.ln() + r.high.ln()), (r.high / r.low).ln() / 12f64.sqrt())
        } else {
            (0.5 * (r.low + r.high), (r.high - r.low) / 12f64.sqrt())
        }
    };
    let p = [pr(prior::COHESION_PA), pr(prior::FRICTION_ANGLE_RAD), pr(prior::SHEAR_MODULUS_M)];
    let mean = p.map(|x| x.0);
    let std = p.map(|x| x.1);
    println!("{norm:?}");
    let mut net = RoverNetwork::ZERO;
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let fan = flatten(&RoverNetwork::fan_in());
    let mut it = fan.iter();
    net.for_each_mut(&mut |w| {
        let f = *it.next().unwrap();
        if f > 0.0 {
            *w = (rng.next_u32() as f32 / u32::MAX as f32 * 2.0 - 1.0) * (3.0 / f).sqrt();
        }
    });
    let tests: Vec<(String, Vec<Scene>)> = [(1u32, true), (1, false), (100, true), (100, false)]
        .iter()
        .map(|&(k, z)| (format!("{k} z={z}"), scenes(Design::Kapvik { instants: k, sinkage: z }, 6000, 999)))
        .collect();
    println!("tests {:?}", t0.elapsed());
    let mut adam = Adam::new(&net);
    let batch = 512;
    for e in 0..epochs {
        let mut ex = examples(&train, &norm, mean, std, 100 + e as u64);
        // shuffle
        let mut r = ChaCha8Rng::seed_from_u64(e as u64 + 5000);
        for i in (1..ex.len()).rev() {
            let j = (r.next_u32() as usize) % (i + 1);
            ex.swap(i, j);
        }
        let mut total = 0.0;
        let mut k = 0;
        for b in ex.chunks(batch) {
            let f = (e as f32 + k as f32 * batch as f32 / n as f32) / epochs as f32;
            let rate = 4e-3 * 0.5 * (1.0 + (std::f32::consts::PI * f).cos()) + 1e-5;
            total += adam.step(&mut net, b, rate);
            k += 1;
        }
        if e % 10 == 9 || e == epochs - 1 {
            println!("epoch {e} loss {:.4} {:?}", total / k as f32, t0.elapsed());
            for (name, sc) in &tests {
                let ex = examples(sc, &norm, mean, std, 77);
                let out: Vec<[f32; 6]> =
                    ex.par_iter().map(|x| *RoverNetwork::outputs(&Trainable::run(&net, &x.input))).collect();
                let m = ex.len() as f64;
                let rm = |k: usize| {
                    (out.iter().zip(&ex).map(|(o, x)| ((o[k] - x.target[k]) as f64).powi(2)).sum::<f64>() / m).sqrt()
                };
                let cov = |k: usize, f: f64| {
                    out.iter()
                        .zip(&ex)
                        .filter(|(o, x)| ((o[k] - x.target[k]) as f64).abs() < f * ((0.5 * o[3 + k]) as f64).exp())
                        .count() as f64
                        / m
                };
                let mut ke: Vec<f64> = out
                    .iter()
                    .zip(&ex)
                    .map(|(o, x)| ((((o[2] - x.target[2]) as f64 * std[2]).exp() - 1.0).abs()))
                    .collect();
                ke.sort_by(f64::total_cmp);
                println!(
                    "  {name}: phi rmse {:.3} deg, lnK rmse {:.4}, K med {:.3}, R2 c {:.3} phi {:.3} K {:.3}  cov68 {:.3} {:.3} {:.3} cov95 {:.3} {:.3} {:.3}",
                    rm(1) * std[1].to_degrees(),
                    rm(2) * std[2],
                    ke[ke.len() / 2],
                    1.0 - rm(0).powi(2),
                    1.0 - rm(1).powi(2),
                    1.0 - rm(2).powi(2),
                    cov(0, 1.0),
                    cov(1, 1.0),
                    cov(2, 1.0),
                    cov(0, 1.96),
                    cov(1, 1.96),
                    cov(2, 1.96)
                );
            }
        }
    }
}
