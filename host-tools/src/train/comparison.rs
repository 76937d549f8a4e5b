//! Which trainer, and which fifth input: one table each, on the same scenes, the same noise and the same network.

use std::time::Instant;

use indicatif::ProgressBar;
use kapvik_firmware::network::PosteriorScale;

use super::back_propagation::{Adam, Momentum, mean_loss};
use super::cosine_fall::cosine_fall;
use super::curve::Curve;
use super::dataset::{prior_scale, shuffle, wheel_examples, wheel_inputs};
use super::example::{Example, WheelInput, normalisation};
use super::extended_kalman::ExtendedKalman;
use super::fifth_input::Candidate;
use super::levenberg_marquardt::LevenbergMarquardt;
use super::plan::{Plan, Purpose};
use super::scene::Scene;
use super::score::{Score, score_network};
use super::soap::Soap;
use super::trainable::initial;
use super::wheel_weights::WheelWeights;

/// A trainer of the comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trainer {
    /// Back-propagation with momentum, as in the seed.
    BackPropagation,
    /// Back-propagation with Adam's step sizes.
    Adam,
    /// Adam in the eigenbasis of Shampoo's preconditioner.
    Soap,
    /// Levenberg–Marquardt.
    LevenbergMarquardt,
    /// Extended Kalman filter over the weights.
    ExtendedKalman,
}

impl Trainer {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 5] =
        [Self::BackPropagation, Self::Adam, Self::Soap, Self::LevenbergMarquardt, Self::ExtendedKalman];

    /// Its name in the table.
    pub fn name(self) -> &'static str {
        match self {
            Self::BackPropagation => "back-propagation, momentum",
            Self::Adam => "back-propagation, Adam",
            Self::Soap => "back-propagation, SOAP",
            Self::LevenbergMarquardt => "Levenberg–Marquardt",
            Self::ExtendedKalman => "extended Kalman filter",
        }
    }
}

/// A row of a comparison.
#[derive(Debug, Clone)]
pub struct Row {
    /// What was compared.
    pub name: &'static str,
    /// Held-out loss over time; the last one counts.
    pub curve: Curve,
    /// Examples presented.
    pub presentations: usize,
    /// Scores on the held-out cases.
    pub score: Score,
}

/// Examples of one fifth input, to learn from and to watch.
struct Sets {
    training: Vec<Example<WheelInput>>,
    watched: Vec<Example<WheelInput>>,
    scale: PosteriorScale,
    weights: u64,
    order: u64,
}

impl Sets {
    fn new(plan: &Plan, scenes: &[Scene], held_out: &[Scene], fifth: Candidate) -> Self {
        let raw = wheel_inputs(scenes, fifth, plan.stream(Purpose::ComparisonNoise));
        let normal = normalisation(raw.iter());
        let mut training = wheel_examples(scenes, &raw, &normal);
        let order = plan.stream(Purpose::Order);
        shuffle(&mut training, order);
        let raw = wheel_inputs(held_out, fifth, plan.stream(Purpose::HeldOutNoise));
        let watched = wheel_examples(held_out, &raw, &normal);
        Self { training, watched, scale: prior_scale(), weights: plan.stream(Purpose::Weights), order }
    }
}

/// All trainers with sinkage as the fifth input, as the seed starts.
pub fn compare_trainers(plan: &Plan, scenes: &[Scene], held_out: &[Scene], progress: &ProgressBar) -> Vec<Row> {
    let sets = Sets::new(plan, scenes, held_out, Candidate::Sinkage);
    progress.set_length(Trainer::ALL.len() as u64);
    let rows = Trainer::ALL.into_iter().map(|trainer| {
        progress.set_message(trainer.name());
        let row = run(plan, &sets, trainer, trainer.name());
        progress.inc(1);
        row
    });
    rows.collect()
}

/// All fifth inputs by the same trainer.
pub fn compare_fifth_inputs(plan: &Plan, scenes: &[Scene], held_out: &[Scene], progress: &ProgressBar) -> Vec<Row> {
    progress.set_length(Candidate::ALL.len() as u64);
    let rows = Candidate::ALL.into_iter().map(|fifth| {
        progress.set_message(fifth.name());
        let row = run(plan, &Sets::new(plan, scenes, held_out, fifth), Trainer::Adam, fifth.name());
        progress.inc(1);
        row
    });
    rows.collect()
}

fn run(plan: &Plan, sets: &Sets, trainer: Trainer, name: &'static str) -> Row {
    let mut network: WheelWeights = initial(sets.weights);
    let mut course = Course { sets, curve: Curve::new(name), begin: Instant::now(), presentations: 0 };
    match trainer {
        Trainer::BackPropagation => {
            let mut method = Momentum::new(&network);
            by_batches(plan, &mut course, &mut network, 1e-2, |net, batch, rate| method.step(net, batch, rate));
        }
        Trainer::Adam => {
            let mut method = Adam::new(&network);
            by_batches(plan, &mut course, &mut network, 5e-3, |net, batch, rate| method.step(net, batch, rate));
        }
        Trainer::Soap => {
            let mut method = Soap::new::<WheelWeights>();
            by_batches(plan, &mut course, &mut network, 1e-2, |net, batch, rate| method.step(net, batch, rate));
        }
        Trainer::LevenbergMarquardt => {
            let mut method = LevenbergMarquardt::default();
            for _ in 0..plan.comparison_steps {
                if !method.step(&mut network, &sets.training) {
                    break;
                }
                course.watch(&network, sets.training.len());
            }
        }
        Trainer::ExtendedKalman => {
            let mut method = ExtendedKalman::new(&network);
            for part in sets.training.chunks(sets.training.len().div_ceil(20).max(1)) {
                part.iter().for_each(|example| method.step(&mut network, example));
                course.watch(&network, part.len());
            }
        }
    }
    let score = score_network(&network, &sets.watched, &sets.scale);
    Row { name, curve: course.curve, presentations: course.presentations, score }
}

/// What happens while a network is trained.
struct Course<'a> {
    sets: &'a Sets,
    curve: Curve,
    begin: Instant,
    presentations: usize,
}

impl Course<'_> {
    fn watch(&mut self, network: &WheelWeights, presented: usize) {
        self.presentations += presented;
        let loss = mean_loss(network, &self.sets.watched);
        self.curve.points.push((self.begin.elapsed().as_secs_f64(), loss));
    }
}

fn by_batches(
    plan: &Plan,
    course: &mut Course<'_>,
    network: &mut WheelWeights,
    greatest_rate: f32,
    mut step: impl FnMut(&mut WheelWeights, &[Example<WheelInput>], f32) -> f32,
) {
    let mut examples = course.sets.training.clone();
    let epochs = 10 * plan.comparison_steps;
    for epoch in 0..epochs {
        shuffle(&mut examples, course.sets.order + 1 + epoch as u64);
        let share = epoch as f32 / epochs as f32;
        let rate = greatest_rate * cosine_fall(share);
        examples.chunks(128).for_each(|batch| _ = step(network, batch, rate));
        course.watch(network, examples.len());
    }
}
