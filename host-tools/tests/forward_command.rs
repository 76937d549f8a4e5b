//! `kapvik forward` as a person runs it.

mod kapvik;
mod refused;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use kapvik::kapvik;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use refused::refused;
use tempfile::TempDir;

const WHEEL: &str = "radius_m = 0.075\nwidth_m = 0.070\n";
const SOIL: &str = "n = 1.1\nk_c = 15600.0\nk_phi = 2407400.0\nc = 250.0\nphi = 0.5567600313861911\nK = 0.0114\nc1 = 0.18\nc2 = 0.32\n";

/// A folder with the files of one run.
struct Run {
    folder: TempDir,
}

impl Run {
    fn new(wheel: impl AsRef<[u8]>, soil: impl AsRef<[u8]>, rows: impl AsRef<[u8]>) -> Self {
        let run = Self { folder: tempfile::tempdir().expect("a folder") };
        fs::write(run.path("w.toml"), wheel).expect("written");
        fs::write(run.path("s.toml"), soil).expect("written");
        fs::write(run.path("in.csv"), rows).expect("written");
        run
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self) -> Command {
        let mut command = kapvik();
        command.current_dir(self.folder.path());
        command.args(["forward", "--wheel", "w.toml", "--soil", "s.toml", "in.csv", "-o", "out.csv"]);
        command
    }

    fn run(&self, more: &[&str]) -> Output {
        self.command().args(more).output().expect("kapvik runs")
    }

    /// The output of a run that succeeds, as lines of fields.
    fn rows(&self, more: &[&str]) -> Vec<Vec<String>> {
        let output = self.run(more);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = fs::read_to_string(self.path("out.csv")).expect("written");
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    }

    /// The one line that a run that fails says.
    fn refusal(&self) -> String {
        let output = refused(&mut self.command(), &[]);
        let said = String::from_utf8(output.stderr).expect("text");
        assert!(!said.contains("panicked"), "{said}");
        said
    }
}

fn number(text: &str) -> f64 {
    text.parse().expect("a number")
}

#[test]
fn rows_are_completed_and_all_else_is_kept() {
    let rows = Run::new(WHEEL, SOIL, "note,slip,load_n,\"x\"\n a , 0.20 ,65.40,007\n,0.4,65.4,1e-3\n").rows(&[]);
    assert_eq!(rows[0].join(","), "note,slip,load_n,x,drawbar_pull_n,torque_nm,sinkage_m");
    assert_eq!(rows[1][..4], [" a ", " 0.20 ", "65.40", "007"]);
    // The table of a Kapvik-sized wheel at slips of 0.2 and 0.4, computed with SciPy.
    for (row, expected) in [(1, [2.09, 1.62, 0.0181]), (2, [6.55, 2.02, 0.0185])] {
        for (found, expected) in rows[row][4..].iter().zip(expected) {
            assert!((number(found) / expected - 1.0).abs() < 0.01, "{:?}", rows[row]);
        }
    }
}

#[test]
fn blanks_around_names_are_no_part_of_them() {
    let rows = Run::new(WHEEL, SOIL, "note, slip , load_n\na, 0.20, 65.40\n").rows(&[]);
    assert_eq!(rows[0].join(","), "note,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m");
    assert!((number(&rows[1][3]) / 2.09 - 1.0).abs() < 0.01, "{:?}", rows[1]);
}

#[test]
fn numbers_read_back_and_lead_back() {
    let by_load = Run::new(WHEEL, SOIL, "slip,load_n\n0.3,65.4\n").rows(&[]);
    let sinkage = &by_load[1][4];
    let by_sinkage = Run::new(WHEEL, SOIL, format!("slip,sinkage_m\n0.3,{sinkage}\n")).rows(&[]);
    assert_eq!(by_sinkage[0].join(","), "slip,sinkage_m,drawbar_pull_n,load_n,torque_nm");
    assert_eq!(by_sinkage[1][2], by_load[1][2], "the same pull from the same sinkage, to the bit");
    assert!((number(&by_sinkage[1][3]) / 65.4 - 1.0).abs() < 1e-10);
}

