//! The score of a benchmark, as a person reads it.

use comfy_table::CellAlignment;

use super::answer::Answer;
use super::campaign_draw::Subject;
use super::share::Share;
use super::trial::Trial;
use super::undeclared::effect_ids;
use crate::diagnose::document::Verdict;
use crate::statistics::median;
use crate::terminal_table::plain_table;

/// Prints all of it.
pub fn print(trials: &[Trial]) {
    print_confusion(trials);
    print_singles(trials);
    print_pairs(trials);
    print_unlisted(trials);
    print_clean(trials);
    print_wrong(trials);
    print_times(trials);
}

fn is_right(trial: &Trial) -> bool {
    trial.answer.as_ref().is_ok_and(|answer| answer.is_right(&trial.truth))
}

fn holds(trial: &Trial, of: impl Fn(&Answer) -> bool) -> bool {
    trial.answer.as_ref().is_ok_and(of)
}

/// The trials with one effect, with its id.
fn singles(trials: &[Trial]) -> Vec<(&'static str, &Trial)> {
    let one = |trial: &'_ Trial| match trial.truth.subject {
        Subject::One(id) => Some(id),
        _ => None,
    };
    trials.iter().filter_map(|trial| one(trial).map(|id| (id, trial))).collect()
}

/// What stands in a column of the confusion table: a first effect, or why there is none.
fn column_of(trial: &Trial, ids: &[&str]) -> usize {
    let others = ids.len();
    match &trial.answer {
        Err(_) => others + 2,
        Ok(answer) => match (answer.verdict, answer.first()) {
            (Verdict::None, _) => others,
            (Verdict::Unexplained, _) => others + 1,
            (_, Some(first)) => ids.iter().position(|id| *id == first).unwrap_or(others + 2),
            (_, None) => others + 1,
        },
    }
}

fn print_confusion(trials: &[Trial]) {
    let singles = singles(trials);
    if singles.is_empty() {
        return;
    }
    let ids = effect_ids();
    let columns = ids.len() + 3;
    let mut table = plain_table();
    let header = ["", "right", "alone"].map(str::to_owned).into_iter();
    let header = header.chain((1..=ids.len()).map(|number| number.to_string()));
    table.set_header(header.chain(["none", "unexp.", "error"].map(str::to_owned)));
    for (number, id) in ids.iter().enumerate() {
        let own: Vec<&Trial> = singles.iter().filter(|(of, _)| of == id).map(|(_, trial)| *trial).collect();
        if own.is_empty() {
            continue;
        }
        let right = Share::of(&own, |trial| is_right(trial));
        let alone = Share::of(&own, |trial| holds(trial, |answer| answer.first_alone(id)));
        let mut row =
            vec![format!("{} {id}", number + 1), format!("{}/{}", right.hits, right.of), alone.hits.to_string()];
        row.extend((0..columns).map(
            |column| match own.iter().filter(|trial| column_of(trial, &ids) == column).count() {
                0 => "·".to_owned(),
                count => count.to_string(),
            },
        ));
        table.add_row(row);
    }
    for (place, column) in table.column_iter_mut().enumerate() {
        column.set_padding((0, 1));
        if place > 0 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    println!(
        "\nOne undeclared effect: rows what was true, columns the first effect that was named. right: named first, or one of \
         at most three that are left open; alone: named first, nothing left open\n{table}"
    );
}

fn print_singles(trials: &[Trial]) {
    let singles: Vec<&Trial> = singles(trials).into_iter().map(|(_, trial)| trial).collect();
    if singles.is_empty() {
        return;
    }
    let share =
        |keep: &dyn Fn(&Trial) -> bool| Share::of(singles.iter().filter(|trial| keep(trial)), |trial| is_right(trial));
    println!("\nright first effect            {}", share(&|_| true));
    println!("  n, k, c1, c2 known          {}", share(&|trial| trial.truth.known_soil));
    println!("  free                        {}", share(&|trial| !trial.truth.known_soil));
    println!("  a form of the library       {}", share(&|trial| !trial.truth.variant));
    println!("  another law                 {}", share(&|trial| trial.truth.variant));
    println!("  1–2 σ after the refit       {}", share(&|trial| trial.truth.size < 2.0));
    println!("  2–4 σ                       {}", share(&|trial| trial.truth.size >= 2.0));
}

fn print_pairs(trials: &[Trial]) {
    let pairs = || trials.iter().filter(|trial| matches!(trial.truth.subject, Subject::Two(..)));
    if pairs().next().is_none() {
        return;
    }
    let one_of = |trial: &Trial| match trial.truth.subject {
        Subject::Two(first, second) => holds(trial, |answer| answer.finds(first) || answer.finds(second)),
        _ => false,
    };
    println!("two effects: both found       {}", Share::of(pairs(), |trial| is_right(trial)));
    println!("  the first found is one      {}", Share::of(pairs(), |trial| one_of(trial)));
}

fn print_unlisted(trials: &[Trial]) {
    let of = |trial: &'_ Trial| match trial.truth.subject {
        Subject::Unlisted(unlisted) => Some(unlisted),
        _ => None,
    };
    let cases: Vec<_> = trials.iter().filter_map(|trial| of(trial).map(|unlisted| (unlisted, trial))).collect();
    if cases.is_empty() {
        return;
    }
    let said = |(_, trial): &&(_, &Trial)| holds(trial, |answer| answer.verdict == Verdict::Unexplained);
    println!("no listed effect: unexplained {}", Share::of(&cases, said));
    println!("  with the right channel      {}", Share::of(&cases, |(_, trial)| is_right(trial)));
    let column = Share::of(&cases, |(unlisted, trial)| {
        holds(trial, |answer| answer.sees_following(unlisted.channel, unlisted.column))
    });
    println!("  and the right column        {column}");
    for (name, of_sensors) in [("following a cause", false), ("an error of a sensor", true)] {
        let half: Vec<_> = cases.iter().filter(|(unlisted, _)| unlisted.is_of_a_sensor() == of_sensors).collect();
        println!("  {name:<28}{}", Share::of(&half, |(_, trial)| is_right(trial)));
    }
}

