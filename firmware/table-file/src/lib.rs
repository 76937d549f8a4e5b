//! The file that carries a frozen network from the trainer to the flight image.
//!
//! Text, so that a change shows in review; every number as the eight hexadecimal digits of its 32 bits, so that nothing
//! is rounded; a CRC-32 over all before it, so that nothing changes unseen.
//!
//! ```text
//! kapvik-frozen-table
//! version 3
//! note seed: 1
//! block wheel.network 12 16 16 6 : 2
//! 3f800000 bf800000
//! crc32 89abcdef
//! ```

use std::fmt::Write as _;

use thiserror::Error;

/// The version that this crate reads and writes.
pub const VERSION: u32 = 3;

const MAGIC: &str = "kapvik-frozen-table";
const CHECKSUM: &str = "crc32 ";
/// Numbers on a line.
const COLUMNS: usize = 8;

/// The content of a file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TableFile {
    /// Keys and values for people: provenance, priors, noise, effects.
    pub notes: Vec<(String, String)>,
    /// The numbers.
    pub blocks: Vec<Block>,
}

/// Numbers that belong together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Name, without spaces.
    pub name: String,
    /// Layer sizes of a network; empty where there is nothing but a list.
    pub shape: Vec<usize>,
    /// The 32 bits of each number, in single precision or whole, or of two whole numbers of 16 bits.
    pub words: Vec<u32>,
}

/// Why a file was not accepted.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum TableError {
    /// The checksum line is not there or not whole.
    #[error("the frozen table is truncated: it does not end in a line `crc32 …`")]
    Truncated,
    /// The checksum does not fit.
    #[error("the frozen table was altered: its CRC-32 is {found:08x}, its last line says {expected:08x}")]
    Altered {
        /// What the last line says.
        expected: u32,
        /// What the bytes give.
        found: u32,
    },
    /// Another version of the format.
    #[error("the frozen table is of version {found}, this build reads version {VERSION}")]
    Version {
        /// What the file says.
        found: String,
    },
    /// The checksum fits, but the text is not a table.
    #[error("line {line} of the frozen table: expected {expected}")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// What should stand there.
        expected: &'static str,
    },
}

/// CRC-32 (ISO-HDLC) of the bytes given. In a file these are all before the last line.
pub fn checksum(bytes: &[u8]) -> u32 {
    static CRC: crc::Crc<u32, crc::Table<16>> = crc::Crc::<u32, crc::Table<16>>::new(&crc::CRC_32_ISO_HDLC);
    CRC.checksum(bytes)
}

impl TableFile {
    /// The text of the file.
    pub fn to_text(&self) -> String {
        let mut text = format!("{MAGIC}\nversion {VERSION}\n");
        for (key, value) in &self.notes {
            let _ = writeln!(text, "note {key}: {value}");
        }
        for block in &self.blocks {
            let _ = write!(text, "block {}", block.name);
            block.shape.iter().for_each(|size| {
                let _ = write!(text, " {size}");
            });
            let _ = writeln!(text, " : {}", block.words.len());
            for line in block.words.chunks(COLUMNS) {
                let digits: Vec<String> = line.iter().map(|word| format!("{word:08x}")).collect();
                let _ = writeln!(text, "{}", digits.join(" "));
            }
        }
        let _ = writeln!(text, "{CHECKSUM}{:08x}", checksum(text.as_bytes()));
        text
    }

    /// Reads a file, whatever its bytes are.
    ///
    /// # Errors
    /// Truncation and alteration are told before anything else is looked at, then the version, then the syntax.
    pub fn parse(bytes: &[u8]) -> Result<Self, TableError> {
        let body = verified(bytes)?;
        let text = std::str::from_utf8(body).map_err(|_| TableError::Syntax { line: 1, expected: "UTF-8 text" })?;
        let mut lines = text.lines().enumerate().map(|(index, line)| (index + 1, line));
        match lines.next() {
            Some((_, MAGIC)) => {}
            _ => return Err(TableError::Syntax { line: 1, expected: "`kapvik-frozen-table`" }),
        }
        match lines.next().and_then(|(_, line)| line.strip_prefix("version ")) {
            Some(version) if version == VERSION.to_string() => {}
            other => return Err(TableError::Version { found: other.unwrap_or("unknown").to_owned() }),
        }
        let mut table = Self::default();
        while let Some((line, text)) = lines.next() {
            if let Some(note) = text.strip_prefix("note ") {
                let wrong = TableError::Syntax { line, expected: "`note key: value`" };
                let (key, value) = note.split_once(": ").ok_or(wrong)?;
                table.notes.push((key.to_owned(), value.to_owned()));
            } else {
                let block = parse_block(line, text, &mut lines)?;
                if table.block(&block.name).is_some() {
                    return Err(TableError::Syntax { line, expected: "a block of a name that has not been there" });
                }
                table.blocks.push(block);
            }
        }
        Ok(table)
    }

