//! Numbers as the words of 32 bits that a trainer sets, a file carries and a checksum covers.

/// Something made of numbers, each a word of 32 bits.
pub trait Words {
    /// Calls `see` with each word, in an order that does not change.
    fn for_each(&self, see: &mut impl FnMut(u32));
    /// Calls `set` with a place for each word, in the same order.
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut u32));

    /// Calls `see` with each word of a row of such things. By itself: unrolled through all layers of a table, the checksum's walk would take
    /// 5 KB of the image.
    #[cfg_attr(target_arch = "arm", inline(never))]
    fn for_each_of(row: &[Self], see: &mut impl FnMut(u32))
    where
        Self: Sized,
    {
        row.iter().for_each(|part| part.for_each(see));
    }
}

impl Words for u32 {
    fn for_each(&self, see: &mut impl FnMut(u32)) {
        see(*self);
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut u32)) {
        set(self);
    }
}

impl Words for i32 {
    fn for_each(&self, see: &mut impl FnMut(u32)) {
        see(self.cast_unsigned());
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut u32)) {
        let mut word = self.cast_unsigned();
        set(&mut word);
        *self = word.cast_signed();
    }
}

impl Words for f32 {
    fn for_each(&self, see: &mut impl FnMut(u32)) {
        see(self.to_bits());
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut u32)) {
        let mut word = self.to_bits();
        set(&mut word);
        *self = f32::from_bits(word);
    }
}

impl<T: Words, const N: usize> Words for [T; N] {
    fn for_each(&self, see: &mut impl FnMut(u32)) {
        T::for_each_of(self, see);
    }
    fn for_each_mut(&mut self, set: &mut impl FnMut(&mut u32)) {
        self.iter_mut().for_each(|part| part.for_each_mut(set));
    }
    /// Arrays in a row are one longer row of what they hold: one walk in the image for arrays of all lengths.
    fn for_each_of(row: &[Self], see: &mut impl FnMut(u32)) {
        T::for_each_of(row.as_flattened(), see);
    }
}

/// Writes [`Words`](crate::network::Words) for a struct: its fields in the order given.
#[macro_export]
macro_rules! words {
    ($name:ty $(where $($size:ident),+)? : $($field:tt),+) => {
        impl$(<$(const $size: usize),+>)? $crate::network::Words for $name {
            fn for_each(&self, see: &mut impl FnMut(u32)) {
                $(self.$field.for_each(see);)+
            }
            fn for_each_mut(&mut self, set: &mut impl FnMut(&mut u32)) {
                $(self.$field.for_each_mut(set);)+
            }
        }
    };
}
pub(super) use words;
