//! Closing the loop: what a diagnosis found goes into the model that the networks are trained for, and the error is shown
//! before and after.

mod on_campaign;
mod report;
mod rover_networks;

use std::path::Path;

use kapvik_firmware::terramechanics::Soil;

use crate::data::atomic_write::write_text;
use crate::data::campaign::{Campaign, Declared};
use crate::diagnose::declared_file;
use crate::diagnose::document::Diagnosis;
use crate::error::HostError;
use crate::train::emit::{Provenance, table_file};
use crate::train::fifth_input::Candidate;
use crate::train::plan::Plan;
use crate::train::world::World;

pub use on_campaign::{CampaignSoil, SoilColumn, on_campaign};
pub use report::{errors_of_forces, errors_of_soil, estimates};
pub use rover_networks::{Rovers, Trained, compare, train};

/// How the loop is closed.
#[derive(Debug, Clone, Copy)]
pub struct Options {
    /// How both networks are trained.
    pub plan: Plan,
    /// Simulated rovers of each kind.
    pub rovers: usize,
    /// Their seed, of which training knows nothing.
    pub seed: u32,
}

/// What came of it: what the terminal shows.
pub struct Closed {
    /// Errors of forces and sinkage on held-out runs.
    pub forces: String,
    /// What is left when an effect was found; none where there is nothing to train for.
    pub soil: Option<ClosedSoil>,
}

/// What closing the loop does to the estimate of the soil.
pub struct ClosedSoil {
    /// Effects that the networks were trained with, before and after.
    pub effects: [String; 2],
    /// Errors on simulated rovers.
    pub errors: String,
    /// Estimates on the campaign, with their errors where its soil is known.
    pub estimates: String,
}

/// Trains before and after, and compares; `truth` is the campaign's soil, where it is known, and `say` is told what comes next.
/// Writes `declared.toml` and, where an effect was found, the table that flies with
/// it (`kapvik.table`) to `folder`, which is there.
///
/// # Errors
/// Where a file cannot be written, or no rover could drive with the effects.
pub fn close(
    campaign: &Campaign,
    diagnosis: &Diagnosis,
    truth: Option<&Soil<f64>>,
    folder: &Path,
    options: &Options,
    say: &dyn Fn(&str),
) -> Result<Closed, HostError> {
    let (path, table) = (folder.join("declared.toml"), folder.join("kapvik.table"));
    let declaration = declared_file(campaign, diagnosis);
    let forces = errors_of_forces(diagnosis);
    if diagnosis.effects.is_empty() {
        write_text(&path, &declaration)?;
        return Ok(Closed { forces, soil: None });
    }
    // What the file says is what is trained for, as if by hand.
    let worlds = [World::declared(&campaign.declared), World::declared(&Declared::parse(&path, &declaration)?)];
    let [_, after] = &worlds;
    let rovers = Rovers::draw(after, options.rovers, options.seed)?;
    say(&format!("1 of 3: network before, trained for {}", worlds[0]));
    let before = train(&worlds[0], &options.plan, false)?;
    say(&format!("2 of 3: networks after, trained for {after}"));
    let found = train(after, &options.plan, true)?;
    say("3 of 3: scores");
    let tables = [&before.rover, &found.rover];
    let fits = [&diagnosis.soil_before, &diagnosis.soil_after];
    let soil = ClosedSoil {
        effects: [worlds[0].to_string(), after.to_string()],
        errors: errors_of_soil(&compare(&tables, &rovers)),
        estimates: estimates(&on_campaign(campaign, &tables), fits, truth),
    };
    let flown = found.wheel.map(|(wheel, loss)| {
        let losses = [loss, found.loss];
        let provenance = Provenance { plan: &options.plan, world: after, fifth: Candidate::SHIPPED, losses };
        table_file(wheel, found.rover, &provenance)
    });
    let flown = flown.transpose()?;
    // Both at the end: a table of an earlier campaign must not stand beside the declaration of this one.
    write_text(&path, &declaration)?;
    if let Some(flown) = flown {
        write_text(&table, &flown.to_text())?;
    }
    Ok(Closed { forces, soil: Some(soil) })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// Two runs of a wheel on sand, as a file would have them.
    fn campaign(declared: &str) -> Campaign {
        const CSV: &str = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m\n\
            a,0,0.1,65,5,1.2,0.010\na,0,0.3,66,12,1.9,0.014\na,0,0.5,64,15,2.2,0.018\n\
            b,0,0.2,65,9,1.6,0.012\nb,0,0.4,66,14,2.1,0.016\nb,0,0.6,64,16,2.4,0.021\n";
        let toml = format!(
            "name = \"sand\"\nkind = \"measured\"\nsource = \"made up\"\ngravity_m_s2 = 9.81\n\
             [wheel]\nradius_m = 0.075\nwidth_m = 0.070\n[declared]\n{declared}"
        );
        Campaign::parse(Path::new("sand.csv"), CSV, &toml).expect("a campaign")
    }

    /// A diagnosis that found slip-sinkage, n1 = 0.30 ± 0.03.
    fn diagnosis() -> Diagnosis {
        let json = r#"{ "campaign": "sand", "declared": [], "verdict": "effect",
            "effects": [ { "id": "slip-sinkage", "form": "exponent", "parameters": {"n1": {"value": 0.3, "std": 0.03}},
                           "gain_per_row": 1.2, "p_value": 1e-9 } ],
            "runner_up": null, "ambiguous_with": [], "unexplained": [],
            "channels": { "sinkage_m": { "rmse_before": 0.0041, "rmse_after": 0.0018, "noise": 0.0007, "runs": 15 } },
            "soil_before": {}, "soil_after": {}, "held_out_runs": ["a"] }"#;
        serde_json::from_str(json).expect("a diagnosis")
    }

    fn options() -> Options {
        let plan = Plan::glance(5);
        Options { plan, rovers: 200, seed: 77_000 }
    }

    #[test]
    fn the_loop_is_closed_with_what_was_found() {
        let folder = tempfile::tempdir().expect("a folder");
        let closed =
            close(&campaign("effects = []\n"), &diagnosis(), None, folder.path(), &options(), &|_| ()).expect("closed");
        let soil = closed.soil.expect("an effect was found");
        assert_eq!(soil.effects, ["none: equations 1-11", "slip-sinkage: n1 0.3 +- 0.03 normal"]);
        assert!(closed.forces.contains("4.100") && closed.forces.contains("1.800"), "{}", closed.forces);
        let rows = soil.errors.lines().filter(|line| line.contains("before") || line.contains("after")).count();
        assert_eq!(rows, 6, "{}", soil.errors);
        // One line for each of c, φ and K.
        assert!(
            soil.estimates.lines().filter(|line| line.contains("network after")).count() == 3,
            "{}",
            soil.estimates
        );
        let table = std::fs::read(folder.path().join("kapvik.table")).expect("the table that flies");
        let table = kapvik_table_file::TableFile::parse(&table).expect("a whole table");
        assert!(table.notes.contains(&("effects".to_owned(), soil.effects[1].clone())));
    }

    #[test]
    fn where_nothing_was_found_nothing_is_trained() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut nothing = diagnosis();
        nothing.effects.clear();
        let closed =
            close(&campaign("effects = []\n"), &nothing, None, folder.path(), &options(), &|_| ()).expect("closed");
        assert!(closed.soil.is_none());
        assert!(folder.path().join("declared.toml").exists() && !folder.path().join("kapvik.table").exists());
    }
}
