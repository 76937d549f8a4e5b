//! What a reader of a diagnosis should know about its data.

use kapvik_firmware::terramechanics::effects::effect_info;

use crate::data::campaign::{Campaign, Channel};
use crate::digits::{counted, spaced_unit};
use crate::statistics::ends;

use super::candidates::{is_by_load, loads_differ};
use super::fit::{Model, Reading};
use super::force_channels::ForceChannels;
use super::forward::{FoundStep, Selected};
use super::loose_slip;
use super::measurements::{Measurements, column_name};
use super::residual_search::Structure;
use super::selection::{Judged, MISFIT};
use super::soil_coordinates::SoilParameter;
use super::stated_soil::{far_from_stated, is_far_from_stated};
use super::trial::Trial;
use super::usable_rows::brakes;

/// Spread of slip below which it counts as constant.
const ONE_SLIP: f64 = 0.03;
/// Share of its prior's standard deviation that a parameter must be known to, to count as told by the data.
const TOLD: f64 = 0.7;

/// Said where the load is one number throughout.
const SET_LOAD: &str = "The load is the same number in every row: it is what was put on the wheel, and not what a sensor read. Errors \
                        of a load sensor cannot be told and are not looked for; where the wheel did not feel that load, as by \
                        friction in a guide, the difference may stand under another effect.";
/// Said where it is not there.
const NO_LOAD: &str = "No load: the sinkage stands in for it, so that the sinkage is not judged itself. What makes a wheel sink deeper \
                       under the same load cannot be told from more load but through the forces, and load-stiffening, \
                       guide-friction and errors of the load are not looked for: what they do may stand under another effect.";
/// Said where all rows brake.
const ALL_BRAKE: &str = "No row drives: all are of wheels that are braked or towed, and used as with --braking. The equations know of skid \
                         but its sign, so that what they lack there may be no more than that.";
/// Said where nothing but the sinkage tells of the soil.
const ONLY_SINKAGE: &str = "Neither drawbar pull nor torque, and c1 and c2 are not stated exactly: a sinkage that grows with slip may be \
                            slip-sinkage, or a stress that peaks farther back; it may stand in c1 and c2.";
/// Said where rows of a run are not independent.
const REMEMBERS: &str = "What is left of a channel goes together from row to row along a run: its noise is not independent, or a law is \
                         missing. Rows then tell less than they seem to: gains count in as many independent rows as there seem to \
                         be, but standard deviations of parameters are stated too narrow.";

/// The caveats, sentence by sentence: those of the campaign's own notes, then what the data cannot decide.
pub fn caveats(campaign: &Campaign, measurements: &Measurements, selected: &Selected<'_>) -> Vec<String> {
    let model = selected.model();
    let found = selected.found.iter();
    let ends = found.clone().flat_map(|found| at_an_end(model, found.winner.id()));
    let untold_by_verdict =
        found.clone().enumerate().filter(|(place, found)| *place > 0 || !found.also_near.is_empty());
    let noted = campaign.notes.iter().cloned().chain(campaign.remarks());
    noted
        .chain(of_data(campaign, measurements).into_iter().flatten())
        .chain(of_fit(model).into_iter().flatten())
        .chain(only_sinkage(measurements, model))
        .chain(off_by_run(measurements, selected))
        .chain(ends)
        .chain(untold_by_verdict.filter_map(|(_, found)| left_open(found)))
        .chain(found.filter_map(|found| form_left_open(&found.winner)))
        .chain(slip_taken_as_known(campaign, measurements, selected))
        .chain(untold(campaign, selected))
        .chain(far_from_stated(campaign, model))
        .chain(selected.left.iter().filter_map(says_the_same))
        .chain(selected.rival.iter().filter_map(|rival| rival.in_words(measurements)))
        .collect()
}

