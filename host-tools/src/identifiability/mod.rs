//! What of a soil can be told, and how a rover has to drive for it.
//!
//! The bound of Cramér and Rao on ln c, φ and ln K, with what is believed of the soil's other parameters, for wheels at given
//! slips and loads; as a `map` over the spread of both, the number of wheels and the averaging time, and as `advice`: the
//! manoeuvre of a rover that makes the soil known at the least cost.
//!
//! From the ground up: what is known `beforehand`, the `sensors` and what of their errors lasts, the `information` of an
//! observation and the `bound` that several give, `single_wheel` and `rover_side` as observations, the `spread` of slips and
//! loads over wheels and the `map` over it, and the `steady_drive` of a rover, from the balance of its forces, that says at
//! what slips and loads its wheels roll; `manoeuvre`, `cost`, `search` and `advice` on top.
//!
//! All of it is to first order about the soil that is stated: what a driver gains by finding out that the soil is another
//! one is not in it.

pub mod advice;
pub mod beforehand;
pub mod bound;
pub mod cost;
pub mod information;
pub mod manoeuvre;
pub mod map;
pub mod rover_side;
pub mod search;
pub mod sensors;
pub mod single_wheel;
pub mod spread;
pub mod steady_drive;
