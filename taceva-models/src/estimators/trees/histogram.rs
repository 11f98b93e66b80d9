//! Histograms of the targets over the bins of one feature.

use faer::Mat;

use super::bins::BINS;

/// Number of samples in each bin, and the sum of each target over these samples.
pub(super) struct Histogram {
    pub(super) counts: Vec<u32>,
    pub(super) sums: Vec<f64>,
    pub(super) outputs: usize,
    /// Indices of nonempty bins, ascending.
    pub(super) held: Vec<u8>,
}

impl Histogram {
    pub(super) fn new(outputs: usize) -> Histogram {
        Histogram {
            counts: vec![0; BINS],
            sums: vec![0.0; BINS * outputs],
            outputs,
            held: Vec::with_capacity(BINS),
        }
    }

    /// Counts and sums the samples with the indices `rows`. The histogram must be empty before.
    pub(super) fn fill(&mut self, bins: &[u8], targets: &Mat<f64>, rows: &[u32]) {
        for &row in rows {
            let bin = bins[row as usize];
            let count = &mut self.counts[usize::from(bin)];
            if *count == 0 {
                self.held.push(bin);
            }
            *count += 1;
        }
        match self.held.len() {
            0..64 => self.held.sort_unstable(),
            _ => {
                let holds = |bin: &u8| self.counts[usize::from(*bin)] > 0;
                self.held = (0..=u8::MAX).filter(holds).collect();
            }
        }
        for output in 0..self.outputs {
            let column = targets.col_as_slice(output);
            for &row in rows {
                let bin = usize::from(bins[row as usize]);
                self.sums[bin * self.outputs + output] += column[row as usize];
            }
        }
    }

    /// Empties the histogram. Only the nonempty bins are overwritten.
    pub(super) fn clear(&mut self) {
        for bin in self.held.drain(..) {
            let bin = usize::from(bin);
            self.counts[bin] = 0;
            self.sums[bin * self.outputs..(bin + 1) * self.outputs].fill(0.0);
        }
    }
}
