//! What tells one campaign's measurements from another's, whatever both are called.

use std::fmt;

use kapvik_firmware::checksum::Checksum;
use serde::{Deserialize, Serialize};

use super::Campaign;

/// The measurements of a campaign in a few numbers: the same for the same runs, times and columns of numbers, in whatever order
/// the columns stand and however the numbers are written. What the description says of them is no part of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fingerprint {
    /// Runs.
    pub runs: usize,
    /// Rows.
    pub rows: usize,
    /// CRC-32 of all of it, in hexadecimal digits.
    pub hash: String,
}

impl Fingerprint {
    /// That of a campaign.
    pub fn of(campaign: &Campaign) -> Self {
        let mut hash = Checksum::new();
        for row in &campaign.rows {
            add_text(&mut hash, &row.run);
            add_number(&mut hash, row.t_s);
        }
        let mut columns: Vec<_> = campaign.columns.iter().collect();
        columns.sort_by(|a, b| a.name.cmp(&b.name));
        for column in columns {
            add_text(&mut hash, &column.name);
            // No column holds a number that is not finite.
            column.values.iter().for_each(|value| add_number(&mut hash, value.unwrap_or(f64::NAN)));
        }
        Self { runs: campaign.runs().len(), rows: campaign.rows.len(), hash: format!("{:08x}", hash.finish()) }
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { runs, rows, hash } = self;
        write!(formatter, "{rows} rows in {runs} runs with the fingerprint {hash}")
    }
}

/// A text and its end, so that two are not the same as one.
fn add_text(hash: &mut Checksum, text: &str) {
    hash.add(text.as_bytes());
    hash.add(&[0]);
}

/// A number by its value: zero has one, of whichever sign.
fn add_number(hash: &mut Checksum, number: f64) {
    hash.add(&(number + 0.0).to_bits().to_le_bytes());
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn fingerprint(csv: &str) -> Fingerprint {
        let toml = "name = \"sand\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.075\nwidth_m = 0.07\n";
        Fingerprint::of(&Campaign::parse(Path::new("sand.csv"), csv, toml).expect("a campaign"))
    }

    const CSV: &str = "run,t_s,slip,load_n,torque_nm\na,0,0.1,65,1.2\nb,0,0.2,65,\n";

    #[test]
    fn the_order_of_columns_and_the_way_numbers_are_written_make_no_other_campaign() {
        let other = "t_s,torque_nm,run,load_n,slip\n0,1.20,a,65.0,1e-1\n-0,,b,65,0.2\n";
        assert_eq!(fingerprint(CSV), fingerprint(other));
        assert_eq!((fingerprint(CSV).runs, fingerprint(CSV).rows), (2, 2));
    }

    #[test]
    fn another_number_run_or_column_makes_another() {
        let change = |from: &str, to: &str| fingerprint(&CSV.replacen(from, to, 1));
        for (from, to) in
            [("1.2", "1.3"), ("b,0", "a,0"), ("b,0", "b,1"), ("torque_nm", "drawbar_pull_n"), ("65,\n", "65,0\n")]
        {
            assert_ne!(fingerprint(CSV), change(from, to), "{from} to {to}");
        }
    }
}
