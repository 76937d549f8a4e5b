//! What a run found, as a page to look at, a picture, and a table for the terminal.

mod caveats;
mod chain;
pub mod compare;
pub mod diagnosis;
mod draw;
mod estimates;
mod facts;
mod findings;
mod gather;
pub mod identifiability;
mod identified;
mod legend;
mod page;
mod parameter;
mod picture;
mod residual;
mod response;
mod sentence;
mod terminal;
pub mod traverse;
mod verdict;

pub use facts::{FlightFacts, FlownNetworks, lines as flight_lines, link as link_in_words};
pub use findings::{EstimateRow, Findings, RowKind, fingerprint};
pub use identified::identified;
pub use page::page;
pub use picture::picture;
pub use residual::{LeftOver, ModelCheck, ModelRow, ModelState};
pub use terminal::terminal;
pub use verdict::Verdict;
