//! Growth of one regression tree on histograms of binned features.

use faer::Mat;
use rayon::prelude::*;

use super::bins::Binned;
use super::histogram::Histogram;
use taceva_core::random::SplitMix64;

/// Limits on the size of one tree, and the number of features per split.
#[derive(Clone, Copy, Debug)]
pub(super) struct Growth {
    /// Maximum depth: number of comparisons from the root to a leaf.
    pub(super) depth: usize,
    /// Minimum number of samples in a leaf.
    pub(super) leaf: usize,
    /// Number of features considered for a split. They are drawn at random for each split.
    pub(super) features: usize,
}

/// Binary regression tree. Node 0 is the root. The two children of a node are adjacent and have greater indices than the node.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tree {
    /// Index of the feature that each node compares; 0 for a leaf.
    pub(super) feature: Vec<u32>,
    /// Threshold of each node. A sample goes to the left child if its feature is at most the threshold.
    pub(super) threshold: Vec<f32>,
    /// Index of each node's left child. The right child has the next index. 0 marks a leaf.
    pub(super) left: Vec<u32>,
    /// Predicted value of each output at each node, node by node. A new tree has the means over its samples; ensembles multiply them by a factor.
    pub(super) values: Vec<f64>,
}

impl Tree {
    /// Index of the leaf that the features `sample` reach.
    pub(super) fn leaf(&self, sample: &[f32]) -> usize {
        let mut node = 0;
        while self.left[node] > 0 {
            let goes_left = sample[self.feature[node] as usize] <= self.threshold[node];
            node = self.left[node] as usize + usize::from(!goes_left);
        }
        node
    }
}

/// A candidate split of a node: samples up to `bin` go left. Among splits of one node, the greatest `gain` explains the most variance.
#[derive(Clone, Copy, Debug)]
struct Question {
    gain: f64,
    feature: usize,
    bin: usize,
}

/// Binned features and targets of the samples, from which trees are grown.
pub(super) struct Samples<'a> {
    pub(super) binned: &'a Binned,
    /// Targets, with one row per sample and one column per output.
    pub(super) targets: &'a Mat<f64>,
    pub(super) growth: Growth,
}