/// What these data cannot tell, whatever the model.
fn of_data(campaign: &Campaign, measurements: &Measurements) -> [Option<String>; 10] {
    let runs = measurements.runs.len();
    let has = |reading| measurements.has(reading);
    let slips = spread(measurements, Reading::Slip);
    [
        measurements.rows.iter().all(|row| brakes(&row.readings)).then(|| ALL_BRAKE.to_owned()),
        (runs < 5 && campaign.has_several_runs()).then(|| {
            let runs = counted(runs as u64, "run", "runs");
            format!("Only {runs}: what is found rests on few independent observations.")
        }),
        (has(Reading::Load) && !loads_differ(measurements)).then(|| {
            let of_pull = "; an offset of the drawbar pull, a tilt and a share of the load look alike";
            format!(
                "One load level: cohesion and friction angle cannot be told apart by these data, nor any effect of the load{}.",
                if has(Reading::DrawbarPull) { of_pull } else { "" }
            )
        }),
        measurements.is_load_set.then(|| SET_LOAD.to_owned()),
        (!has(Reading::Load)).then(|| NO_LOAD.to_owned()),
        slips
            .filter(|(low, high)| high - low < ONE_SLIP)
            .map(|_| "Constant slip: the shear modulus and every effect of slip are beyond these data.".to_owned()),
        (!has(Reading::Torque) && has(Reading::DrawbarPull)).then(|| {
            "No torque: what resists the wheel and what drives it are seen only in their difference.".to_owned()
        }),
        (!has(Reading::Sinkage))
            .then(|| "No sinkage: the stiffness of the soil is known only through the forces.".to_owned()),
        guessed_noise(measurements),
        measurements.loose_slip.map(loose_slip::in_words),
    ]
}

fn guessed_noise(measurements: &Measurements) -> Option<String> {
    let is_guessed = |reading: &Reading| measurements.has(*reading) && !measurements.noise[reading.index()].stated;
    let guessed: Vec<_> = Reading::JUDGED.into_iter().filter(is_guessed).map(column_name).collect();
    (!guessed.is_empty()).then(|| {
        format!("The noise of {} is not stated; it is estimated from what the model leaves.", guessed.join(", "))
    })
}

/// How far what is stated of a fit is to be believed.
fn of_fit(model: &Trial<'_>) -> [Option<String>; 2] {
    let dispersion = model.fit.dispersion;
    [
        (dispersion > MISFIT).then(|| {
            format!(
                "The model misses the data by {:.1} times their noise in the mean: stated uncertainties are widened by as much, and \
                 what it lacks besides is not known.",
                dispersion.sqrt()
            )
        }),
        (model.fit.rows_per_reading() > 1.0).then(|| REMEMBERS.to_owned()),
    ]
}

fn only_sinkage(measurements: &Measurements, model: &Trial<'_>) -> Option<String> {
    let tells_a_force = [Reading::DrawbarPull, Reading::Torque].into_iter().any(|reading| measurements.has(reading));
    let is_peak_free = model.model.soil_parameters().iter().any(|parameter| ["c1", "c2"].contains(&parameter.key()));
    (!tells_a_force && measurements.has(Reading::Sinkage) && is_peak_free).then(|| ONLY_SINKAGE.to_owned())
}

/// The channels that are off by another amount in each run, by far more than their stated noise.
fn off_by_run<'a>(measurements: &'a Measurements, selected: &'a Selected<'_>) -> impl Iterator<Item = String> + 'a {
    measurements.off_by_run(&selected.model().fit.offset_std).map(|(reading, times)| {
        format!(
            "{} is off by another amount in each run, by {times:.1} times its stated noise: the zero of a sensor, or a law \
             that changes little within a run. The model does not say which.",
            column_name(reading)
        )
    })
}

/// What is said of parameters of an effect that was found which lie on an end of their range, or no further from it than they
/// are uncertain: how large they are the range says, and not the data. The end at which a parameter does nothing is none.
fn at_an_end(trial: &Trial<'_>, id: &str) -> Vec<String> {
    let Some(effect) = trial.specification.effect(id) else {
        return Vec::new();
    };
    let coordinates = trial.model.coordinates();
    let said = trial.places_of(effect.info.id).filter_map(|(place, name)| {
        let coordinate = &coordinates[place];
        let info = effect.info.parameter(name)?;
        let (value, (low, high)) = (trial.fit.parameters[place], (coordinate.low, coordinate.high));
        let std = trial.std(place);
        let is_near = |end: f64| (value - end).abs() <= std || value == end;
        let end = [low, high].into_iter().find(|end| *end != info.neutral && is_near(*end))?;
        let unit = spaced_unit(info.unit);
        Some(format!(
            "{id}: {name} = {value:.3}{unit} is at the end of its range, {low:.3} to {high:.3}{unit}, or no further from it \
             than it is uncertain. What lies at {end:.3} is where the search ended, not what the data tell: another law may \
             stand behind it."
        ))
    });
    said.collect()
}

