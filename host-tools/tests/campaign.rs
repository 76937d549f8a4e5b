//! What a campaign may and may not say: each mistake is told by file, line and column.

mod columns;

use std::path::Path;

use columns::COLUMNS;
use kapvik_host::data::campaign::{Campaign, Channel, Knowledge, Provenance};

const CSV: &str = "\
run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m,camera_c,note
a,0,0.1,80.0,11.0,3.0,0.0055,21.5,first
a,0,0.2,80.0,14.5,4.2,,,second
b,1.5,-0.3,79.0,,,0.01,22,
";

const TOML: &str = "\
name = \"Test\"
kind = \"digitised\"
source = \"by hand\"
gravity_m_s2 = 1.62
[wheel]
radius_m = 0.15
width_m = 0.16
grouser_height_m = 0.005
grouser_count = 24
[soil]
n = { value = 1.1, std = 0.05 }
k_c = { value = 16.0e3, std = 3.0e3 }
k_phi = { value = 2.4e6, std = 0.4e6 }
c = { min = 0.0, max = 500.0 }
phi = { value = 0.55, std = 0.03 }
K = 0.012
[noise]
drawbar_pull_n = 0.5
camera_c = 0.1
[declared]
effects = [\"slip-sinkage\", \"rear-contact\"]
[declared.slip-sinkage]
n1 = 0.3
";

const PLAIN: &str = "name = \"T\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.15\nwidth_m = 0.1\n";

fn parse(csv: &str, toml: &str) -> Result<Campaign, String> {
    Campaign::parse(Path::new("test.csv"), csv, toml).map_err(|error| error.to_string())
}

#[test]
fn everything_that_the_format_names_is_read() {
    let campaign = parse(CSV, TOML).expect("a good campaign");
    assert_eq!(campaign.name, "Test");
    assert_eq!(campaign.provenance, Provenance::Digitised);
    assert_eq!(campaign.gravity_m_s2, 1.62);
    assert_eq!((campaign.wheel.radius_m, campaign.wheel.width_m), (0.15, 0.16));
    assert_eq!((campaign.grousers.height_m, campaign.grousers.count), (0.005, 24));
    assert_eq!(campaign.ground.shear_modulus_m, Some(Knowledge::Value { value: 0.012, std: 0.0 }));
    assert_eq!(campaign.ground.cohesion_pa, Some(Knowledge::Between { min: 0.0, max: 500.0 }));
    assert_eq!(campaign.ground.rebound_ratio, None);
    // 16 kPa/m^0.1 over 0.16 m are 0.1 MPa/m^1.1; the deviations are 18.75 kPa and 400 kPa.
    let stiffness = campaign.ground.stiffness(&campaign.wheel).expect("k_c and k_phi are there");
    assert!((stiffness.middle() - 2.5e6).abs() < 1.0, "{stiffness:?}");
    assert!((stiffness.range().1 - 2.5e6 - 400_439.2).abs() < 1.0, "{stiffness:?}");
    assert_eq!(campaign.noise.of(Channel::DrawbarPull), Some(0.5));
    assert_eq!(campaign.noise.of_column("camera_c"), Some(0.1));
    assert_eq!(campaign.noise.of(Channel::Torque), None);
    assert_eq!(campaign.declared.ids(), ["slip-sinkage", "rear-contact"]);
    assert_eq!(campaign.declared.effects[0].known.get("n1"), Some(&Knowledge::Value { value: 0.3, std: 0.0 }));
}

#[test]
fn columns_of_numbers_are_kept_and_empty_fields_are_not_measured() {
    let campaign = parse(CSV, TOML).expect("a good campaign");
    assert_eq!(campaign.column("camera_c"), Some(&[Some(21.5), None, Some(22.0)][..]));
    assert_eq!(campaign.column("note"), None, "text is no measurement");
    assert_eq!(campaign.value(1, Channel::Sinkage), None);
    assert_eq!(campaign.value(2, Channel::Slip), Some(-0.3));
    let runs: Vec<_> = campaign.runs();
    assert_eq!(runs, [("a", vec![0, 1]), ("b", vec![2])]);
    assert_eq!((campaign.rows()[2].t_s, campaign.rows()[2].line), (1.5, 4));
}

#[test]
fn a_remark_may_be_a_number_but_a_number_no_remark() {
    let remarks = parse(&CSV.replace(",first", ",wet").replace("second", "2").replace("22,\n", "22,dry\n"), TOML)
        .expect("a remark more");
    assert_eq!(remarks.column("note"), None, "two of three remarks are text");
    let error = parse(&CSV.replace("21.5", "warm"), TOML).expect_err("no temperature");
    assert!(error.starts_with("test.csv:2:8: camera_c: `warm`"), "{error}");
}

#[test]
fn only_name_kind_and_wheel_must_be_said() {
    let toml = "name = \"x\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.1\nwidth_m = 0.1\n";
    let campaign = parse(CSV, toml).expect("enough");
    assert_eq!(campaign.gravity_m_s2, 9.81);
    assert!(campaign.declared.effects.is_empty() && campaign.ground.stiffness(&campaign.wheel).is_none());
}

/// Replaces a piece of a good file, and gives the error.
fn broken(file: &str, good: &str, bad: &str) -> String {
    let (mut csv, mut toml) = (CSV.to_owned(), TOML.to_owned());
    let text = if file == "csv" { &mut csv } else { &mut toml };
    assert!(text.contains(good), "the test must change something");
    *text = text.replacen(good, bad, 1);
    parse(&csv, &toml).expect_err("a mistake")
}

#[test]
fn mistakes_in_the_table_are_told_by_line_and_column() {
    let cases = [
        ("a,0,0.2,80.0", "a,0,1.2,80.0", "test.csv:3:3: slip: `1.2`: expected a slip from −1 to 1"),
        ("a,0,0.2,80.0", "a,0,x,80.0", "test.csv:3:3: slip: `x`: expected a finite number"),
        ("80.0,11.0", "inf,11.0", "test.csv:2:4: load_n: `inf`: expected a finite number"),
        ("a,0,0.2", ",0,0.2", "test.csv:3:1: run: nothing here: expected the name of the run"),
        ("a,0,0.2", "a,,0.2", "test.csv:3:2: t_s: nothing here: expected the time"),
        ("22,\n", "cold,\n", "test.csv:4:8: camera_c: `cold`: expected a finite number"),
        ("22,\n", "22\n", "test.csv:4:9: 8 fields in this row: expected 9"),
        ("run,", "walk,", "test.csv:1:1: no column `run`"),
        ("t_s,", "time,", "test.csv:1:1: no column `t_s`"),
        ("run,", "# wheel 3\nrun,", "test.csv:1:1: remarks: expected the names of the columns"),
        ("camera_c", "slip", "test.csv:1:8: a second column is named `slip`"),
    ];
    for (good, bad, message) in cases {
        let error = broken("csv", good, bad);
        assert!(error.starts_with(message), "{error}\n  should begin with\n{message}");
    }
    let header = CSV.lines().next().expect("a header");
    assert!(parse(header, TOML).expect_err("no rows").starts_with("test.csv:1:1: no rows"));
    assert!(parse("", TOML).expect_err("empty").starts_with("test.csv:1:1: the file is empty"));
}

#[test]
fn what_a_description_says_besides_does_not_matter() {
    let more = TOML.replace("source =", "date = 2024-05-17\noperator = \"NN\"\nsource =") + "[truth]\nphi = 0.5\n";
    let campaign = parse(CSV, &more).expect("a campaign whose file says more");
    let plain = parse(CSV, TOML).expect("a good campaign");
    assert_eq!((campaign.gravity_m_s2, campaign.notes), (plain.gravity_m_s2, plain.notes));
    for (notes, expected) in [("\"wet\"", vec!["wet"]), ("[\"wet\", \"cold\"]", vec!["wet", "cold"])] {
        let noted = TOML.replace("source =", &format!("notes = {notes}\nsource ="));
        assert_eq!(parse(CSV, &noted).expect("a campaign with notes").notes, expected);
    }
}

#[test]
fn mistakes_in_the_description_are_told_by_line_and_column() {
    let cases = [
        ("\"digitised\"", "\"guessed\"", "test.toml:2:8: unknown variant `guessed`, expected one of `measured`"),
        ("name = \"Test\"\n", "", "test.toml:1:1: missing field `name`"),
        ("[wheel]", "[wheels]", "test.toml:5:2: unknown field `wheels`"),
        ("gravity_m_s2", "gravity", "test.toml:4:1: unknown field `gravity`: is `gravity_m_s2` meant?"),
        ("source =", "k_phi = 2.4e6\nsource =", "test.toml:3:1: unknown field `k_phi`: is `k_phi` of a table meant?"),
        ("radius_m = 0.15", "radius_m = 0.15\ncolour = 1", "test.toml:7:1: unknown field `colour`"),
        ("source =", "notes =  7\nsource =", "test.toml:3:10: expected a text or a list of texts"),
        ("radius_m = 0.15", "radius_m = -0.15", "test.toml:6:12: radius_m = -0.15: expected a length above 0 m"),
        ("radius_m = 0.15", "radius_m = \"wide\"", "test.toml:6:12: invalid type: string"),
        ("gravity_m_s2 = 1.62", "gravity_m_s2 = 0.0", "test.toml:4:16: gravity_m_s2 = 0: expected a number above 0"),
        ("std = 0.05", "std = -1.0", "test.toml:11:5: n: std = -1: expected a standard deviation of 0 or more"),
        ("std = 0.05", "sigma = 0.05", "test.toml:11:5: expected a number, { value"),
        ("max = 500.0", "max = -1.0", "test.toml:14:5: c: min = 0, max = -1: expected min below max"),
        ("value = 0.55,", "value = 31.9,", "test.toml:15:7: phi = 31.9: expected a number from 0 to 1.5708"),
        ("K = 0.012", "K = nan", "test.toml:16:5: K = NaN: expected a finite number"),
        ("K = 0.012", "k_eff = 2.0e6", "test.toml:16:9: k_eff beside k_c or k_phi"),
        ("drawbar_pull_n = 0.5", "drawbar = 0.5", "test.toml:18:1: no channel `drawbar`"),
        ("camera_c = 0.1", "camera_c = -0.1", "test.toml:19:12: camera_c = -0.1: expected a standard deviation"),
        ("\"rear-contact\"", "\"rear\"", "test.toml:21:28: no effect `rear`: expected one of slip-sinkage"),
        (
            "effects = [\"slip-sinkage\", \"rear-contact\"]",
            "effects = []",
            "test.toml:22:11: parameters of slip-sinkage",
        ),
        ("n1 = 0.3", "n1 = \"x\"", "test.toml:23:6: n1: a text: expected a number"),
        ("n1 = 0.3", "n1 = 9.0", "test.toml:23:6: n1 = 9: expected a number from -0.5 to 2"),
        ("n1 = 0.3", "n9 = 0.3", "test.toml:23:1: no parameter `n9` of slip-sinkage: expected n1"),
        ("n1 = 0.3", "form = \"x\"", "test.toml:23:8: no form `x` of slip-sinkage: expected one of exponent"),
        ("kind =", "kind", "test.toml:2:"),
    ];
    for (good, bad, message) in cases {
        let error = broken("toml", good, bad);
        assert!(error.starts_with(message), "{error}\n  should begin with\n{message}");
        assert!(!error.contains('\n'), "one line: {error}");
    }
}

#[test]
fn a_campaign_without_its_description_names_the_file_that_is_expected() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("alone.csv");
    std::fs::write(&path, CSV).expect("written");
    let error = Campaign::read(&path).expect_err("no description").to_string();
    assert!(error.contains("alone.toml: no such file"), "{error}");
}

