//! A campaign drawn from a seed: site, layout, instruments, and what nobody declares.

use std::fmt;

use super::chance::Chance;
use super::instruments::Instruments;
use super::knowledge::Knowledge;
use super::layout::Layout;
use super::refit::Refit;
use super::shared_errors::SharedErrors;
use super::site::Site;
use super::state::State;
use super::undeclared::{Listed, SIZES, Sized, put_overlay, sized};
use super::unlisted::Unlisted;
use super::wants::Wants;
use super::world::Undeclared;
use super::write::{Columns, Written};

/// What a campaign is drawn for.
#[derive(Debug, Clone, Copy)]
pub enum Subject {
    /// Nothing is undeclared.
    Clean,
    /// One effect of the list.
    One(&'static str),
    /// Two of them.
    Two(&'static str, &'static str),
    /// An effect of no list.
    Unlisted(&'static Unlisted),
}

impl fmt::Display for Subject {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clean => formatter.write_str("clean"),
            Self::One(id) => formatter.write_str(id),
            Self::Two(first, second) => write!(formatter, "{first} and {second}"),
            Self::Unlisted(unlisted) => formatter.write_str(unlisted.law),
        }
    }
}

/// What is true of a drawn campaign.
#[derive(Debug, Clone)]
pub struct Truth {
    /// What it was drawn for.
    pub subject: Subject,
    /// The laws that act, in words.
    pub laws: Vec<String>,
    /// Whether one of them is no form of the library's.
    pub variant: bool,
    /// Whether n, k, c₁ and c₂ are known by other means.
    pub known_soil: bool,
    /// What the refitted declared model leaves in the worst channel, in units of the noise.
    pub size: f64,
}

/// A drawn campaign.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// A name for its files.
    pub name: String,
    /// What a tool gets to see.
    pub written: Written,
    /// What it does not.
    pub truth: Truth,
}

/// Campaigns that are thrown away before a law is given up: soils that do not carry their wheels, instruments and layouts in
/// which it does not show.
const ATTEMPTS: usize = 40;
/// Laws that are given up before a subject is.
const LAWS: usize = 10;
/// What must be left of the smaller of two effects beside a multiple of the other, in units of the noise.
const LEFT_BESIDE: f64 = 0.7;

/// The campaign of a number for a subject; every second one has its n, k, c₁ and c₂ known by other means. None where all
/// attempts failed.
pub fn draw(subject: Subject, errors: SharedErrors, seed: u64, number: u64) -> Option<Drawn> {
    let stream = subject.to_string();
    let mut chance = Chance::new(seed, &stream, number);
    let known_soil = number.is_multiple_of(2);
    let drawn = (0..LAWS).find_map(|_| {
        let cause = Cause::draw(&mut chance, subject)?;
        (0..ATTEMPTS).find_map(|_| attempt(&mut chance, subject, &cause, errors, known_soil))
    })?;
    Some(Drawn { name: format!("{}-{number:03}", stream.replace(|c: char| !c.is_ascii_alphanumeric(), "-")), ..drawn })
}

/// What is to be undeclared, before its size is known.
struct Cause {
    listed: Vec<Listed>,
    unlisted: Option<&'static Unlisted>,
}

impl Cause {
    fn draw(chance: &mut Chance, subject: Subject) -> Option<Self> {
        let (listed, unlisted) = match subject {
            Subject::Clean => (Vec::new(), None),
            Subject::One(id) => (vec![Listed::draw(chance, id, true)?], None),
            Subject::Two(first, second) => {
                (vec![Listed::draw(chance, first, false)?, Listed::draw(chance, second, false)?], None)
            }
            Subject::Unlisted(unlisted) => (Vec::new(), Some(unlisted)),
        };
        Some(Self { listed, unlisted })
    }

    fn wants(&self) -> Wants {
        let own = self.unlisted.map_or_else(Wants::default, |unlisted| (unlisted.wants)());
        self.listed.iter().fold(own, |wants, listed| wants.and(&listed.wants()))
    }

    fn laws(&self) -> Vec<String> {
        let listed = self.listed.iter().map(|listed| format!("{}: {}", listed.id(), listed.law()));
        listed.chain(self.unlisted.map(|unlisted| unlisted.law.to_owned())).collect()
    }
}

