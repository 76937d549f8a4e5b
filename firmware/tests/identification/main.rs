//! The soil from wheel states by the methods of the literature.

mod map;
