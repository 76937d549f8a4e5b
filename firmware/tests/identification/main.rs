//! Identification by the methods of the literature: known soils found again, known failures seen again.

mod closed_form;
mod ding;
mod ding_published;
mod drawn;
mod hutangkabodee;
mod iagnemma;
mod iagnemma_published;
mod independent;
#[path = "../support/kapvik.rs"]
mod kapvik;
mod made;
mod map;
mod map_design;
mod map_firm_ground;
mod map_unmeasured;
#[path = "../support/mostly.rs"]
mod mostly;
mod non_uniqueness;
mod properties;
mod ray;
mod recursive;
#[path = "../support/six_slips.rs"]
mod six_slips;
#[path = "../support/worse.rs"]
mod worse;
