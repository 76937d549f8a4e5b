//! What became of the effects that the model is told of: as they were fitted, and whether the data show them.

use super::assemble::parameters;
use super::bench::Bench;
use super::document::DeclaredFit;
use super::forward::Selected;
use super::selection::TELLS_APART;
use super::soil_coordinates::SoilParameter;
use super::specification::{EffectForm, Specification};
use super::trial::Trial;

/// Standard deviations by which a soil is another.
const ANOTHER: f64 = 2.0;

/// The declared effects as the final model has them, in the order of the campaign; and what is said of those that the data do not show.
pub fn declared_effects(bench: &Bench<'_>, selected: &Selected<'_>) -> (Vec<DeclaredFit>, Vec<String>) {
    let (base, last) = (&selected.base, selected.model());
    let fitted = |effect: &EffectForm| DeclaredFit {
        id: effect.info.id.to_owned(),
        form: effect.form.name.to_owned(),
        parameters: parameters(bench.measurements, last, effect.info.id),
    };
    let effects = &base.specification.effects;
    let not_shown = effects.iter().filter_map(|effect| not_shown(bench, base, effect)).collect();
    (effects.iter().map(fitted).collect(), not_shown)
}

/// What is said of an effect without which the declared model fits as well: that, and of what the soil is another then.
fn not_shown(bench: &Bench<'_>, base: &Trial<'_>, effect: &EffectForm) -> Option<String> {
    let id = effect.info.id;
    base.places_of(id).next()?;
    let others = base.specification.effects.iter().filter(|other| other.info.id != id);
    let without = bench.fitted_from_many_starts(Specification { effects: others.cloned().collect() }).ok()?;
    if without.log_posterior() < base.log_posterior() - TELLS_APART {
        return None;
    }
    let soil: Vec<String> = base
        .model
        .soil_parameters()
        .iter()
        .enumerate()
        .filter_map(|(place, parameter)| another(base, &without, place, parameter))
        .collect();
    let told = if soil.is_empty() { String::new() } else { format!(" The soil is another then: {}.", soil.join(", ")) };
    Some(format!("The data do not show {id}, which is declared: the model without it fits as well.{told}"))
}

/// A parameter of the soil, where a model without an effect has it elsewhere by more than that itself knows.
fn another(base: &Trial<'_>, without: &Trial<'_>, place: usize, parameter: &SoilParameter) -> Option<String> {
    let [with, instead] = [base, without].map(|trial| trial.fit.parameters[place]);
    let is_another = (with - instead).abs() > ANOTHER * without.std(place);
    is_another.then(|| {
        let [with, instead] = [with, instead].map(|value| parameter.value(value));
        format!("{} = {instead:.3e} for {with:.3e}", parameter.key())
    })
}