#[test]
fn a_gross_error_is_told_from_other_units() {
    let row = |pull: &str| format!("a,0,0.2,80.0,{pull},4.2,0.006\n");
    let table = |pulls: &[&str]| {
        let rows: String = pulls.iter().map(|pull| row(pull)).collect();
        format!("{COLUMNS}\n{rows}")
    };
    let toml = TOML.replace("camera_c = 0.1\n", "");
    // A locked wheel feels twice its load; no wheel feels a meganewton.
    let campaign = parse(&table(&["14.5", "1e6", "-150", "13"]), &toml).expect("one gross error among four");
    let gross: Vec<bool> = (0..4).map(|row| campaign.gross_error(row).is_some()).collect();
    assert_eq!(gross, [false, true, false, false]);
    // Newtons in the load and millinewtons in the pull.
    let error = parse(&table(&["14500", "1300", "1250"]), &toml).expect_err("most of a column beyond what can be");
    assert!(error.starts_with("test.csv:2:5: drawbar_pull_n of 14500 N"), "{error}");
    assert!(error.ends_with("expected newtons, newton-metres and metres, or load_n in newtons"), "{error}");
    // Newtons in the pull and kilonewtons in the load; no load says what a sinkage is in.
    let error = parse(&table(&["14.5", "13"]).replace("80.0", "0.08"), &toml).expect_err("pulls beyond such a load");
    assert!(error.starts_with("test.csv:2:5: drawbar_pull_n of 14.5 N"), "{error}");
    assert!(error.ends_with(", or load_n in newtons"), "{error}");
    let error = parse(&table(&["14.5", "13"]).replace("0.006", "6"), &toml).expect_err("millimetres");
    assert!(error.ends_with("expected newtons, newton-metres and metres"), "{error}");
    // A load of the other sign, in one row and in all.
    let lifted = parse(&table(&["14.5", "13"]).replacen("80.0", "-80.0", 1), &toml).expect("one of two");
    assert!(lifted.gross_error(0).is_some() && lifted.gross_error(1).is_none());
    let error = parse(&table(&["14.5", "13"]).replace("80.0", "-80.0"), &toml).expect_err("all of them");
    assert!(error.starts_with("test.csv:2:4: load_n of -80 N") && error.contains("a load is above 0"), "{error}");
}

