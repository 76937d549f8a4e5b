//! The residual loop: what a model leaves over of measured data, traced to an effect that it lacks, and how sure that is.
//!
//! As data flow: `measurements` of a campaign and a `specification` of effects make a `campaign_model`, which `fit` fits;
//! `trial` holds both, on the `bench` of the campaign. `selection` fits every one of the `candidates` on top of a model and tests
//! it against chance; `residual_search` does the same with every column as it stands; `forward` adds what earns its place, and
//! without `lone_rows` that would bear it alone; `sensor_rival` holds what was found against errors of sensors that stand in no list,
//! whose laws are in `sensor_law`. `held_out_errors` does it all again without some runs, in
//! `folds`, to predict those; `formula_search` looks for a law of what is left; `assemble` writes the `document`. Beside all that,
//! `force_channels` holds loads that are set and side forces that should be none against what sensors follow, without any model of
//! the soil.

mod assemble;
mod bench;
mod beyond_noise;
pub mod campaign_model;
mod candidates;
mod caveats;
mod chance;
mod contact_again;
mod curvature;
mod declared_effects;
mod declared_file;
pub mod document;
mod effect_in_words;
mod error_caveats;
mod field;
pub mod fit;
mod folds;
mod force_channels;
mod formula;
mod formula_groups;
mod formula_search;
mod forward;
mod gain_chance;
mod held_out_errors;
mod left_over;
mod levels;
mod linearised;
mod lone_rows;
mod loose_slip;
pub mod measurements;
mod mimicry;
mod nearest;
mod noise;
mod other_forms;
mod outcome;
mod pairs;
mod plausible_range;
mod rates;
mod regressors;
mod residual_search;
mod selection;
mod sensor_law;
mod sensor_rival;
mod sentence;
mod settings;
mod shared_place;
mod site;
mod sizes;
mod soil_coordinates;
pub mod specification;
mod stated_soil;
mod steps;
mod term_screen;
mod thinning;
mod told;
mod trace;
pub mod trial;
mod unseen_runs;
mod usable_rows;

pub use declared_file::declared_file;
pub use effect_in_words::effect_in_words;
pub use outcome::{DiagnoseOptions, Outcome, diagnose};
pub use told::{Told, told};
pub use trace::{Trace, Traced};