/// What is said of an effect that others are not told from; of the first the verdict itself names the likeliest of them.
fn left_open(found: &FoundStep<'_>) -> Option<String> {
    let others = found.not_told_from();
    (!others.is_empty())
        .then(|| format!("{}: these data do not tell it from {}.", found.winner.id(), others.join(" or ")))
}

/// What is said of an effect whose form is not told from others.
fn form_left_open(winner: &Judged<'_>) -> Option<String> {
    let form = winner.effect()?.form.name;
    (!winner.other_forms.is_empty()).then(|| {
        format!("{}: these data do not tell its form, {form}, from {}.", winner.id(), winner.other_forms.join(" or "))
    })
}

/// What is said of a slip that is found wrong by a scale where nothing tells how well each reading of it is known.
fn slip_taken_as_known(campaign: &Campaign, measurements: &Measurements, selected: &Selected<'_>) -> Option<String> {
    const ID: &str = "rolling-radius";
    let is_stated = campaign.noise.of(Channel::Slip).is_some_and(|std| std > 0.0);
    let is_found = selected.found.iter().any(|found| found.winner.id() == ID || found.not_told_from().contains(&ID));
    (is_found && !is_stated).then(|| {
        format!(
            "{ID}: how well slip is known is not stated, and it is taken as {:.4}. Slips that are read less well bend what follows them, which \
             looks like a slip of another scale; state [noise] slip.",
            measurements.noise[Reading::Slip.index()].std
        )
    })
}

/// The soil's parameters about which the data say next to nothing.
fn untold(campaign: &Campaign, selected: &Selected<'_>) -> Option<String> {
    let trial = selected.model();
    let coordinates = super::fit::Model::coordinates(&trial.model);
    let is_untold = |(place, parameter): &(usize, &SoilParameter)| {
        // Of what the data move far from where it is stated to be they do speak.
        if is_far_from_stated(campaign, trial, **parameter) {
            return false;
        }
        let coordinate = &coordinates[*place];
        let width = coordinate.prior.map_or((coordinate.high - coordinate.low) / f64::sqrt(12.0), |(_, std)| std);
        trial.std(*place) > TOLD * width || trial.fit.on_bound.get(*place).copied().unwrap_or(false)
    };
    let free = trial.model.soil_parameters().iter().enumerate();
    let names: Vec<_> = free.filter(is_untold).map(|(_, parameter)| parameter.key()).collect();
    (!names.is_empty()).then(|| {
        let with = if selected.found.is_empty() { "" } else { ", with what was found in the model" };
        format!(
            "These data say little or nothing of {}{with}: what stands there is the prior or a bound.",
            names.join(", ")
        )
    })
}

/// What is said of structure that other columns would explain as well.
fn says_the_same(structure: &Structure) -> Option<String> {
    (!structure.also.is_empty()).then(|| {
        format!(
            "What {} follows in {} it follows in {} as well: these columns rise and fall together in these rows.",
            column_name(structure.channel),
            structure.regressor(),
            structure.also.join(" and ")
        )
    })
}

/// The least and the greatest reading.
fn spread(measurements: &Measurements, reading: Reading) -> Option<(f64, f64)> {
    ends(measurements.rows.iter().filter_map(|row| row.readings[reading.index()]))
}

/// What is said where something found follows a load whose readings show an error of their own.
pub fn error_of_load(selected: &Selected<'_>, by_themselves: &ForceChannels) -> Option<String> {
    let error = by_themselves.effects_on(Channel::Load).next()?;
    let follows_load = |id: &&str| effect_info(id).is_some_and(is_by_load);
    let found = selected.found.iter().map(|found| found.winner.id()).find(follows_load)?;
    Some(format!(
        "{found} may be nothing but the {} that the readings of the load show by themselves: a load that is read wrong, and a soil that answers \
         to the load, look alike to the other channels.",
        error.id
    ))
}