impl Samples<'_> {
    /// Grows a tree on the samples with the indices `rows`, which may repeat.
    ///
    /// Each split explains the greatest part of the variance, summed over all outputs. Of equal splits, the first feature and then the lowest bin
    /// win. One thread sums each feature in the order of `rows`, so results do not depend on the number of threads.
    pub(super) fn grow(&self, mut rows: Vec<u32>, random: &mut SplitMix64) -> Tree {
        let mut tree = Tree::default();
        let mut order: Vec<usize> = (0..self.binned.features()).collect();
        self.push(&mut tree, &rows);
        let mut open = vec![(0_usize, 0..rows.len(), 0_usize)];
        while let Some((node, range, depth)) = open.pop() {
            if depth >= self.growth.depth || range.len() < 2 * self.growth.leaf {
                continue;
            }
            let looked_at = self.draw(&mut order, random);
            let Some(best) = self.best(&rows[range.clone()], &looked_at) else {
                continue;
            };
            let bins = self.binned.of(best.feature);
            let own = &mut rows[range.clone()];
            let goes_left = |row: &&u32| usize::from(bins[**row as usize]) <= best.bin;
            let (left, right): (Vec<&u32>, Vec<&u32>) = own.iter().partition(goes_left);
            let middle = range.start + left.len();
            let parted: Vec<u32> = left.into_iter().chain(right).copied().collect();
            own.copy_from_slice(&parted);
            let first = tree.left.len();
            tree.feature[node] = u32::try_from(best.feature).expect("fewer features than 2^32");
            tree.threshold[node] = self.binned.edge(best.feature, best.bin);
            tree.left[node] = u32::try_from(first).expect("fewer nodes than 2^32");
            for (child, range) in [range.start..middle, middle..range.end]
                .into_iter()
                .enumerate()
            {
                self.push(&mut tree, &rows[range.clone()]);
                open.push((first + child, range, depth + 1));
            }
        }
        tree
    }

    /// Appends a leaf to `tree`. Its values are the target means over the samples `rows`.
    fn push(&self, tree: &mut Tree, rows: &[u32]) {
        tree.feature.push(0);
        tree.threshold.push(0.0);
        tree.left.push(0);
        for output in 0..self.targets.ncols() {
            let column = self.targets.col_as_slice(output);
            let sum: f64 = rows.iter().map(|&row| column[row as usize]).sum();
            tree.values.push(sum / rows.len() as f64);
        }
    }

    /// Draws the features for one split, without replacement. Returns their indices in ascending order, and reorders `order`.
    fn draw(&self, order: &mut [usize], random: &mut SplitMix64) -> Vec<usize> {
        let count = self.growth.features.min(order.len());
        for position in 0..count {
            let other = position + random.below(order.len() - position);
            order.swap(position, other);
        }
        let mut drawn = order[..count].to_vec();
        drawn.sort_unstable();
        drawn
    }

    fn best(&self, rows: &[u32], features: &[usize]) -> Option<Question> {
        let total: Vec<f64> = (0..self.targets.ncols())
            .map(|output| {
                let column = self.targets.col_as_slice(output);
                rows.iter().map(|&row| column[row as usize]).sum()
            })
            .collect();
        let whole = total.iter().map(|sum| sum * sum).sum::<f64>() / rows.len() as f64;
        let spread: f64 = (0..self.targets.ncols())
            .map(|output| {
                let column = self.targets.col_as_slice(output);
                rows.iter()
                    .map(|&row| column[row as usize].powi(2))
                    .sum::<f64>()
            })
            .sum();
        let found: Vec<Option<Question>> = features
            .par_iter()
            .with_min_len(16)
            .map_init(
                || Histogram::new(total.len()),
                |histogram, &feature| self.best_bin(histogram, rows, feature, &total),
            )
            .collect();
        let better = |best: Option<Question>, next: Question| match best {
            Some(best) if next.gain <= best.gain => Some(best),
            _ => Some(next),
        };
        let best = found.into_iter().flatten().fold(None, better)?;
        // Ignores gains within rounding error.
        (best.gain - whole > 1e-12 * spread).then_some(best)
    }

    fn best_bin(
        &self,
        histogram: &mut Histogram,
        rows: &[u32],
        feature: usize,
        total: &[f64],
    ) -> Option<Question> {
        histogram.fill(self.binned.of(feature), self.targets, rows);
        let mut left = vec![0.0; total.len()];
        let (mut count, mut best) = (0, None::<Question>);
        // Nothing is left after the last bin.
        let bins = histogram
            .held
            .split_last()
            .map_or(&[][..], |(_, bins)| bins);
        for &bin in bins {
            let bin = usize::from(bin);
            count += histogram.counts[bin] as usize;
            let sums = &histogram.sums[bin * total.len()..(bin + 1) * total.len()];
            left.iter_mut()
                .zip(sums)
                .for_each(|(left, sum)| *left += sum);
            let rest = rows.len() - count;
            if count < self.growth.leaf || rest < self.growth.leaf {
                continue;
            }
            let sides = left.iter().zip(total).map(|(left, total)| {
                left * left / count as f64 + (total - left) * (total - left) / rest as f64
            });
            let gain = sides.sum();
            if best.is_none_or(|best| gain > best.gain) {
                best = Some(Question { gain, feature, bin });
            }
        }
        histogram.clear();
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{FeatureShape, Features};

    #[test]
    fn the_split_is_where_the_labels_change() {
        // The second feature separates the labels, the first does not.
        let values = vec![5.0, 0.0, 1.0, 0.1, 4.0, 0.9, 2.0, 1.0];
        let features = Features::new(FeatureShape::flat(2), values).expect("four samples");
        let binned = Binned::new(&features);
        let targets = Mat::from_fn(4, 1, |row, _| [1.0, 1.0, 3.0, 3.0][row]);
        let growth = Growth {
            depth: 4,
            leaf: 1,
            features: 2,
        };
        let samples = Samples {
            binned: &binned,
            targets: &targets,
            growth,
        };
        let tree = samples.grow(vec![0, 1, 2, 3], &mut SplitMix64::new(1));
        assert_eq!((tree.feature[0], tree.left.len()), (1, 3));
        assert!((tree.threshold[0] - 0.5).abs() < 1e-6);
        assert!((tree.values[tree.leaf(&[9.0, 0.2])] - 1.0).abs() < 1e-15);
        assert!((tree.values[tree.leaf(&[9.0, 0.6])] - 3.0).abs() < 1e-15);
    }

    #[test]
    fn nothing_is_asked_where_nothing_is_to_be_learnt() {
        let features = Features::new(FeatureShape::flat(1), vec![1.0, 2.0, 3.0]).expect("whole");
        let binned = Binned::new(&features);
        let targets = Mat::from_fn(3, 1, |_, _| 0.7);
        let growth = Growth {
            depth: 4,
            leaf: 1,
            features: 1,
        };
        let samples = Samples {
            binned: &binned,
            targets: &targets,
            growth,
        };
        assert_eq!(
            samples.grow(vec![0, 1, 2], &mut SplitMix64::new(1)).left,
            [0]
        );
    }
}
