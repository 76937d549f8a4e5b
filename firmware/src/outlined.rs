//! Fields of one type, written and read by one function each: inlined, six wheels or a dozen counts would take as many copies in the image.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Writes a field.
#[inline(never)]
pub(crate) fn serialize<T: Serialize, S: Serializer>(field: &T, serializer: S) -> Result<S::Ok, S::Error> {
    field.serialize(serializer)
}

/// Reads a field.
#[inline(never)]
pub(crate) fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    T::deserialize(deserializer)
}
