//! `kapvik close-loop`

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use kapvik_firmware::terramechanics::Soil;

use crate::close_loop::{ClosedSoil, Options, close};
use crate::data::atomic_write::{write_json, write_text};
use crate::data::campaign::{Campaign, Fingerprint, Provenance};
use crate::data::outputs;
use crate::data::soil_file::SoilTable;
use crate::data::text::TextFile;
use crate::diagnose::document::Diagnosis;
use crate::error::HostError;
use crate::report::diagnosis::page;
use crate::target_folder::target_folder;
use crate::train::plan::Plan;

use super::diagnose;

/// Options of `kapvik close-loop`.
#[derive(Args)]
pub struct Arguments {
    /// The campaign NAME.csv, with NAME.toml beside it; or the name of one that the project carries, as for `diagnose`
    #[arg(value_name = "CAMPAIGN.csv")]
    campaign: PathBuf,
    /// Where declared.toml and the trained table go [default: target/kapvik-close-loop]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// A diagnosis of this campaign that `kapvik diagnose --json` has written, in place of a new one
    #[arg(long, value_name = "D.json")]
    diagnosis: Option<PathBuf>,
    /// The campaign's soil where it is known, as a file with a complete [soil] [default: NAME.truth.toml beside the campaign, if
    /// there is one]
    #[arg(long, value_name = "SOIL.toml")]
    truth: Option<PathBuf>,
    /// Seed of training and of the simulated rovers
    #[arg(long, default_value_t = 1)]
    seed: u32,
    /// A run of seconds, to see that everything works; what it trains is not worth flying
    #[arg(long)]
    quick: bool,
}

/// Diagnoses, trains, compares, and prints the tables.
///
/// # Errors
/// Where a file is not as it should be or cannot be written.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let start = Instant::now();
    let say = |what: &str| eprintln!("[{:4.0} s] {what}", start.elapsed().as_secs_f64());
    let campaign = diagnose::campaign(&arguments.campaign)?;
    let truth = truth(arguments)?;
    let folder = arguments.output.clone().unwrap_or_else(|| target_folder().join("kapvik-close-loop"));
    // One that is yet to be made holds nothing that is read.
    if folder.is_dir() {
        check_outputs(arguments, &folder)?;
    }
    let known = arguments.diagnosis.as_deref().map(|path| read(path, &campaign)).transpose()?;
    std::fs::create_dir_all(&folder).map_err(HostError::file(&folder))?;
    let diagnosis = match known {
        Some(diagnosis) => diagnosis,
        None => {
            say("diagnosis");
            diagnosed(&campaign, &folder)?
        }
    };
    let (plan, rovers) = match arguments.quick {
        true => (Plan::quick(arguments.seed), 1000),
        false => (Plan::medium(arguments.seed), 10_000),
    };
    // Of a seed that no plan draws its scenes from.
    let options = Options { plan, rovers, seed: arguments.seed.wrapping_add(1 << 30) };
    let closed = close(&campaign, &diagnosis, truth.as_ref(), &folder, &options, &say)?;
    say("done");
    println!("{}", sentence(&diagnosis));
    println!("\nRoot mean square errors on held-out runs\n\n{}", closed.forces);
    println!("\ndeclared model: {}", folder.join("declared.toml").display());
    let table = folder.join("kapvik.table");
    let Some(soil) = closed.soil else {
        println!("Nothing was found that could be declared: the networks stay as they are.");
        if table.exists() {
            println!("{} was there before: it is not of this campaign.", table.display());
        }
        return Ok(());
    };
    print_training(&soil, &options);
    println!("\n{}\n\n{}", title_of_estimates(&campaign, truth.is_some()), soil.estimates);
    println!("\ntable: {}\nto fly it: kapvik run --weights {0}", table.display());
    Ok(())
}

/// A new diagnosis, written to the folder as a page and as a document.
fn diagnosed(campaign: &Campaign, folder: &Path) -> Result<Diagnosis, HostError> {
    let outcome = diagnose::with_progress(campaign, false)?;
    write_text(&folder.join("diagnosis.html"), &page(&diagnose::findings(campaign, &outcome)))?;
    write_json(&folder.join("diagnosis.json"), &outcome.document)?;
    Ok(outcome.document)
}

fn print_training(soil: &ClosedSoil, options: &Options) {
    let (plan, rovers) = (&options.plan, options.rovers);
    let [before, after] = &soil.effects;
    println!("\nRover network trained for\n  before  {before}\n  after   {after}");
    println!("by the same plan: {} scenes, {} epochs.", plan.scenes, plan.rover.epochs);
    println!(
        "\nErrors on {rovers} simulated rovers of each kind, on soil with the effects of after\n\n{}",
        soil.errors
    );
}

/// What is written to the folder must not take the place of what is read.
fn check_outputs(arguments: &Arguments, folder: &Path) -> Result<(), HostError> {
    let Arguments { campaign, diagnosis, truth, .. } = arguments;
    let mut names = vec!["declared.toml", "kapvik.table"];
    if diagnosis.is_none() {
        names.extend(["diagnosis.html", "diagnosis.json"]);
    }
    let written: Vec<PathBuf> = names.into_iter().map(|name| folder.join(name)).collect();
    let written: Vec<Option<&Path>> = written.iter().map(|path| Some(path.as_path())).collect();
    let about = campaign.with_extension("toml");
    outputs::check(&written, &[Some(campaign), Some(&about), diagnosis.as_deref(), truth.as_deref()])
}

