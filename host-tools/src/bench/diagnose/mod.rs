//! How well a diagnosis finds what nobody declared: campaigns drawn from a seed, with one undeclared effect, two, one that
//! is in no list, or none.

mod campaign_draw;
mod chance;
mod instruments;
mod knowledge;
mod layout;
mod overlay;
mod refit;
mod site;
mod state;
mod stress;
mod undeclared;
mod unlisted;
mod variants;
mod wants;
mod world;
mod write;
