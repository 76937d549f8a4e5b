//! The passes over the scenes by which both shipped networks are trained.

use std::time::Instant;

use indicatif::ProgressBar;

use super::back_propagation::mean_loss;
use super::curve::Curve;
use super::dataset::shuffle;
use super::example::Example;
use super::plan::{Passes, Plan, Purpose};
use super::soap::Soap;
use super::trainable::{Trainable, initial};

/// A new network after the passes, each over `count` examples in an order of its own, and its loss on `watched` after each.
/// `observe` makes of a pass's seed of noise what shows the example at a place: all of them at once would be a gigabyte.
pub fn train_by_epochs<N: Trainable, E: Fn(usize) -> Example<N::Input> + Sync>(
    plan: &Plan,
    passes: Passes,
    watched: &[Example<N::Input>],
    mut curve: Curve,
    progress: &ProgressBar,
    count: usize,
    observe: impl Fn(u64) -> E,
) -> (N, Curve) {
    let mut network: N = initial(plan.stream(Purpose::Weights));
    let begin = Instant::now();
    let mut soap = Soap::new::<N>();
    progress.set_length(passes.epochs as u64);
    for epoch in 0..passes.epochs {
        let mut order: Vec<u32> = (0..count as u32).collect();
        shuffle(&mut order, plan.stream(Purpose::Order) + epoch as u64);
        soap.pass(&mut network, &order, epoch, passes, observe(plan.stream(Purpose::TrainingNoise) + epoch as u64));
        curve.points.push((begin.elapsed().as_secs_f64(), mean_loss(&network.as_flown(), watched)));
        progress.set_message(format!("held-out loss {:.4}", curve.last()));
        progress.inc(1);
    }
    (network, curve)
}