#[test]
fn sinkage_decides_where_both_are_given() {
    let both = Run::new(WHEEL, SOIL, "slip,load_n,sinkage_m,torque_nm\n0.3,1.0,0.018,9\n").rows(&[]);
    let one = Run::new(WHEEL, SOIL, "slip,sinkage_m\n0.3,0.018\n").rows(&[]);
    assert_eq!(both[1][2], "0.018");
    assert_eq!([&both[1][4], &both[1][1], &both[1][3]], [&one[1][2], &one[1][3], &one[1][4]]);
}

#[test]
fn single_precision_is_near_and_shorter() {
    let single = Run::new(WHEEL, SOIL, "slip,sinkage_m\n0.3,0.018\n").rows(&["--precision", "f32"]);
    let double = Run::new(WHEEL, SOIL, "slip,sinkage_m\n0.3,0.018\n").rows(&["--precision", "f64"]);
    for (single, double) in single[1][2..].iter().zip(&double[1][2..]) {
        assert!((number(single) / number(double) - 1.0).abs() < 1e-4 && single != double, "{single} {double}");
        assert_eq!(single.parse::<f32>().expect("a number").to_string(), *single);
    }
}

#[test]
fn campaign_files_and_ways_to_give_a_soil_are_taken() {
    let plain = Run::new(WHEEL, SOIL, "slip,sinkage_m\n0.3,0.018\n").rows(&[]);
    let campaign = format!(
        "name = \"a\"\n[wheel]\nradius_m = 0.075\nwidth_m = 0.07\ngrouser_height_m = 0.005\ngrouser_count = 24\n\
         [soil]\n{}[noise]\nload_n = 1.0\n",
        SOIL.replace("n = 1.1\n", "n = { value = 1.1, std = 0.1 }\n")
            .replace("c2 = 0.32", "c2 = { value = 0.32 }\neta = 0")
    );
    assert_eq!(Run::new(&campaign, &campaign, "slip,sinkage_m\n0.3,0.018\n").rows(&[]), plain);
    let k_eff = SOIL.replace("k_c = 15600.0\nk_phi = 2407400.0", &format!("k_eff = {}", 15600.0 / 0.070 + 2_407_400.0));
    let by_k_eff = Run::new(WHEEL, k_eff, "slip,sinkage_m\n0.3,0.018\n").rows(&[]);
    assert!((number(&by_k_eff[1][2]) / number(&plain[1][2]) - 1.0).abs() < 1e-12);
}

#[test]
fn what_editors_do_to_files_is_taken() {
    let plain = Run::new(WHEEL, SOIL, "slip,sinkage_m\n0.3,0.018\n").rows(&[]);
    let dressed = |text: &str| format!("\u{feff}{}", text.replace('\n', "\r\n"));
    let rows =
        Run::new(dressed(WHEEL), dressed(SOIL), dressed("\"slip\",\"sinkage_m\"\n\"0.3\",\"0.018\"\n")).rows(&[]);
    assert_eq!(rows, plain);
    assert_eq!(Run::new(WHEEL, SOIL, "slip,sinkage_m\n").rows(&[])[0].len(), 5, "no rows: the header alone");
}

#[test]
fn quoted_fields_stay_whole() {
    let run = Run::new(WHEEL, SOIL, "a,slip,sinkage_m\n\"one, \"\"two\"\"\nthree\",0.3,0.018\n");
    assert!(run.run(&[]).status.success());
    let text = fs::read_to_string(run.path("out.csv")).expect("written");
    assert!(text.contains("\n\"one, \"\"two\"\"\nthree\",0.3,0.018,"), "{text}");
}

