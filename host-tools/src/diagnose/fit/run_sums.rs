//! Sums over the rows of a run, offsets where they are.
//!
//! Of the parameters four are summed at a time: a processor does so in few instructions, and each sum is made in the same order
//! as by itself.

use nalgebra::{DMatrix, DVector};

use super::model::Derivatives;
use super::observation::{CHANNELS, ChannelMatrix, Channels, ParameterByChannel, Reading};
use super::row_terms::RowTerms;

/// The channels before slip and load.
const JUDGED: usize = Reading::JUDGED.len();
/// Those before the side force.
const SIDE: usize = Reading::SideForce.index();

/// Parameters that are summed at a time.
const LANES: usize = 4;
/// One number for each of them.
type Lanes = [f64; LANES];
/// One number for each of them and each channel.
type LanesByChannel = [Lanes; CHANNELS];

/// Sums over the rows of a run. Behind the last parameter come zeros.
pub(super) struct RunSums {
    /// Curvature along the parameters, by parameter: of those up to it.
    information: Vec<Lanes>,
    /// Mixed curvature of parameters and the channels' offsets.
    cross: Vec<LanesByChannel>,
    pull: Vec<Lanes>,
    /// Curvature along the channels' offsets.
    pub by_channel: ChannelMatrix,
    /// Negative slope of the objective along them.
    pub channel_pull: Channels,
    /// ln det of the latents' information.
    pub ln_det: f64,
    /// Of the row at hand, the derivatives by each parameter, and what its information makes of them.
    derivatives: Vec<LanesByChannel>,
    informed: Vec<LanesByChannel>,
}

impl RunSums {
    /// Of no row yet.
    pub(super) fn new(count: usize) -> Self {
        let blocks = count.div_ceil(LANES);
        let by_channel = vec![[[0.0; LANES]; CHANNELS]; blocks];
        Self {
            information: vec![[0.0; LANES]; count * blocks],
            cross: by_channel.clone(),
            pull: vec![[0.0; LANES]; blocks],
            by_channel: ChannelMatrix::zeros(),
            channel_pull: Channels::zeros(),
            ln_det: 0.0,
            derivatives: by_channel.clone(),
            informed: by_channel,
        }
    }

    /// Adds a row.
    pub(super) fn add(&mut self, row: &RowTerms, slopes: &Derivatives) {
        self.by_channel += row.information;
        self.channel_pull += row.pull;
        self.ln_det += row.ln_det;
        let is_seen: [bool; CHANNELS] = std::array::from_fn(|c| row.weight[c] > 0.0);
        for (block, by) in self.derivatives.iter_mut().zip(slopes.by_parameter.chunks(LANES)) {
            for (lane, by) in by.iter().enumerate() {
                for c in 0..CHANNELS {
                    block[c][lane] = if is_seen[c] { by[c] } else { 0.0 };
                }
            }
        }
        // Slip and load come last, and but for a few effects of their sensors no parameter changes what is read of them; before
        // them the side force, which few campaigns measure.
        let is_done = |first: usize| {
            self.derivatives.iter().all(|block| block[first..].as_flattened().iter().all(|slope| *slope == 0.0))
        };
        if is_done(SIDE) {
            self.add_first::<SIDE>(row);
        } else if is_done(JUDGED) {
            self.add_first::<JUDGED>(row);
        } else {
            self.add_first::<CHANNELS>(row);
        }
    }

    /// Adds what the parameters do in the first `N` channels, which is all that they do.
    fn add_first<const N: usize>(&mut self, row: &RowTerms) {
        let pull: [f64; N] = std::array::from_fn(|c| row.pull[c]);
        let information: [[f64; N]; CHANNELS] =
            std::array::from_fn(|d| std::array::from_fn(|c| row.information[(d, c)]));
        let places = self.derivatives.iter().zip(&mut self.informed).zip(&mut self.cross).zip(&mut self.pull);
        for (((by, informed), cross), sum) in places {
            add(sum, &combination(by, &pull));
            for d in 0..CHANNELS {
                informed[d] = combination(by, &information[d]);
                add(&mut cross[d], &informed[d]);
            }
        }
        let blocks = self.derivatives.len();
        for (p, column) in self.information.chunks_exact_mut(blocks.max(1)).enumerate() {
            let informed: [f64; N] = std::array::from_fn(|c| self.informed[p / LANES][c][p % LANES]);
            for (sum, by) in column[..=p / LANES].iter_mut().zip(&self.derivatives) {
                add(sum, &combination(by, &informed));
            }
        }
    }

    /// The curvature along the parameters, both triangles.
    pub(super) fn information(&self, information: &mut DMatrix<f64>) {
        let blocks = self.pull.len();
        for (mut column, sums) in information.column_iter_mut().zip(self.information.chunks_exact(blocks.max(1))) {
            for (entry, sum) in column.iter_mut().zip(sums.as_flattened()) {
                *entry = *sum;
            }
        }
        information.fill_lower_triangle_with_upper_triangle();
    }

    /// Negative slope of the objective along the parameters.
    pub(super) fn pull(&self, pull: &mut DVector<f64>) {
        for (entry, sum) in pull.iter_mut().zip(self.pull.as_flattened()) {
            *entry = *sum;
        }
    }

    /// Mixed curvature of parameters and the channels' offsets.
    pub(super) fn cross(&self, count: usize) -> ParameterByChannel {
        ParameterByChannel::from_fn(count, |p, c| self.cross[p / LANES][c][p % LANES])
    }
}

/// The first `N` channels' numbers, each times its factor.
fn combination<const N: usize>(of: &LanesByChannel, factors: &[f64; N]) -> Lanes {
    std::array::from_fn(|lane| (0..N).map(|c| factors[c] * of[c][lane]).sum())
}

fn add(sum: &mut Lanes, more: &Lanes) {
    for (sum, more) in sum.iter_mut().zip(more) {
        *sum += more;
    }
}