/// A standard deviation is no bound, beside bounds of the other modulus either; and the cohesive modulus alone says nothing of the stiffness.
#[test]
fn a_modulus_with_a_standard_deviation_stays_one() {
    let stiffness = |moduli: &str| {
        let campaign = parse(CSV, &format!("{PLAIN}[soil]\n{moduli}")).expect("a campaign");
        (campaign.ground.stiffness(&campaign.wheel), campaign.remarks())
    };
    let (known, _) = stiffness("k_c = { min = -12e3, max = 12e3 }\nk_phi = { value = 7e5, std = 1e5 }\n");
    let Some(Knowledge::Value { value, std }) = known else { panic!("{known:?}") };
    // 24 kPa/m^(n-1) over 0.1 m is a range of 240 kPa, with a standard deviation of 69.3 kPa.
    assert!((value - 7e5).abs() < 1.0 && (std - 1.0e5_f64.hypot(69_282.0)).abs() < 1.0, "{value} ± {std}");
    let (between, _) = stiffness("k_c = { min = 0, max = 12e3 }\nk_phi = 7e5\n");
    assert_eq!(between, Some(Knowledge::Between { min: 7e5, max: 8.2e5 }));
    let (unknown, remarks) = stiffness("k_c = 12e3\n");
    assert!(unknown.is_none() && remarks[0].contains("expected k_phi beside it"), "{remarks:?}");
}