#[test]
fn an_output_that_is_there_survives_a_refusal() {
    let run = Run::new(WHEEL, SOIL, "slip,load_n\n0.2,1e9\n");
    fs::write(run.path("out.csv"), "before").expect("written");
    assert!(!run.run(&[]).status.success());
    assert_eq!(fs::read_to_string(run.path("out.csv")).expect("readable"), "before");
}

/// Tables that are refused, and what the one line on the error stream starts with.
#[test]
fn tables_that_are_wrong_are_refused_by_line_and_column() {
    let cases: [(&[u8], &str); 23] = [
        (b"", "in.csv:1:1: the file is empty"),
        (b"\n\n", "in.csv:1:1: the file is empty"),
        (b"load_n\n65\n", "in.csv:1:1: no column `slip`"),
        (b"slip\n0.2\n", "in.csv:1:1: no column `sinkage_m` or `load_n`: expected one in the header (found slip)"),
        (
            b"slip,load_N\n0.2,65\n",
            "in.csv:1:1: no column `sinkage_m` or `load_n`: expected one in the header (found slip, load_N). The table has a column `load_N` \
             and none `load_n`",
        ),
        (
            b"slip_1,load_n\n0.2,65\n",
            "in.csv:1:1: no column `slip`: expected one in the header (found slip_1, load_n). The table has a column `slip_1`",
        ),
        (b"slip,load_n,slip\n0.2,65,0.3\n", "in.csv:1:3: a second column is named `slip`"),
        (b"slip,,load_n\n0.2,65,0.3\n", "in.csv:1:2: this column has no name"),
        (b"slip,load_n\n0.2,65\n,65\n", "in.csv:3:1: slip: empty"),
        (b"slip,load_n\n0.2,\n", "in.csv:2:2: load_n: empty"),
        (b"x,slip,load_n\n1,fast,65\n", "in.csv:2:2: slip: `fast`"),
        (b"slip,load_n\n0.2,1e999\n", "in.csv:2:2: load_n: `1e999`"),
        (b"slip,load_n\n0.2,nan\n", "in.csv:2:2: load_n: `nan`"),
        (b"slip,load_n\n1.2,65\n", "in.csv:2:1: slip: 1.2"),
        (b"slip,sinkage_m\n0.2,0.08\n", "in.csv:2:2: sinkage_m: 0.08"),
        (b"slip,sinkage_m\n0.2,-1e-9\n", "in.csv:2:2: sinkage_m: -1e-9"),
        (b"slip,load_n\n0.2,0\n", "in.csv:2:2: load_n: 0.0: expected a load above 0 N"),
        (
            b"slip,load_n\n0.2,65\n0.2,900\n",
            "in.csv:3:2: load_n: this soil does not carry 900.0 N at slip 0.2: expected at most about 580.7 N (down to a sinkage of 0.0675 m)",
        ),
        (b"slip,load_n\r\n0.2,65\r\n\r\n0.2,65,1\r\n", "in.csv:4:3: 3 fields in this row"),
        (b"slip,load_n\n0.2\n", "in.csv:2:2: 1 fields in this row"),
        (b"slip,load_n\n0.2,6\xff5\n", "in.csv:2:2: this byte is not UTF-8"),
        (b"slip,load_n\n0.2,\"65\n", "in.csv:2:2: a quote is not closed"),
        (b"slip,load_n\n0.2,65\r0.3,65\n", "in.csv:2:2: a line ends in a carriage return alone"),
    ];
    for (rows, expected) in cases {
        let said = Run::new(WHEEL, SOIL, rows).refusal();
        assert!(said.starts_with(&format!("kapvik: {expected}")), "{said}");
    }
}

