//! How much of the board's memory an image takes.

use object::Endianness;
use object::elf::PT_LOAD;
use object::read::elf::{ElfFile32, ProgramHeader};

use crate::error::HostError;

use super::Image;

/// Where the board's data memory starts; below it is program memory.
const RAM_ORIGIN: u32 = 0x2000_0000;

/// What an image takes before it runs. The stack comes on top, measured while it runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryUse {
    /// Program memory: code, constants and the initial values of variables.
    pub flash_bytes: u32,
    /// Data memory of static variables.
    pub static_ram_bytes: u32,
}

impl MemoryUse {
    /// Reads the segments that are loaded.
    ///
    /// # Errors
    /// Where the file is no such image.
    pub fn of(image: &Image) -> Result<Self, HostError> {
        let bytes = image.read()?;
        let bad = |error: object::Error| HostError::Failed(format!("{}: {error}", image.path().display()));
        let file = ElfFile32::<Endianness>::parse(bytes.as_slice()).map_err(bad)?;
        let endian: Endianness = file.endian();
        let loaded = file.elf_program_headers().iter().filter(|segment| segment.p_type(endian) == PT_LOAD);
        let mut used = Self { flash_bytes: 0, static_ram_bytes: 0 };
        for segment in loaded {
            if segment.p_paddr(endian) < RAM_ORIGIN {
                used.flash_bytes += segment.p_filesz(endian);
            }
            if segment.p_vaddr(endian) >= RAM_ORIGIN {
                used.static_ram_bytes += segment.p_memsz(endian);
            }
        }
        Ok(used)
    }
}
