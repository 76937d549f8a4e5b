//! The checksum of frames, tables and fingerprints: CRC-32 (ISO-HDLC).

use crc::{CRC_32_ISO_HDLC, Crc, Digest, Table};

/// Bit by bit: a table of steps would be a kilobyte of flash, and nothing that flies fast is summed.
static BIT_BY_BIT: Crc<u32, Table<0>> = Crc::<u32, Table<0>>::new(&CRC_32_ISO_HDLC);

/// A checksum that grows with the bytes.
pub struct Checksum(Digest<'static, u32, Table<0>>);

impl Checksum {
    /// Of nothing.
    pub fn new() -> Self {
        Self(BIT_BY_BIT.digest())
    }

    /// Of these bytes too.
    pub fn add(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.add_byte(*byte));
    }

    /// Of the bytes of this word too, the least significant first. By itself: the walk over a table calls it at each of its fields.
    #[inline(never)]
    pub fn add_word(&mut self, word: u32) {
        self.add(&word.to_le_bytes());
    }

    /// What adds words: of one type whatever it walks over, so that one walk is in the image.
    pub fn words(&mut self) -> impl FnMut(u32) {
        |word| self.add_word(word)
    }

    /// By itself: the bits of many bytes, unrolled, were as long as the table of steps.
    #[inline(never)]
    fn add_byte(&mut self, byte: u8) {
        self.0.update(&[byte]);
    }

    /// What it came to.
    pub fn finish(self) -> u32 {
        self.0.finalize()
    }

    /// Of a row of bytes.
    pub fn of(bytes: &[u8]) -> u32 {
        let mut checksum = Self::new();
        checksum.add(bytes);
        checksum.finish()
    }
}

impl Default for Checksum {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::Checksum;

    /// The check value that catalogues of CRCs give.
    #[test]
    fn it_is_the_published_one() {
        assert_eq!(Checksum::of(b"123456789"), 0xcbf4_3926);
        assert_eq!(Checksum::default().finish(), 0);
    }
}
