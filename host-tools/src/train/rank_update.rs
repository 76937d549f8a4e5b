//! The sum of outer products of rows, which is nearly all the work of Levenberg–Marquardt.

/// Rows and columns of the tile that is held in registers.
const TILE: (usize, usize) = (4, 8);

/// A symmetric matrix that collects row · rowᵀ; only tiles on and above the diagonal are kept up.
pub struct RankUpdate {
    /// Length of a row as given.
    size: usize,
    /// The same, rounded up to whole tiles.
    stride: usize,
    rows: Vec<f32>,
    sum: Vec<f32>,
}

impl RankUpdate {
    /// Rows that are collected before they are added, so that they stay in the cache.
    const BLOCK: usize = 48;

    /// For rows of `size` numbers.
    pub fn new(size: usize) -> Self {
        let stride = size.next_multiple_of(TILE.1);
        Self { size, stride, rows: Vec::with_capacity(Self::BLOCK * stride), sum: vec![0.0; stride * stride] }
    }

    /// Adds `scale`² · row · rowᵀ.
    pub fn add(&mut self, row: &[f32], scale: f32) {
        debug_assert_eq!(row.len(), self.size);
        self.rows.extend(row.iter().map(|x| scale * x));
        self.rows.resize(self.rows.len().next_multiple_of(self.stride), 0.0);
        if self.rows.len() == Self::BLOCK * self.stride {
            self.flush();
        }
    }

    /// The sum so far, row by row, with both triangles.
    pub fn finish(mut self) -> Vec<f64> {
        self.flush();
        let mut full = vec![0.0; self.size * self.size];
        for i in 0..self.size {
            for j in i..self.size {
                let value = f64::from(self.sum[i * self.stride + j]);
                full[i * self.size + j] = value;
                full[j * self.size + i] = value;
            }
        }
        full
    }

    fn flush(&mut self) {
        for i in (0..self.stride).step_by(TILE.0) {
            let first = i - i % TILE.1;
            for j in (first..self.stride).step_by(TILE.1) {
                self.add_tile(i, j);
            }
        }
        self.rows.clear();
    }

    fn add_tile(&mut self, i: usize, j: usize) {
        let mut tile = [[0.0_f32; TILE.1]; TILE.0];
        for row in self.rows.chunks_exact(self.stride) {
            if let (Some(left), Some(right)) =
                (row[i..].first_chunk::<{ TILE.0 }>(), row[j..].first_chunk::<{ TILE.1 }>())
            {
                for (line, l) in tile.iter_mut().zip(left) {
                    for (cell, r) in line.iter_mut().zip(right) {
                        *cell += l * r;
                    }
                }
            }
        }
        for (k, line) in tile.iter().enumerate() {
            let start = (i + k) * self.stride + j;
            self.sum[start..start + TILE.1].iter_mut().zip(line).for_each(|(s, t)| *s += t);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::RankUpdate;

    #[test]
    fn equals_the_plain_sum() {
        let rows: Vec<Vec<f32>> =
            (0..113).map(|k| (0..13).map(|i| ((k * 7 + i * 3) % 11) as f32 - 5.0).collect()).collect();
        let mut update = RankUpdate::new(13);
        rows.iter().for_each(|row| update.add(row, 0.5));
        let sum = update.finish();
        for i in 0..13 {
            for j in 0..13 {
                let plain: f32 = rows.iter().map(|row| 0.25 * row[i] * row[j]).sum();
                assert_eq!(sum[i * 13 + j], f64::from(plain), "at {i}, {j}");
            }
        }
    }
}
