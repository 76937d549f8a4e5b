//! Reading and writing the files that people hand us: problems are told by file, line and column.

pub mod assumed_keys;
pub mod atomic_write;
pub mod campaign;
mod csv_fault;
pub mod frame_file;
mod header;
pub mod misspelling;
pub mod number_stream;
pub mod outputs;
pub mod rover_fault;
pub mod rover_file;
pub mod sensor_channels;
pub mod soil_file;
pub mod table;
pub mod text;
pub mod time_column;
pub mod toml_file;
pub mod truth_file;
pub mod unfinished;
pub mod wheel_file;
