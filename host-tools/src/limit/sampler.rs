//! Chains on a density: an adapted slice for all of them, then draws until they are enough.

use nalgebra::SVector;
use rand::RngExt;

use super::density::LogDensity;
use super::diagnostics::Diagnosis;
use super::slice::{Walker, step};
use super::student::Student;

/// How much sampling is enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Chains.
    pub chains: usize,
    /// Rounds in which the slice is fitted again; their draws are thrown away.
    pub rounds: usize,
    /// Steps of each chain in a round.
    pub round_steps: usize,
    /// Steps of each chain between two looks at the diagnostics.
    pub batch_steps: usize,
    /// Effective sample size that every coordinate must reach.
    pub effective_size: f64,
    /// Split-R̂ that every coordinate must come down to.
    pub split_r_hat: f64,
    /// Batches after which sampling ends even so.
    pub batches: usize,
}

/// Draws from a density.
#[derive(Debug, Clone)]
pub struct Draws<const D: usize> {
    /// The draws, chain by chain, all of equal length.
    pub chains: Vec<Vec<SVector<f64, D>>>,
    /// Whether every coordinate reached what was asked.
    pub converged: bool,
    /// Evaluations of the density.
    pub evaluations: usize,
}

impl<const D: usize> Draws<D> {
    /// The diagnosis of a quantity.
    pub fn diagnose(&self, quantity: impl Fn(&SVector<f64, D>) -> f64) -> Diagnosis {
        let chains: Vec<Vec<f64>> = self.chains.iter().map(|chain| chain.iter().map(&quantity).collect()).collect();
        Diagnosis::of(&chains)
    }

    /// All draws.
    pub fn iter(&self) -> impl Iterator<Item = &SVector<f64, D>> {
        self.chains.iter().flatten()
    }

    fn is_enough(&self, effort: &Effort) -> bool {
        (0..D).all(|axis| {
            let diagnosis = self.diagnose(|point| point[axis]);
            diagnosis.effective_size >= effort.effective_size && diagnosis.split_r_hat <= effort.split_r_hat
        })
    }
}

/// Draws from `density`, whose shape is roughly `first`; none where no point of that shape has any density. `latent` is what
/// the density can start from anywhere.
pub fn sample<const D: usize, T: LogDensity<D>>(
    density: &T,
    first: Student<D>,
    latent: &T::Latent,
    effort: &Effort,
    random: &mut impl RngExt,
) -> Option<Draws<D>> {
    let mut walkers = (0..effort.chains)
        .map(|_| walker(density, &first, latent, random))
        .collect::<Option<Vec<Walker<D, T::Latent>>>>()?;
    let mut student = first;
    let mut evaluations = 0;
    for _ in 0..effort.rounds {
        let mut late = Vec::new();
        for sweep in 0..effort.round_steps {
            evaluations += walkers.iter_mut().map(|walker| step(density, &student, walker, random)).sum::<usize>();
            if 2 * sweep >= effort.round_steps {
                late.extend(walkers.iter().map(|walker| walker.point));
            }
        }
        student = Student::fitted(&late).unwrap_or(student);
    }
    let mut draws = Draws { chains: vec![Vec::new(); effort.chains], converged: false, evaluations };
    for _ in 0..effort.batches {
        for (walker, chain) in walkers.iter_mut().zip(&mut draws.chains) {
            for _ in 0..effort.batch_steps {
                draws.evaluations += step(density, &student, walker, random);
                chain.push(T::kept(&walker.point, &walker.latent));
            }
        }
        draws.converged = draws.is_enough(effort);
        if draws.converged {
            break;
        }
    }
    Some(draws)
}

/// A walker somewhere in the first shape.
fn walker<const D: usize, T: LogDensity<D>>(
    density: &T,
    first: &Student<D>,
    latent: &T::Latent,
    random: &mut impl RngExt,
) -> Option<Walker<D, T::Latent>> {
    const TRIES: usize = 1000;
    (0..TRIES).find_map(|_| {
        let point = first.draw(random);
        let (ln_density, latent) = density.ln_density(&point, latent)?;
        Some(Walker { point, ln_density, latent })
    })
}
