//! Groups of runs left out in turn, and within that two of them at once.
//!
//! To choose among candidates without a group of runs takes what each says of the other groups by fits without those as well. Such
//! a fit without two groups serves both: it predicts the one for the choice made without the other.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::bench::Bench;
use super::field::Field;
use super::fit::HeldOutRun;
use super::trial::Trial;

/// What is done without a group of runs.
pub struct Fold<'a> {
    /// The place of the group among all.
    pub group: usize,
    /// All runs but those.
    pub bench: Bench<'a>,
    /// The declared model, fitted to them.
    pub before: Trial<'a>,
    /// The same with the effects that were chosen by them.
    pub after: Trial<'a>,
}

/// Adds to each fold's model the candidate of a shortlist that its own runs choose.
pub fn choose<'a>(folds: &mut [Fold<'a>], groups: &[Vec<usize>], shortlist: &[Trial<'a>]) {
    let field = |fold: &Fold<'a>| Field::of_shortlist(&fold.bench, &fold.after, shortlist);
    let fields: Vec<Field<'a>> = folds.par_iter().map(field).collect();
    let predicted = without_two_groups(folds, groups, &fields);
    for ((fold, field), predicted) in folds.iter_mut().zip(&fields).zip(&predicted) {
        if let Some(best) = field.best(predicted) {
            fold.after = best.clone();
        }
    }
}

/// A fit without two groups: its effects, and the groups in order.
type Key = (Vec<(&'static str, &'static str)>, [usize; 2]);

/// What it takes to do that fit, and who asks for it.
struct Task<'t, 'a> {
    bench: &'t Bench<'a>,
    /// Where it begins: the fit without one of the groups.
    start: &'t Trial<'a>,
    /// For the fold without each of its groups, which of the field's models asks what it says of the other group.
    asked_by: [Option<[usize; 2]>; 2],
}

/// What the models of each fold's field say of the groups of all other folds, by fold and model, in the order of the runs.
fn without_two_groups<'a>(
    folds: &[Fold<'a>],
    groups: &[Vec<usize>],
    fields: &[Field<'a>],
) -> Vec<Vec<Vec<HeldOutRun>>> {
    let models: Vec<Vec<&Trial<'a>>> = fields.iter().map(Field::models).collect();
    let mut tasks: BTreeMap<Key, Task<'_, 'a>> = BTreeMap::new();
    for (place, (fold, models)) in folds.iter().zip(&models).enumerate() {
        for (model, trial) in models.iter().enumerate() {
            let names = trial.specification.names();
            for other in (0..groups.len()).filter(|other| *other != fold.group) {
                let pair = [fold.group.min(other), fold.group.max(other)];
                let side = usize::from(fold.group > other);
                let new = Task { bench: &fold.bench, start: trial, asked_by: [None; 2] };
                tasks.entry((names.clone(), pair)).or_insert(new).asked_by[side] = Some([place, model]);
            }
        }
    }
    let tasks: Vec<_> = tasks.into_iter().collect();
    let predict = |((_, [first, second]), task): &(Key, Task<'_, 'a>)| {
        let [first, second] = [&groups[*first], &groups[*second]];
        let without: Vec<usize> = first.iter().chain(second).copied().collect();
        let [of_first, of_second] = task.bench.without(&without).predict_shortly(task.start, [first, second]);
        [(task.asked_by[0], of_second), (task.asked_by[1], of_first)]
    };
    let answers: Vec<_> = tasks.par_iter().flat_map_iter(predict).collect();
    let mut predicted: Vec<Vec<Vec<HeldOutRun>>> = models.iter().map(|models| vec![Vec::new(); models.len()]).collect();
    for (asked_by, runs) in answers {
        if let Some([place, model]) = asked_by {
            predicted[place][model].extend(runs);
        }
    }
    predicted.iter_mut().flatten().for_each(|runs| runs.sort_by_key(|run| run.run));
    predicted
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::terramechanics::effects::effect_info;

    use super::*;
    use crate::data::campaign::Carried;
    use crate::diagnose::measurements::Measurements;
    use crate::diagnose::specification::{EffectForm, Specification};
    use crate::diagnose::unseen_runs::{groups, held_out};

    /// Each fold is answered for each of its models, of the runs of all the other folds, what fits of its own would say.
    #[test]
    fn a_fit_without_two_groups_answers_both() {
        let campaign = Carried::from_name("cmu-smooth-straight").expect("carried").campaign().expect("a campaign");
        let measurements = Measurements::of(&campaign, false).expect("measured");
        let bench = Bench::new(&campaign, &measurements);
        let all = bench.fitted_from_many_starts(Specification::default()).expect("a fit");
        let groups = groups(measurements.runs.len(), measurements.rows.len());
        let fold = |group: usize| {
            let bench = bench.without(&groups[group]);
            let before = bench.refit(&all).expect("a fit");
            Fold { group, after: before.clone(), before, bench }
        };
        let folds = [fold(0), fold(2), fold(5)];
        let effects = ["slip-sinkage", "load-stiffening"].map(|id| {
            let info = effect_info(id).expect("listed");
            EffectForm::new(info, &info.forms[0])
        });
        // The second fold has one model fewer: it is asked less.
        let fields: Vec<Field<'_>> = folds.iter().map(|fold| field(fold, &effects)).collect();
        let fields =
            [fields[0].clone(), Field::all(&fields[1].base, fields[1].trials[..1].to_vec()), fields[2].clone()];
        let predicted = without_two_groups(&folds, &groups, &fields);
        assert!(predicted[1].is_empty());
        for place in [0, 2] {
            let (fold, models) = (&folds[place], fields[place].models());
            assert_eq!(predicted[place].len(), models.len());
            for (predicted, model) in predicted[place].iter().zip(models) {
                let alone = held_out(&fold.bench, model);
                assert_eq!(predicted.len(), measurements.runs.len() - groups[fold.group].len());
                for (one, other) in predicted.iter().zip(&alone) {
                    assert_eq!(one.run, other.run);
                    let (one, other) = (one.log_score.expect("a score"), other.log_score.expect("a score"));
                    assert!((one - other).abs() < 0.02 * (1.0 + other.abs()), "{one}, {other}");
                }
            }
        }
    }

    fn field<'a>(fold: &Fold<'a>, effects: &[EffectForm]) -> Field<'a> {
        let trials = effects.iter().map(|effect| fold.bench.with_effect(&fold.before, effect).expect("a fit"));
        Field::all(&fold.before, trials.collect())
    }
}
