//! Features quantised to at most 256 bins, so that splits are found without sorting.

use rayon::prelude::*;
use taceva_core::Features;

/// Maximum number of bins of a feature.
pub(super) const BINS: usize = 256;

/// Bin number of each feature of each sample, and the edges between bins.
#[derive(Debug)]
pub(super) struct Binned {
    /// Bin numbers. The numbers of all samples in one feature are adjacent.
    bins: Vec<u8>,
    /// Ascending edges between the bins of each feature. A value equal to an edge belongs to the bin below the edge.
    edges: Vec<Vec<f32>>,
    samples: usize,
}

impl Binned {
    /// Divides the values of each feature into at most 256 bins with about equal numbers of samples.
    pub(super) fn new(features: &Features) -> Binned {
        let (samples, width) = (features.samples(), features.shape().len());
        let mut bins = vec![0; samples * width];
        let edges = bins
            .par_chunks_mut(samples)
            .enumerate()
            .map(|(feature, bins)| {
                let values = features.values().iter().skip(feature).step_by(width);
                let values: Vec<f32> = values.copied().collect();
                let edges = edges(&values);
                for (bin, value) in bins.iter_mut().zip(&values) {
                    let below = edges.partition_point(|edge| edge < value);
                    *bin = u8::try_from(below).expect("one bin more than there are edges");
                }
                edges
            })
            .collect();
        Binned {
            bins,
            edges,
            samples,
        }
    }

    pub(super) fn features(&self) -> usize {
        self.edges.len()
    }

    /// Bin number of each sample for the feature with the index `feature`.
    pub(super) fn of(&self, feature: usize) -> &[u8] {
        &self.bins[feature * self.samples..(feature + 1) * self.samples]
    }

    /// Upper edge of a bin of the feature with the index `feature`. The bin must not be the last.
    pub(super) fn edge(&self, feature: usize, bin: usize) -> f32 {
        self.edges[feature][bin]
    }
}

/// Ascending bin edges near the quantiles of `values`. Each edge lies between two distinct values.
fn edges(values: &[f32]) -> Vec<f32> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f32::total_cmp);
    let mut edges: Vec<f32> = Vec::new();
    let distinct = 1 + sorted.windows(2).filter(|pair| pair[0] < pair[1]).count();
    let mut next = 1;
    for position in 1..sorted.len() {
        let (below, above) = (sorted[position - 1], sorted[position]);
        let due = distinct <= BINS || position * BINS >= next * sorted.len();
        if below < above && due {
            let middle = below + (above - below) / 2.0;
            edges.push(if middle < above { middle } else { below });
            next = position * BINS / sorted.len() + 1;
        }
    }
    edges
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::FeatureShape;

    #[test]
    fn few_values_get_a_bin_each_and_many_share() {
        assert_eq!(edges(&[3.0, 1.0, 1.0, 2.0]), [1.5, 2.5]);
        assert!(edges(&[4.0; 9]).is_empty());
        let many: Vec<f32> = (0..10_000_u16).map(f32::from).collect();
        assert_eq!(edges(&many).len(), BINS - 1);
        let heavy: Vec<f32> = (0..2_000_u16).map(|i| f32::from(i.min(1_500))).collect();
        assert!(edges(&heavy).len() < BINS);
    }

    #[test]
    fn numbers_next_to_each_other_are_distinguished() {
        let next = f32::from_bits(1.0_f32.to_bits() + 1);
        let features = Features::new(FeatureShape::flat(1), vec![1.0, next]).expect("two samples");
        let binned = Binned::new(&features);
        assert_eq!(binned.of(0), [0, 1]);
        assert!(binned.edge(0, 0) >= 1.0 && binned.edge(0, 0) < next);
    }
}