fn attempt(
    chance: &mut Chance,
    subject: Subject,
    cause: &Cause,
    errors: SharedErrors,
    known_soil: bool,
) -> Option<Drawn> {
    let of_runs = errors != SharedErrors::Usual;
    let wants = cause.wants().and(&Wants { long_runs: of_runs, few_runs: of_runs, ..Wants::default() });
    let site = Site::draw(chance, wants.grousers);
    let layout = Layout::draw(chance, &site, &wants);
    let columns = Columns::draw(chance, &layout, &wants, cause.unlisted.and_then(Unlisted::extra_column))?;
    let instruments = Instruments::draw(chance, &site, &layout, &wants, errors);
    let knowledge = if known_soil || wants.known_soil { Knowledge::draw(chance, &site) } else { Knowledge::none() };
    let (readings, size) = if matches!(subject, Subject::Clean) {
        (Undeclared::nothing().readings(&site, &layout.rows)?, 0.0)
    } else {
        let refit = Refit::new(&site, &layout, &instruments, &knowledge.std())?;
        let size = chance.between(SIZES.0, SIZES.1);
        (act(cause, &site, &layout, &refit, size)?, size)
    };
    let truth = Truth {
        subject,
        laws: cause.laws(),
        variant: cause.listed.iter().any(Listed::is_variant),
        known_soil: knowledge.is_some(),
        size,
    };
    let fields = instruments.measure(chance, &layout, &readings);
    let written = Written::new(chance, &site, &layout, &instruments, &knowledge, &columns, (&readings, &fields));
    Some(Drawn { name: String::new(), written, truth })
}

/// What sensors without noise read when the cause acts at a size; none where it cannot have that size.
fn act(cause: &Cause, site: &Site, layout: &Layout, refit: &Refit, wanted: f64) -> Option<Vec<State>> {
    if let Some(unlisted) = cause.unlisted {
        let found = sized(refit, wanted, |size| put_overlay(unlisted.act, size).readings(site, &layout.rows))?;
        return Some(found.readings);
    }
    let mut world = Undeclared::nothing();
    let mut alone: Vec<Sized> = Vec::new();
    for listed in &cause.listed {
        let found = sized(refit, wanted, |size| {
            let mut world = Undeclared::nothing();
            listed.put(site, &layout.rows, size, &mut world);
            world.readings(site, &layout.rows)
        })?;
        listed.put(site, &layout.rows, found.size, &mut world);
        alone.push(found);
    }
    let left: Vec<_> = alone.iter().map(|found| refit.residual(&found.readings)).collect();
    if let [first, second] = left.as_slice()
        && first.beside(second).size().min(second.beside(first).size()) < LEFT_BESIDE
    {
        return None;
    }
    world.readings(site, &layout.rows)
}

#[cfg(test)]
mod tests {
    use super::super::undeclared::effect_ids;
    use super::super::unlisted::UNLISTED;
    use super::*;

    fn check(subject: Subject, number: u64) {
        let drawn =
            draw(subject, SharedErrors::Usual, 7, number).unwrap_or_else(|| panic!("{subject} cannot be drawn"));
        let again = draw(subject, SharedErrors::Usual, 7, number).expect("the same again");
        assert_eq!(drawn.written, again.written, "{subject}: the same seed gives the same files");
        let campaign = drawn.written.campaign(&drawn.name).unwrap_or_else(|error| panic!("{subject}: {error}"));
        assert!((12..=60).contains(&campaign.runs().len()), "{subject}");
        assert!(campaign.declared.ids().is_empty());
        assert_eq!(campaign.ground.sinkage_exponent.is_some(), drawn.truth.known_soil);
        if let Subject::Unlisted(unlisted) = subject {
            assert!(campaign.column(unlisted.column).is_some(), "{subject}: the column that it follows");
            assert!(campaign.column(unlisted.channel.name()).is_some(), "{subject}: the channel that it acts on");
        }
    }

    #[test]
    fn every_listed_effect_can_be_drawn() {
        effect_ids().into_iter().for_each(|id| check(Subject::One(id), 1));
    }

    #[test]
    fn every_effect_of_no_list_can_be_drawn() {
        UNLISTED.iter().for_each(|unlisted| check(Subject::Unlisted(unlisted), 0));
    }

    #[test]
    fn clean_campaigns_and_pairs_can_be_drawn() {
        check(Subject::Clean, 0);
        check(Subject::Clean, 1);
        check(Subject::Two("slip-sinkage", "force-drift"), 0);
    }
}
