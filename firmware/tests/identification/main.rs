//! Identification by the methods of the literature: known soils found again, known failures seen again.

mod hutangkabodee;
mod made;
mod non_uniqueness;
mod ray;
