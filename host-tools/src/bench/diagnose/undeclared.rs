//! What nobody declares in a drawn campaign, and how large it is.

use kapvik_firmware::terramechanics::effects::{
    CATALOGUE, Column, EffectInfo, Effects, Form, ParameterInfo, effect_info,
};

use super::chance::Chance;
use super::overlay::Act;
use super::refit::Refit;
use super::site::Site;
use super::state::{Row, State};
use super::variants::{VARIANTS, Variant};
use super::wants::Wants;
use super::world::Undeclared;
use crate::data::campaign::Channel;

/// Share of draws by another law than the library's, of effects for which there is one.
const VARIANT_SHARE: f64 = 0.2;
/// Sizes between which an effect is drawn: what no refit explains, in units of the noise.
pub const SIZES: (f64, f64) = (1.0, 4.0);
/// Parameters that say how an effect goes and not how large it is.
const SHAPES: [&str; 6] = ["saturation", "reference_c", "start", "adhesion_pa", "m2", "settling_per_h"];

/// The ids of all listed effects.
pub fn effect_ids() -> Vec<&'static str> {
    CATALOGUE.iter().map(|effect| effect.id).collect()
}

/// A listed effect in one of its forms, its size still open.
#[derive(Debug, Clone)]
pub enum Listed {
    /// As the library has it.
    Library {
        /// The effect.
        effect: &'static EffectInfo,
        /// Its form.
        form: &'static Form,
        /// Parameters that grow with the size: the name, the value at size 0, and at size 1.
        growing: Vec<(&'static str, f64, f64)>,
        /// The others.
        fixed: Vec<(&'static str, f64)>,
    },
    /// By another law.
    Variant {
        /// Which.
        variant: &'static Variant,
        /// Its sign.
        sign: f64,
    },
}

impl Listed {
    /// Draws a form of an effect; none where there is no such effect. `variants`: also laws that the library does not have.
    pub fn draw(chance: &mut Chance, id: &str, variants: bool) -> Option<Self> {
        let others: Vec<&'static Variant> = VARIANTS.iter().filter(|variant| variant.id == id).collect();
        if variants && !others.is_empty() && chance.happens(VARIANT_SHARE) {
            let variant = chance.pick(&others);
            return Some(Self::Variant { variant, sign: if variant.signed { chance.sign() } else { 1.0 } });
        }
        let effect = effect_info(id)?;
        let forms: Vec<&'static Form> = effect.forms.iter().collect();
        let form = chance.pick(&forms);
        let (shapes, sizes): (Vec<_>, Vec<_>) =
            form.free.iter().filter_map(|name| effect.parameter(name)).partition(|info| SHAPES.contains(&info.name));
        let reach = |info: &&'static ParameterInfo| {
            let start = info.neutral.clamp(info.low, info.high);
            let (down, up) = (start - info.low, info.high - start);
            (start, down, up, down.max(up) / info.typical.abs())
        };
        let multiple = sizes.iter().map(|info| reach(info).3).fold(f64::INFINITY, f64::min);
        let growing = sizes
            .iter()
            .map(|info| {
                let (start, down, up, _) = reach(info);
                // Where one side is much the longer, the effect goes there.
                let sign = if down > 1.6 * up {
                    -1.0
                } else if up > 1.6 * down {
                    1.0
                } else {
                    chance.sign()
                };
                let weight = if sizes.len() > 1 { chance.between(0.4, 1.0) } else { 1.0 };
                let end = start + sign * weight * multiple * info.typical.abs();
                (info.name, start, end.clamp(info.low, info.high))
            })
            .collect();
        let mut fixed: Vec<(&'static str, f64)> = form.set.to_vec();
        for info in shapes {
            fixed.push((info.name, (info.typical * chance.log_between(0.4, 1.6)).clamp(info.low, info.high)));
        }
        Some(Self::Library { effect, form, growing, fixed })
    }

    /// The effect's id.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Library { effect, .. } => effect.id,
            Self::Variant { variant, .. } => variant.id,
        }
    }

    /// The law in words.
    pub fn law(&self) -> &'static str {
        match self {
            Self::Library { form, .. } => form.name,
            Self::Variant { variant, .. } => variant.law,
        }
    }

    /// Whether it is a law that the library does not have.
    pub fn is_variant(&self) -> bool {
        matches!(self, Self::Variant { .. })
    }

    /// What a campaign must have for it to show.
    pub fn wants(&self) -> Wants {
        let (effect, needs) = match self {
            Self::Library { effect, form, .. } => (*effect, form.needs),
            Self::Variant { variant, .. } => return (variant.wants)(),
        };
        let own = Wants {
            loads: effect.id == "load-stiffening",
            changing_slip: effect.id == "sinkage-lag",
            // Free coefficients of equation 10 are all that this effect is.
            known_soil: effect.id == "peak-stress-shift",
            ..Wants::default()
        };
        needs.iter().fold(own, |wants, column| wants.and(&wants_of(*column)))
    }

    /// Puts the effect into a world at a size.
    pub fn put(&self, site: &Site, rows: &[Row], size: f64, world: &mut Undeclared) {
        match self {
            Self::Library { effect, growing, fixed, .. } => {
                set_references(&mut world.effects, effect.id, site, rows);
                for (name, value) in fixed {
                    world.effects.set(effect.id, name, *value);
                }
                for (name, start, end) in growing {
                    world.effects.set(effect.id, name, start + size * (end - start));
                }
            }
            Self::Variant { variant, sign } => world.overlay = Some((variant.act, sign * size * variant.greatest)),
        }
    }
}

