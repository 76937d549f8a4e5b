//! The measured figures that the project carries: small rounded tables with their citation, part of the program.

use std::path::Path;

use crate::error::HostError;

use super::Campaign;

/// A campaign that the project carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Carried {
    /// A smooth wheel at six slips on a planetary simulant that direct tests know, read off published curves.
    Ding2011Smooth,
    /// A smooth wheel in dry sand: drawbar pull, load and sinkage in steady driving, three repeats of nine slips.
    CmuSmoothStraight,
    /// The driven runs of the same tests over their way, until the sinkage is steady.
    CmuSmoothTransients,
}

impl Carried {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Ding2011Smooth, Self::CmuSmoothStraight, Self::CmuSmoothTransients];

    /// The name of its files, without folder and ending.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ding2011Smooth => "ding2011-smooth",
            Self::CmuSmoothStraight => "cmu-smooth-straight",
            Self::CmuSmoothTransients => "cmu-smooth-transients",
        }
    }

    /// The campaign of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|carried| carried.name() == name)
    }

    /// The campaign.
    ///
    /// # Errors
    /// Never in practice: the figures are part of this program, and tested.
    pub fn campaign(self) -> Result<Campaign, HostError> {
        let (csv, toml) = match self {
            Self::Ding2011Smooth => {
                (include_str!("../../../data/ding2011-smooth.csv"), include_str!("../../../data/ding2011-smooth.toml"))
            }
            Self::CmuSmoothStraight => (
                include_str!("../../../data/cmu-smooth-straight.csv"),
                include_str!("../../../data/cmu-smooth-straight.toml"),
            ),
            Self::CmuSmoothTransients => (
                include_str!("../../../data/cmu-smooth-transients.csv"),
                include_str!("../../../data/cmu-smooth-transients.toml"),
            ),
        };
        Campaign::parse(Path::new(&format!("host-tools/data/{}.csv", self.name())), csv, toml)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Channel;
    use super::*;

    /// So many rows and runs have the sources, or what is taken of them.
    #[test]
    fn the_figures_are_those_of_the_sources() {
        let sizes = Carried::ALL.map(|carried| {
            assert_eq!(Carried::from_name(carried.name()), Some(carried));
            let campaign = carried.campaign().expect("the project's own figures");
            (campaign.rows().len(), campaign.runs().len())
        });
        // The first table has the six tests as the wheels of one rover.
        assert_eq!(sizes, [(6, 1), (27, 27), (220, 15)]);
    }

    #[test]
    fn tests_one_after_the_other_are_runs_of_their_own() {
        let apart = Carried::Ding2011Smooth.campaign().expect("the project's own figures").with_a_run_for_each_row();
        let runs = apart.runs();
        assert_eq!(runs.len(), 6);
        assert!(runs.iter().enumerate().all(|(place, (_, rows))| *rows == [place]));
    }

    /// The last row of a run over its way is the steady sinkage that the other table has for the same run.
    #[test]
    fn the_two_tables_of_one_test_agree() {
        let [steady, way] = [Carried::CmuSmoothStraight, Carried::CmuSmoothTransients]
            .map(|carried| carried.campaign().expect("the project's own figures"));
        let mut compared = 0;
        for (run, rows) in way.runs() {
            let last = rows.last().and_then(|row| way.value(*row, Channel::Sinkage)).expect("a sinkage");
            let same = steady.rows().iter().position(|row| row.run == run).expect("the same run");
            let mean = steady.value(same, Channel::Sinkage).expect("a sinkage");
            assert!((last - mean).abs() < 1e-4, "{run}: {last} m and {mean} m");
            compared += 1;
        }
        assert_eq!(compared, 15);
    }
}