/// The soil that was named, or that of a file beside the campaign.
fn truth(arguments: &Arguments) -> Result<Option<Soil<f64>>, HostError> {
    let beside = arguments.campaign.with_extension("truth.toml");
    match &arguments.truth {
        Some(path) => SoilTable::read_complete(path).map(Some),
        None if beside.is_file() => SoilTable::read_complete(&beside).map(Some),
        None => Ok(None),
    }
}

fn title_of_estimates(campaign: &Campaign, is_known: bool) -> &'static str {
    match (is_known, campaign.provenance) {
        (true, _) => "Estimates on the campaign itself, beside the truth",
        (false, Provenance::Simulated) => {
            "Estimates on the campaign itself (simulated; --truth SOIL.toml would show their errors)"
        }
        (false, _) => "Estimates on the campaign itself, whose truth is not known",
    }
}

/// The diagnosis' own sentence, which begins with the campaign's name.
fn sentence(diagnosis: &Diagnosis) -> String {
    match diagnosis.sentence.as_str() {
        "" => format!("{}: {}", diagnosis.campaign, diagnosis.verdict),
        sentence => sentence.to_owned(),
    }
}

/// A diagnosis of the campaign from a file; one of another campaign is refused.
fn read(path: &Path, campaign: &Campaign) -> Result<Diagnosis, HostError> {
    let file = TextFile::read(path)?;
    let diagnosis: Diagnosis = serde_json::from_str(file.text()).map_err(|error| HostError::Input {
        path: path.to_path_buf(),
        line: error.line() as u64,
        column: error.column() as u64,
        message: format!("not a diagnosis: {error}"),
    })?;
    let refuse = |key: &str, message: String| {
        let place = file.text().find(&format!("\"{key}\"")).unwrap_or(0);
        Err(file.error_at(place, message))
    };
    if diagnosis.campaign != campaign.name {
        let (found, expected) = (&diagnosis.campaign, &campaign.name);
        return refuse("campaign", format!("a diagnosis of `{found}`: expected one of `{expected}`"));
    }
    let data = Fingerprint::of(campaign);
    if let Some(found) = diagnosis.data.as_ref().filter(|found| **found != data) {
        let name = &campaign.name;
        return refuse(
            "data",
            format!("a diagnosis of other data by the name `{name}`, {found}: expected one of {data}"),
        );
    }
    if diagnosis.declared != campaign.declared.ids() {
        let [found, expected] =
            [&diagnosis.declared, &campaign.declared.ids()].map(|ids| format!("[{}]", ids.join(", ")));
        return refuse("declared", format!("a diagnosis with {found} declared: expected one with {expected}"));
    }
    Ok(diagnosis)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of a diagnosis of the campaign `name`, of some data, with some effects declared, beside one named `sand` that
    /// declares none.
    fn refusal(name: &str, data: &str, declared: &str) -> Option<String> {
        let csv = "run,t_s,slip,load_n,torque_nm\na,0,0.1,65,1.2\n";
        let toml = "name = \"sand\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.075\nwidth_m = 0.07\n";
        let campaign = Campaign::parse(Path::new("sand.csv"), csv, toml).expect("a campaign");
        let json = format!(
            "{{\n  \"campaign\": \"{name}\",{data}\n  \"declared\": [{declared}], \"verdict\": \"none\", \"effects\": [],\n  \
             \"runner_up\": null, \"ambiguous_with\": [], \"unexplained\": [], \"channels\": {{}},\n  \
             \"soil_before\": {{}}, \"soil_after\": {{}}, \"held_out_runs\": []\n}}\n"
        );
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), json).expect("written");
        read(file.path(), &campaign).err().map(|error| error.to_string())
    }

    #[test]
    fn a_diagnosis_of_another_campaign_is_refused() {
        assert_eq!(refusal("sand", "", ""), None);
        let other = refusal("gravel", "", "").expect("refused");
        assert!(other.ends_with(":2:3: a diagnosis of `gravel`: expected one of `sand`"), "{other}");
        let other = refusal("sand", "", "\"rate\"").expect("refused");
        assert!(other.ends_with(":3:3: a diagnosis with [rate] declared: expected one with []"), "{other}");
    }

    #[test]
    fn a_diagnosis_of_other_data_by_the_same_name_is_refused() {
        let data = |hash: &str| format!("\n  \"data\": {{\"runs\": 1, \"rows\": 1, \"hash\": \"{hash}\"}},");
        let other = refusal("sand", &data("0"), "").expect("refused");
        assert!(other.contains(":3:3: a diagnosis of other data by the name `sand`, 1 rows in 1 runs"), "{other}");
        let own = other.rsplit(' ').next().expect("the fingerprint that was expected");
        assert_eq!(refusal("sand", &data(own), ""), None);
    }
}
