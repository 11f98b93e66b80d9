//! Exact sums of errors or of correct predictions by cluster, for the comparison of two models on the same samples.

use std::collections::BTreeMap;

use taceva_core::Batch;

use super::error::ComparisonError;
use crate::exact::ExactSum;
use crate::pair::Paired;

/// Number of samples of one cluster, and the sum over these samples of their errors or correct predictions.
///
/// ```
/// use taceva_metrics::ClusterSum;
/// let mut sum = ClusterSum::default();
/// sum.sum.add(0.25);
/// assert_eq!((sum.n, sum.sum.to_f64()), (0, 0.25));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ClusterSum {
    /// Number of samples.
    pub n: u64,
    /// Sum of the absolute errors in the unit of the channel, or number of correct predictions.
    pub sum: ExactSum,
}

/// Exact sum and number of samples for each cluster.
///
/// A cluster is a contact point, or a board of a grating test. The order of samples does not change the sums, and sums of shards can be merged.
///
/// ```
/// use taceva_metrics::ClusterSums;
/// let mut hits = ClusterSums::default();
/// for (board, hit) in [("bump 0.5", 1.0), ("bump 0.5", 0.0), ("bump 0.3", 1.0)] {
///     hits.try_add(board, hit)?;
/// }
/// let counts: Vec<u64> = hits.iter().map(|(_, board)| board.n).collect();
/// assert_eq!(counts, [1, 2]);
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ClusterSums {
    cells: BTreeMap<String, ClusterSum>,
    n_invalid: u64,
}

impl ClusterSums {
    /// Adds one sample with the value `term` to `cluster`.
    ///
    /// # Errors
    /// [`ComparisonError::Term`] if `term` is not finite. Nothing is added then.
    pub fn try_add(&mut self, cluster: &str, term: f64) -> Result<(), ComparisonError> {
        if !term.is_finite() {
            return Err(ComparisonError::Term {
                cluster: cluster.to_owned(),
                value: term,
            });
        }
        let cell = self.cell(cluster);
        cell.n += 1;
        cell.sum.add(term);
        Ok(())
    }

    /// Adds the absolute error of each row to the cluster of its contact point, for the channel at index `position`.
    ///
    /// Rows without prediction or truth are skipped. Invalid pairs of both are skipped and counted in [`n_invalid`](ClusterSums::n_invalid).
    ///
    /// # Errors
    /// [`ComparisonError::NoClusters`] if the batch has no contact points. Nothing is added then.
    ///
    /// # Panics
    /// If the batch has no channel at `position`.
    pub fn update(&mut self, batch: &Batch, position: usize) -> Result<(), ComparisonError> {
        let moved = batch.unwrapped(&BTreeMap::new());
        let batch = moved.as_ref().unwrap_or(batch);
        let points = batch.points().ok_or(ComparisonError::NoClusters)?;
        let (estimates, references) = (batch.prediction(position), batch.truth(position));
        for row in 0..batch.rows() {
            let values = (estimates.get(row), references.get(row), points.get(row));
            let (Some(estimate), Some(reference), Some(cluster)) = values else {
                continue;
            };
            let pair = Paired {
                estimate,
                reference,
            };
            if pair.is_valid() {
                let cell = self.cell(cluster);
                cell.n += 1;
                cell.sum.add(pair.residual().abs());
            } else {
                self.n_invalid += 1;
            }
        }
        Ok(())
    }

    /// Adds the sums of `other`, cluster by cluster.
    pub fn merge(&mut self, other: &ClusterSums) {
        for (name, theirs) in &other.cells {
            let cell = self.cell(name);
            cell.n = cell.n.saturating_add(theirs.n);
            cell.sum.merge(&theirs.sum);
        }
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
    }

    /// Names and sums of the clusters, in the order of names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &ClusterSum)> {
        self.cells.iter().map(|(name, cell)| (name.as_str(), cell))
    }

    /// Sum of the cluster called `cluster`; `None` for an unknown cluster.
    pub fn get(&self, cluster: &str) -> Option<&ClusterSum> {
        self.cells.get(cluster)
    }

    /// Number of pairs of prediction and truth that were skipped for a NaN or a magnitude beyond 2¹⁰²¹.
    pub fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    fn cell(&mut self, cluster: &str) -> &mut ClusterSum {
        if !self.cells.contains_key(cluster) {
            self.cells.insert(cluster.to_owned(), ClusterSum::default());
        }
        self.cells
            .get_mut(cluster)
            .expect("the entry exists or was inserted")
    }
}

impl FromIterator<(String, ClusterSum)> for ClusterSums {
    /// Collects clusters. The sums of a repeated name are merged.
    fn from_iter<I: IntoIterator<Item = (String, ClusterSum)>>(clusters: I) -> ClusterSums {
        let mut sums = ClusterSums::default();
        for (name, theirs) in clusters {
            let cell = sums.cell(&name);
            cell.n = cell.n.saturating_add(theirs.n);
            cell.sum.merge(&theirs.sum);
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{Channel, Channels, Column, Labels};

    #[test]
    fn a_batch_is_summed_by_location_and_what_is_no_number_is_counted() {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let mut points = Labels::default();
        ["p1", "p2", "p1", "p1"]
            .iter()
            .for_each(|name| points.push(name));
        let truth = Column::full(vec![1.0, 2.0, 3.0, f64::NAN]);
        let prediction = Column::full(vec![0.5, 2.0, 3.25, 0.0]);
        let batch = Batch::from_columns(
            channels.clone(),
            vec![truth],
            vec![prediction],
            Some(points),
        );
        let mut sums = ClusterSums::default();
        sums.update(&batch, 0).expect("it has locations");
        let found: Vec<_> = sums
            .iter()
            .map(|(name, cell)| (name, cell.n, cell.sum.to_f64()))
            .collect();
        assert_eq!(found, [("p1", 2, 0.75), ("p2", 1, 0.0)]);
        assert_eq!(sums.n_invalid(), 1);
        let column = || vec![Column::full(vec![1.0])];
        let nameless = Batch::from_columns(channels, column(), column(), None);
        assert_eq!(sums.update(&nameless, 0), Err(ComparisonError::NoClusters));
    }

    #[test]
    fn a_term_that_is_no_number_names_its_cluster_and_adds_nothing() {
        let mut sums = ClusterSums::default();
        let error = sums.try_add("p1", f64::INFINITY).expect_err("no sum");
        assert_eq!(
            error.to_string(),
            "term inf in cluster `p1`, expected a finite number"
        );
        assert_eq!(sums, ClusterSums::default());
    }
}
