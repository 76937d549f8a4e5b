//! Identification by the methods of the literature: known soils found again, known failures seen again.

mod ding;
mod drawn;
mod hutangkabodee;
mod iagnemma;
mod made;
mod non_uniqueness;
mod ray;