/// A logger at ten times the rate of its sensors: what they read once stands there once, whatever the clock says.
#[test]
fn rows_that_only_repeat_their_sensors_are_left_out() {
    let readings = ["0.2,80.0,11.0,4.2,0.006", "0.3,81.0,11.5,4.3,0.006", "0.3,80.0,11.0,4.2,0.006"];
    let logged = |times: usize| {
        let row = |place: usize| format!("a,{place},{}\n", readings[place / times]);
        let rows: String = (0..readings.len() * times).map(row).collect();
        parse(&format!("{COLUMNS}\n{rows}"), PLAIN).expect("a campaign")
    };
    let [once, often] = [logged(1), logged(10)];
    assert!(once.remarks().is_empty());
    assert!(often.remarks()[0].starts_with("27 rows"));
    assert_eq!(often.rows().iter().map(|row| row.line).collect::<Vec<_>>(), [2, 12, 22]);
    assert_eq!(once.column("slip"), often.column("slip"));
}

/// The same with two wheels at each instant.
#[test]
fn a_wheel_that_repeats_itself_beside_another_is_left_out() {
    let wheels = ["0.2,80.0,11.0,4.2,0.006", "0.3,81.0,11.5,4.3,0.006"];
    let rows: String = (0..40).map(|row| format!("a,{},{}\n", row / 2, wheels[row % 2])).collect();
    let campaign = parse(&format!("{COLUMNS}\n{rows}"), PLAIN);
    assert_eq!(campaign.expect("a campaign").rows().len(), 2);
}

