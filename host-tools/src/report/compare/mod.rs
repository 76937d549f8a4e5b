//! The comparison of the methods: a table for the terminal and a page.

mod error_chart;
mod overview;
mod page;
mod terminal;
mod verdict;

pub use page::page;
pub use terminal::terminal;

/// How the tables and charts of the comparison look.
const COMPARE_CSS: &str = include_str!("compare.css");