fn print_clean(trials: &[Trial]) {
    let clean: Vec<&Trial> = trials.iter().filter(|trial| matches!(trial.truth.subject, Subject::Clean)).collect();
    if clean.is_empty() {
        return;
    }
    // A diagnosis that fails is not one that finds nothing.
    println!("nothing undeclared: alarms    {}", Share::of(&clean, |trial| !is_right(trial)));
    for (name, verdict) in
        [("effect", Verdict::Effect), ("ambiguous", Verdict::Ambiguous), ("unexplained", Verdict::Unexplained)]
    {
        let count = clean.iter().filter(|trial| holds(trial, |answer| answer.verdict == verdict)).count();
        println!("  {name:<28}{count}");
    }
    for (name, known) in [("n, k, c1, c2 known", true), ("free", false)] {
        let half = clean.iter().filter(|trial| trial.truth.known_soil == known);
        println!("  {name:<28}{}", Share::of(half, |trial| !is_right(trial)));
    }
}

/// Every campaign of which something wrong was said, for a person who wants to know why.
fn print_wrong(trials: &[Trial]) {
    println!("\nnot right:");
    for trial in trials.iter().filter(|trial| !is_right(trial)) {
        println!(
            "  {}: {} ({:.1} σ, soil {}): {}",
            trial.name,
            trial.truth.laws.join(" and "),
            trial.truth.size,
            if trial.truth.known_soil { "known" } else { "free" },
            said(trial)
        );
    }
}

fn said(trial: &Trial) -> String {
    match &trial.answer {
        Err(error) => error.clone(),
        Ok(answer) => {
            let effects: Vec<&str> = answer.effects.iter().map(|effect| effect.id.as_str()).collect();
            let mut text = format!("{:?} {}", answer.verdict, effects.join(", "));
            if !answer.ambiguous_with.is_empty() {
                text += &format!(", or {}", answer.ambiguous_with.join(", "));
            }
            if let Some(structure) = answer.unexplained.first() {
                text += &format!("; {} follows {}", structure.channel, structure.regressor);
            }
            text
        }
    }
}

fn print_times(trials: &[Trial]) {
    let median_s = median(trials.iter().map(|trial| trial.seconds));
    if let Some(slowest) = trials.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds)) {
        println!(
            "\ntime of a campaign, with as many at once as there are cores: median {median_s:.2} s, most {:.2} s ({})",
            slowest.seconds, slowest.name
        );
    }
}