/// Rows of one time are different wheels: those of two sides without noise say the same, in whatever order they stand.
#[test]
fn wheels_of_one_instant_that_are_alike_stay() {
    let wheels = ["0.2,80.0,11.0,4.2,0.006", "0.3,81.0,11.5,4.3,0.006", "0.4,79.0,11.8,4.4,0.007"];
    for order in [[0, 0, 1, 1, 2, 2], [0, 1, 2, 0, 1, 2]] {
        let rows: String = order.iter().map(|wheel| format!("a,0,{}\n", wheels[*wheel])).collect();
        let campaign = parse(&format!("{COLUMNS}\n{rows}"), PLAIN);
        let campaign = campaign.expect("a campaign");
        assert_eq!((campaign.rows().len(), campaign.remarks()), (6, vec![]));
    }
}

/// Two numbers of few digits agree by chance, and another run is another wheel on another ground.
#[test]
fn rows_that_agree_in_little_or_stand_in_another_run_stay() {
    let cases = [
        "run,t_s,slip,sinkage_m\na,0,0.2,0.006\na,1,0.2,0.006\na,2,0.3,0.007\n",
        "run,t_s,slip,load_n,sinkage_m\na,0,0.2,80,0.006\nb,0,0.2,80,0.006\nc,0,0.3,81,0.007\n",
    ];
    for csv in cases {
        let campaign = parse(csv, PLAIN).expect("a campaign");
        assert_eq!((campaign.rows().len(), campaign.remarks()), (3, vec![]));
    }
}

/// What would be no channel without a word: a letter missing, or another unit.
#[test]
fn a_column_that_is_nearly_a_channel_is_told() {
    let remarks = |header: &str| {
        parse(&format!("{header}\na,0,0.2,11,4.2\nb,0,0.3,11.5,4.3\n"), PLAIN).expect("a campaign").remarks()
    };
    let said = remarks("run,t_s,slip,drawbar_pul_n,sinkage_mm");
    assert!(said[0].contains("`drawbar_pul_n` and none `drawbar_pull_n`"), "{said:?}");
    assert!(said[1].contains("`sinkage_mm` and none `sinkage_m`"), "{said:?}");
    assert!(remarks("run,t_s,slip,drawbar_pull_n,humidity").is_empty());
    assert!(remarks("run,t_s,slip,load_n,load_sd_n").is_empty(), "the load itself is there");
}

/// Two tables put together that share a part: its runs come once more under other names, and are no new ones.
#[test]
fn a_run_that_says_what_another_says_is_its_copy() {
    let readings = ["0.2,80.0,11.0,4.2,0.006", "0.3,81.0,11.5,4.3,0.006", "0.4,79.0,11.8,4.4,0.007"];
    let run = |name: &str, begins: usize, count: usize| -> String {
        (0..count).map(|row| format!("{name},{},{}\n", begins + row, readings[row])).collect()
    };
    let rows = [run("a", 0, 3), run("b", 50, 3), run("c", 0, 2), run("d", 0, 2)].concat();
    let campaign = parse(&format!("{COLUMNS}\n{rows}"), PLAIN);
    let copies = [vec![false; 3], vec![true; 3], vec![false; 4]].concat();
    let campaign = campaign.expect("a campaign");
    assert_eq!(campaign.copies(), copies, "ten numbers: chance");
    assert_eq!(campaign.with_a_run_for_each_row().copies(), copies, "whatever is done with its rows");
}