    /// The value of a note.
    pub fn note(&self, key: &str) -> Option<&str> {
        self.notes.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
    }

    /// The block of that name.
    pub fn block(&self, name: &str) -> Option<&Block> {
        self.blocks.iter().find(|block| block.name == name)
    }
}

/// All before the checksum line, if that line is there and fits.
fn verified(bytes: &[u8]) -> Result<&[u8], TableError> {
    let length = CHECKSUM.len() + 9;
    let (body, last) = bytes.split_at_checked(bytes.len().wrapping_sub(length)).ok_or(TableError::Truncated)?;
    let digits = last.strip_prefix(CHECKSUM.as_bytes()).and_then(|rest| rest.strip_suffix(b"\n"));
    let digits = digits.filter(|d| d.iter().all(|c| matches!(c, b'0'..=b'9' | b'a'..=b'f')));
    let digits = digits.and_then(|d| std::str::from_utf8(d).ok()).ok_or(TableError::Truncated)?;
    let expected = u32::from_str_radix(digits, 16).map_err(|_| TableError::Truncated)?;
    let found = checksum(body);
    if expected == found { Ok(body) } else { Err(TableError::Altered { expected, found }) }
}

fn parse_block<'a>(
    line: usize,
    header: &str,
    lines: &mut impl Iterator<Item = (usize, &'a str)>,
) -> Result<Block, TableError> {
    let wrong = || TableError::Syntax { line, expected: "`note key: value` or `block name sizes : count`" };
    let (head, count) = header.strip_prefix("block ").and_then(|rest| rest.split_once(" : ")).ok_or_else(wrong)?;
    let count: usize = count.parse().map_err(|_| wrong())?;
    let mut parts = head.split(' ');
    let name = parts.next().ok_or_else(wrong)?.to_owned();
    let shape = parts.map(str::parse).collect::<Result<_, _>>().map_err(|_| wrong())?;
    let mut words = Vec::new();
    while words.len() < count {
        let short = TableError::Syntax { line, expected: "as many numbers below as the block's header says" };
        let (line, text) = lines.next().ok_or(short)?;
        for digits in text.split(' ') {
            let whole = digits.len() == 8 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
            let word = u32::from_str_radix(digits, 16).ok().filter(|_| whole);
            words.push(word.ok_or(TableError::Syntax { line, expected: "numbers of eight hexadecimal digits" })?);
        }
    }
    if words.len() == count { Ok(Block { name, shape, words }) } else { Err(wrong()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> TableFile {
        TableFile {
            notes: vec![("seed".into(), "1".into()), ("effects".into(), "none".into())],
            blocks: vec![
                Block {
                    name: "wheel.network".into(),
                    shape: vec![2, 3],
                    words: (0..11).map(|k| k * 0x0101_0101).collect(),
                },
                Block { name: "wheel.golden".into(), shape: vec![], words: vec![0x7fc0_0000, 0x8000_0000] },
            ],
        }
    }

    #[test]
    fn reads_back_what_it_wrote() {
        assert_eq!(TableFile::parse(table().to_text().as_bytes()), Ok(table()));
    }

    #[test]
    fn every_truncation_is_refused() {
        let text = table().to_text();
        for length in 0..text.len() {
            assert!(TableFile::parse(&text.as_bytes()[..length]).is_err(), "cut to {length}");
        }
    }

    #[test]
    fn every_flipped_bit_is_refused() {
        let text = table().to_text();
        for bit in 0..8 * text.len() {
            let mut bytes = text.clone().into_bytes();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(TableFile::parse(&bytes).is_err(), "bit {bit}");
        }
    }

    fn sealed(body: &str) -> Result<TableFile, TableError> {
        TableFile::parse(format!("{body}{CHECKSUM}{:08x}\n", checksum(body.as_bytes())).as_bytes())
    }

    #[test]
    fn another_version_and_bad_syntax_are_told_apart() {
        assert_eq!(sealed("kapvik-frozen-table\nversion 2\n"), Err(TableError::Version { found: "2".into() }));
        assert!(matches!(sealed("something else\n"), Err(TableError::Syntax { line: 1, .. })));
        let short = "kapvik-frozen-table\nversion 3\nblock a : 3\n00000000\n";
        assert!(matches!(sealed(short), Err(TableError::Syntax { line: 3, .. })));
        let long = "kapvik-frozen-table\nversion 3\nblock a : 1\n00000000 00000000\n";
        assert!(matches!(sealed(long), Err(TableError::Syntax { line: 3, .. })));
        let digits = "kapvik-frozen-table\nversion 3\nblock a : 1\n+0000000\n";
        assert!(matches!(sealed(digits), Err(TableError::Syntax { line: 4, .. })));
        let twice = "kapvik-frozen-table\nversion 3\nblock a : 1\n00000000\nblock a : 1\n00000001\n";
        assert!(matches!(sealed(twice), Err(TableError::Syntax { line: 5, .. })));
    }
}