/// Wheels and soils that are refused.
#[test]
fn descriptions_that_are_wrong_are_refused_by_line_and_column() {
    let wheels: [(&[u8], &str); 7] = [
        (b"radius_m = 0.075\n", "missing field `width_m`"),
        (b"radius_m = 0.075\nwidth_m = 0.07\nwidht_m = 1\n", "w.toml:3:1: unknown field `widht_m`"),
        (b"radius_m = 0\nwidth_m = 0.07\n", "w.toml:1:12: radius_m = 0"),
        (b"radius_m = 0.075\nwidth_m = inf\n", "w.toml:2:11: width_m = inf"),
        (b"radius_m = \"big\"\nwidth_m = 0.07\n", "w.toml:1:12: invalid type"),
        (b"radius_m = = 1\n", "w.toml:1:12: "),
        (b"[wheel]\nradius_m = 0.075\nwidth_m = 0.07\ncolour = 1\n", "w.toml:4:1: unknown field `colour`"),
    ];
    for (wheel, expected) in wheels {
        let said = Run::new(wheel, SOIL, "slip,load_n\n").refusal();
        assert!(said.starts_with("kapvik: w.toml:") && said.contains(expected), "{said}");
    }
    let soils = [
        (SOIL.replace("k_phi = 2407400.0\n", ""), "s.toml:1:1: k_phi is missing"),
        (SOIL.replace("c1 = 0.18\n", ""), "s.toml:1:1: c1 is missing"),
        (SOIL.replace("K = 0.0114\n", ""), "s.toml:1:1: K is missing"),
        (format!("[note]\n[soil]\n{}", SOIL.replace("K = 0.0114\n", "")), "s.toml:2:1: K is missing"),
        (
            SOIL.replace("phi = 0.5567600313861911", "phi = 31.9"),
            "s.toml:5:7: phi = 31.9: expected a number from 0 to 1.5708",
        ),
        (SOIL.replace("n = 1.1", "n = { min = 1.0, max = 1.2 }"), "s.toml:1:5: n = 1 … 1.2: expected one value"),
        (SOIL.replace("n = 1.1", "n = nan"), "s.toml:1:5: n = NaN: expected a finite number"),
        (SOIL.replace("n = 1.1", "n = { value = 1.1, sdt = 1 }"), "s.toml:1:5: expected a number"),
        (SOIL.replace("K = ", "k = "), "s.toml:6:1: unknown field `k`"),
        (format!("{SOIL}k_eff = 1e6\n"), "s.toml:9:9: k_eff beside"),
        (format!("{SOIL}n = 1\n"), "s.toml:9:1: duplicate key"),
        (format!("[soil]\n{SOIL}kphi = 1\n"), "s.toml:10:1: unknown field `kphi`"),
    ];
    for (soil, expected) in soils {
        let said = Run::new(WHEEL, &soil, "slip,load_n\n").refusal();
        assert!(said.starts_with(&format!("kapvik: {expected}")), "{soil}\n{said}");
    }
}

/// Files with bytes struck out, doubled and changed at random end in a table or in a refusal, never in a panic.
#[test]
fn damaged_files_never_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut damaged = |text: &str| {
        let mut bytes = text.as_bytes().to_vec();
        for _ in 0..random.random_range(1..4) {
            let place = random.random_range(0..bytes.len());
            match random.random_range(0..3) {
                0 => drop(bytes.remove(place)),
                1 => bytes.insert(place, bytes[place]),
                _ => bytes[place] = random.random(),
            }
        }
        bytes
    };
    let rows = "run,slip,load_n,sinkage_m\n\"a, b\",0.2,65.4,\nc,-0.3,,0.018\n";
    for _ in 0..100 {
        let (wheel, soil, rows) = (damaged(WHEEL), damaged(SOIL), damaged(rows));
        for run in [Run::new(&wheel, SOIL, rows.as_slice()), Run::new(WHEEL, &soil, "slip,load_n\n0.2,65.4\n")] {
            let output = run.run(&[]);
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(matches!(output.status.code(), Some(0 | 1)) && said.lines().count() <= 1, "{said}");
            assert_eq!(output.status.success(), run.path("out.csv").exists(), "{said}");
        }
    }
}
