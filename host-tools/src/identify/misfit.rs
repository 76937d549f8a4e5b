//! Runs that no soil explains: what is identified of them stands for something that the model lacks.
//!
//! Every method of identification takes the model for true. The soil of the greatest posterior probability leaves residuals that are as large
//! as the noise, if it is; where they are far larger, the soil has been bent to make up for another law, and is no soil's, by whichever method
//! and however narrow.
//!
//! Noise that is not stated is taken as large as it must be, and hides that. But a soil that is bent leaves what is known of it by other means,
//! too: where a method weighs that, and its soil is far beside it all the same, one of both is of another soil.

use std::collections::BTreeMap;

use kapvik_firmware::terramechanics::Soil;
use rayon::prelude::*;

use crate::data::campaign::{Campaign, Channel, Knowledge};
use crate::digits::significant;

use super::beside_map::beside;
use super::ignored_effects::{BothWays, moved};
use super::method::{FARTHEST, Finding, Fit, Method, NEAR_NOTHING, answer};
use super::on_curve::evidence;
use super::run_states::run_states;
use super::sensor_noise::{NoiseSource, SensorNoise};

/// The chance below which residuals are no noise.
const SIGNIFICANT: f64 = 1e-4;
/// Where a noise was only guessed a misfit may be the guess's, but not one by so much: all noise would have to be five times as large.
const BEYOND_GUESSES: f64 = 25.0;
/// Stated standard deviations by which no number of a soil is missed by chance.
const BESIDE: f64 = 4.0;
/// The same of what may be nothing at all: such a number is weighed by a wide logarithm, up to an end that only data push it to.
const BESIDE_NOTHING: f64 = FARTHEST - 1.0;

/// What `map` says of a run.
#[derive(Debug, Clone)]
pub struct ByMap {
    /// Why no soil explains the run; none where one does.
    pub misfit: Option<String>,
    /// The soil.
    pub found: Finding,
    /// The soil once it knows effects that are declared and that the answers beside it ignore; none where there are none.
    pub with_effects: Option<Finding>,
}

/// What `map` says of runs, by their names; of those that it does not refuse. It knows what a campaign declares where the answers that are
/// held against it do (`know_effects`).
pub fn by_map(campaign: &Campaign, know_effects: bool, noise: &SensorNoise) -> BTreeMap<String, ByMap> {
    let is_stated = is_stated(campaign, noise);
    let seen = campaign.as_seen(know_effects);
    let ignores = !know_effects && !campaign.declared.effects.is_empty();
    let runs = run_states(campaign, noise, Method::Map);
    let asked = |run: super::RunStates| {
        let ask = |campaign| answer(Method::Map, &evidence(Method::Map, campaign, noise, &run.states)).ok();
        let found = ask(&seen)?;
        let misfit = found.fit.and_then(|fit| in_words(&fit, is_stated));
        let with_effects = ignores.then(|| ask(campaign)).flatten();
        Some((run.run, ByMap { misfit, found, with_effects }))
    };
    runs.into_par_iter().filter_map(asked).collect()
}

impl ByMap {
    /// Why an answer that knows as much as `found` does tells nothing: `map` says another soil, or effects that it ignores are worth more
    /// than its standard deviations. None where neither is so.
    pub fn denies(&self, answer: &Finding, campaign: &Campaign) -> Option<String> {
        let ignored = || {
            let both_ways = BothWays { with: self.with_effects.as_ref()?, without: &self.found };
            moved(answer, &both_ways, &campaign.declared.ids())
        };
        beside(answer, &self.found).or_else(ignored)
    }
}

/// Why runs are explained by no soil, by their names, of fits that are there already, of a method that weighs what is known of the soil: and
/// why they are beside that.
pub fn misfits_of(
    campaign: &Campaign,
    noise: &SensorNoise,
    fits: impl Iterator<Item = (String, Fit)>,
) -> BTreeMap<String, String> {
    let is_stated = is_stated(campaign, noise);
    let why = |fit: &Fit| in_words(fit, is_stated).or_else(|| beside_what_is_known(campaign, &fit.soil));
    fits.filter_map(|(run, fit)| Some((run, why(&fit)?))).collect()
}

/// Whether the noise of all that is weighed is stated.
fn is_stated(campaign: &Campaign, noise: &SensorNoise) -> bool {
    let is_there = |channel: Channel| campaign.column(channel.name()).is_some();
    noise.by_channel().into_iter().all(|(channel, noise)| !is_there(channel) || noise.source == NoiseSource::Campaign)
}

fn in_words(fit: &Fit, is_stated: bool) -> Option<String> {
    let &Fit { chi_square, degrees_of_freedom, p_value, .. } = fit;
    if is_stated {
        return (p_value < SIGNIFICANT).then(|| {
            format!(
                "no soil explains the run: χ² is {chi_square:.0} where {degrees_of_freedom:.0} is expected (p = {p_value:.0e}); what the model \
                 lacks stands in c, φ and K"
            )
        });
    }
    (chi_square > BEYOND_GUESSES * degrees_of_freedom.max(1.0)).then(|| {
        format!(
            "no soil explains the run: χ² is {chi_square:.0} where {degrees_of_freedom:.0} is expected, and noise that is not stated would have \
             to be {:.0} times what it is taken for; units, or what the model lacks, stand in c, φ and K",
            (chi_square / degrees_of_freedom.max(1.0)).sqrt()
        )
    })
}

