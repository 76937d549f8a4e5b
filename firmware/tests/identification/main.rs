//! Identification by the methods of the literature: known soils found again, known failures seen again.

mod ding;
mod drawn;
mod iagnemma;
mod made;
