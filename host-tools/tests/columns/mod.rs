//! Columns of wheel campaigns.

/// Those of a campaign of which all channels are measured.
pub const COLUMNS: &str = "run,t_s,slip,load_n,drawbar_pull_n,torque_nm,sinkage_m";