/// Loads and speeds at which the soil is as its parameters say: those of the campaign's middle.
fn set_references(effects: &mut Effects<f64>, id: &str, site: &Site, rows: &[Row]) {
    if id == "load-stiffening" {
        effects.set(id, "reference_load_n", site.load_n);
    }
    if id == "rate" {
        let logs = rows.iter().map(|row| libm::log(row.setting.speed_m_s));
        effects.set(id, "reference_speed_m_s", libm::exp(logs.sum::<f64>() / rows.len() as f64));
    }
}

fn wants_of(column: Column) -> Wants {
    let measured = Wants::columns(Channel::read_from(column).as_slice());
    match column {
        Column::SlipAngle => Wants { slip_angles: true, ..measured },
        Column::WheelRate | Column::Speed => Wants { speeds: true, ..measured },
        Column::WheelAngle => Wants { fast_rows: true, long_runs: true, ..measured },
        Column::Pass => Wants { passes: true, ..measured },
        Column::Travel => Wants { long_runs: true, ..measured },
        Column::Pitch => Wants { pitches: true, ..measured },
        Column::Grousers => Wants { grousers: true, ..measured },
        Column::DrawbarPull
        | Column::Load
        | Column::Torque
        | Column::Sinkage
        | Column::SideForce
        | Column::Temperature
        | Column::HoursSinceZero => measured,
    }
}

/// An effect at the size that was asked for.
pub struct Sized {
    /// The size: 0 is none, 1 the greatest that is looked at.
    pub size: f64,
    /// What sensors without noise then read.
    pub readings: Vec<State>,
}

/// The least size at which an effect leaves `wanted` units of noise after a refit; none where it never does.
pub fn sized(refit: &Refit, wanted: f64, readings: impl Fn(f64) -> Option<Vec<State>>) -> Option<Sized> {
    const LEAST: f64 = 1e-5;
    const GROWTH: f64 = 1.5;
    const NEAR: f64 = 0.02;
    let left = |size: f64| readings(size).map(|readings| refit.residual(&readings).size());
    // A first guess as if what is left grew with the size; then up from well below it.
    let probe = 1e-3;
    let mut high = (0.3 * probe * wanted / left(probe)?.max(1e-12)).clamp(LEAST, 1.0);
    if left(high)? >= wanted {
        high = LEAST;
        // It does not go to nothing with its size.
        if left(high)? >= wanted {
            return None;
        }
    }
    let mut low = 0.0;
    loop {
        let reached = left(high)?;
        if reached >= wanted {
            break;
        }
        if high >= 1.0 {
            return None;
        }
        (low, high) = (high, (high * GROWTH).min(1.0));
    }
    while high - low > NEAR * high {
        let middle = 0.5 * (low + high);
        if left(middle)? < wanted { low = middle } else { high = middle }
    }
    Some(Sized { size: high, readings: readings(high)? })
}

/// How an effect of no list is put into a world.
pub fn put_overlay(act: Act, size: f64) -> Undeclared {
    Undeclared { overlay: Some((act, size)), ..Undeclared::nothing() }
}

#[cfg(test)]
mod tests {
    use super::super::instruments::Instruments;
    use super::super::layout::Layout;
    use super::super::refit::PRIOR_STD;
    use super::super::shared_errors::SharedErrors;
    use super::super::unlisted::UNLISTED;
    use super::*;

    /// An offset that the soil cannot imitate (the side force, zero without it) is left whole: its size is exactly the
    /// wanted multiple of the noise.
    #[test]
    fn a_size_is_what_is_left_in_units_of_the_noise() {
        let mut chance = Chance::new(5, "size", 0);
        let wants = Wants::columns(&[Channel::SideForce]);
        let (site, layout, refit, noise) = std::iter::repeat_with(|| {
            let site = Site::draw(&mut chance, false);
            let layout = Layout::draw(&mut chance, &site, &wants);
            let instruments = Instruments::draw(&mut chance, &site, &layout, &wants, SharedErrors::Usual);
            let refit = Refit::new(&site, &layout, &instruments, &PRIOR_STD)?;
            Some((site, layout, refit, instruments.noise[3]?.hypot(instruments.offset_std[3])))
        })
        .take(50)
        .flatten()
        .next()
        .expect("a campaign");
        let offset = Act::State(|place, state, size| state.side_force_n += size * place.site.load_n);
        let found = sized(&refit, 2.0, |size| put_overlay(offset, size).readings(&site, &layout.rows)).expect("a size");
        let multiple = found.size * site.load_n / noise;
        assert!((1.9..2.1).contains(&multiple), "{multiple}");
        assert!(UNLISTED.len() >= 8, "kinds of effects of no list");
    }
}
