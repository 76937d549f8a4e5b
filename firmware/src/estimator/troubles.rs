//! How often filters were in trouble.

/// Counts, which begin anew beyond their greatest value: what they grow by from frame to frame is right all the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Troubles {
    /// A filter fell back to its floor.
    pub resets: u32,
    /// A filter gave up what it believed.
    pub relearned: u32,
}

impl Troubles {
    /// Those of two filters together.
    pub fn plus(self, other: Self) -> Self {
        Self { resets: self.resets.wrapping_add(other.resets), relearned: self.relearned.wrapping_add(other.relearned) }
    }

    /// Those that came since `before`.
    pub fn since(self, before: Self) -> Self {
        Self {
            resets: self.resets.wrapping_sub(before.resets),
            relearned: self.relearned.wrapping_sub(before.relearned),
        }
    }
}