/// What `[soil]` says of one number.
struct Stated {
    key: &'static str,
    known: Option<Knowledge>,
    /// What was found.
    found: f64,
    /// Whether its logarithm is weighed, which is nearer to nothing than the number and farther from much.
    is_logarithmic: bool,
}

impl Stated {
    /// By how many stated standard deviations it is missed, where that is beyond chance, and that in words.
    fn missed(&self) -> Option<(f64, String)> {
        let Some(Knowledge::Value { value, std }) = self.known.filter(|known| known.std() > 0.0) else { return None };
        let times = (self.found - value).abs() / std;
        let by_logarithm = || (self.found / value).ln().abs() * value / std;
        let is_beside = match self.is_logarithmic {
            false => times > BESIDE,
            true if value < NEAR_NOTHING * std => times > BESIDE_NOTHING,
            true => times > BESIDE && by_logarithm() > BESIDE,
        };
        let [found, value, std] = [self.found, value, std].map(|number| significant(number, 3));
        let key = self.key;
        let words = format!("{key} is {found}, {times:.1} standard deviations from the {value} ± {std} that is stated");
        is_beside.then_some((times, words))
    }
}

/// Which number of a soil is farthest beside what a campaign knows of it, where that is no chance.
fn beside_what_is_known(campaign: &Campaign, soil: &Soil<f64>) -> Option<String> {
    let ground = &campaign.ground;
    let number = |key, known, found| Stated { key, known, found, is_logarithmic: false };
    let positive = |key, known, found| Stated { is_logarithmic: true, ..number(key, known, found) };
    let stiffness = if ground.stiffness.is_some() { "k_eff" } else { "k_c/b + k_phi" };
    let numbers = [
        number("n", ground.sinkage_exponent, soil.sinkage_exponent),
        positive(stiffness, ground.stiffness(&campaign.wheel), soil.frictional_modulus),
        positive("c", ground.cohesion_pa, soil.cohesion_pa),
        number("phi", ground.friction_angle_rad, soil.friction_angle_rad),
        positive("K", ground.shear_modulus_m, soil.shear_modulus_m),
        number("c1", ground.peak_stress_c1, soil.peak_stress_c1),
        number("c2", ground.peak_stress_c2, soil.peak_stress_c2),
        number("eta", ground.rebound_ratio, soil.rebound_ratio),
    ];
    let farthest = numbers.iter().filter_map(Stated::missed).max_by(|one, other| one.0.total_cmp(&other.0));
    farthest.map(|(_, words)| {
        format!(
            "the soil that explains the run best is not that of [soil]: {words}; [soil] is of another place, or what the model lacks stands in \
             c, φ and K"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::campaign::Carried;

    /// Of fits that leave no more than noise.
    fn why(campaign: &Campaign, soil: Soil<f64>) -> Option<String> {
        let fit = Fit { chi_square: 20.0, degrees_of_freedom: 20.0, p_value: 0.5, soil };
        misfits_of(campaign, &SensorNoise::of(campaign), std::iter::once(("a".to_owned(), fit))).remove("a")
    }

    /// Of nothing there is no logarithm.
    #[test]
    fn a_number_that_should_be_nothing_is_told_where_it_is_much() {
        let known = Some(Knowledge::Value { value: 0.0, std: 100.0 });
        let missed = |found| Stated { key: "c", known, found, is_logarithmic: true }.missed().map(|(_, words)| words);
        assert_eq!(missed(580.0).as_deref(), Some("c is 580, 5.8 standard deviations from the 0 ± 100 that is stated"));
        assert_eq!(missed(300.0), None);
    }

    /// φ = 0.557 ± 0.035 rad, c = 250 ± 150 Pa and K = 11.4 ± 1.0 mm are known; k_c exactly, k_φ to a sixth.
    #[test]
    fn a_soil_that_is_not_the_stated_one_is_told_by_its_farthest_number() {
        let campaign = Carried::Ding2011Smooth.campaign().expect("the project's own figures");
        let stated = campaign.ground.middle(&campaign.wheel);
        assert_eq!(why(&campaign, stated), None);
        let beside = Soil { friction_angle_rad: 0.372, shear_modulus_m: 0.007, ..stated };
        let said = why(&campaign, beside).expect("5.3 and 4.4 standard deviations");
        assert!(said.contains("phi is 0.372, 5.3 standard deviations from the 0.557 ± 0.035 that is stated"), "{said}");
        let near = Soil { friction_angle_rad: 0.43, shear_modulus_m: 0.0078, ..stated };
        assert_eq!(why(&campaign, near), None, "less than four of them");
        let cohesive = Soil { cohesion_pa: 900.0, ..stated };
        assert_eq!(why(&campaign, cohesive), None, "not so far beside in its logarithm, which is weighed");
        let stiff = Soil { frictional_modulus: 3.0 * stated.frictional_modulus, ..stated };
        assert!(why(&campaign, stiff).is_some_and(|said| said.contains("k_c/b + k_phi is ")));
    }
}
