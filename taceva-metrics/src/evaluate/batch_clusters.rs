//! Clusters of the rows of a batch, computed once for all accumulators.

use std::borrow::Cow;
use std::cell::OnceCell;

use taceva_core::{Batch, Labels};

use crate::evaluate::sample_clusters::rows_as_clusters;
use crate::score::ClusteredBy;
use crate::stats::NAMED_CLUSTERS;
use crate::stats::row_groups::{Grouped, Groups};

/// Least number of rows for which sorting a batch saves time.
const LEAST_ROWS: usize = 512;

/// A batch sorted by contact point, or by hash of the contact point, so that the rows of a cluster are adjacent.
pub(crate) struct SideBySide {
    pub(crate) batch: Batch,
    groups: Groups,
    is_by_hash: bool,
}

impl SideBySide {
    /// Sorts the samples of `batch`. `None` if the samples are already sorted, fewer than 512, or without contact points.
    pub(crate) fn of(batch: &Batch, seed: u64) -> Option<SideBySide> {
        let points = batch.points().filter(|_| batch.rows() >= LEAST_ROWS)?;
        let grouped = Grouped::new(Cow::Borrowed(points), seed);
        let is_by_hash = points.names().len() > NAMED_CLUSTERS;
        let groups = match is_by_hash {
            true => grouped.by_hash(),
            false => grouped.by_name(),
        };
        let order = groups.rows();
        (!order.is_sorted()).then(|| SideBySide {
            batch: batch.in_order(order),
            groups: groups.side_by_side(),
            is_by_hash,
        })
    }

    /// Clusters of the sorted rows; `seed` is the seed of the hash.
    pub(crate) fn clusters(&self, seed: u64) -> BatchClusters<'_> {
        let clusters = BatchClusters::new(&self.batch, seed);
        if let Some(points) = clusters.by(ClusteredBy::Point) {
            points.know(self.is_by_hash, &self.groups);
        }
        clusters
    }
}

/// Clusters of the rows of one batch.
pub(crate) struct BatchClusters<'a> {
    batch: &'a Batch,
    seed: u64,
    points: OnceCell<Option<Grouped<'a>>>,
    recordings: OnceCell<Option<Grouped<'a>>>,
    samples: OnceCell<Grouped<'a>>,
}

impl<'a> BatchClusters<'a> {
    /// Clusters of `batch`, computed at first use; `seed` is the seed of the hash.
    pub(crate) fn new(batch: &'a Batch, seed: u64) -> BatchClusters<'a> {
        BatchClusters {
            batch,
            seed,
            points: OnceCell::new(),
            recordings: OnceCell::new(),
            samples: OnceCell::new(),
        }
    }

    /// Clusters of this kind; `None` if the batch has none.
    pub(crate) fn by(&self, kind: ClusteredBy) -> Option<&Grouped<'a>> {
        let borrowed = |labels: Option<&'a Labels>| {
            labels.map(|labels| Grouped::new(Cow::Borrowed(labels), self.seed))
        };
        match kind {
            ClusteredBy::Point => {
                let find = || borrowed(self.batch.points());
                self.points.get_or_init(find).as_ref()
            }
            // A batch names either recordings or groups.
            ClusteredBy::Recording | ClusteredBy::Group => {
                let find = || borrowed(self.batch.recordings());
                self.recordings.get_or_init(find).as_ref()
            }
            ClusteredBy::Sample => {
                let find = || {
                    let named = self.batch.samples().map(Cow::Borrowed);
                    let labels = named.unwrap_or_else(|| Cow::Owned(rows_as_clusters(self.batch)));
                    Grouped::new(labels, self.seed)
                };
                Some(self.samples.get_or_init(find))
            }
        }
    }

    /// True if `labels` are the contact points of the batch.
    pub(crate) fn are_points(&self, labels: &Labels) -> bool {
        let points = self.batch.points();
        points.is_some_and(|points| std::ptr::eq(points, labels))
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{Channel, Channels, Column};

    use super::*;

    /// Batch whose rows cycle through `points` contact points; the truth is the row number.
    fn in_turn(points: u32, rows: u32) -> Batch {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let column = || vec![Column::full((0..rows).map(f64::from).collect())];
        let mut labels = Labels::default();
        (0..rows).for_each(|row| labels.push(&format!("point {}", row % points)));
        Batch::from_columns(channels, column(), column(), Some(labels))
    }

    #[test]
    fn the_rows_of_a_cluster_come_to_stand_side_by_side_with_their_points() {
        for points in [3, 900] {
            let batch = in_turn(points, 4000);
            let turned = SideBySide::of(&batch, 7).expect("they stood apart");
            let (turned, known) = (&turned.batch, turned.clusters(7));
            let clusters = BatchClusters::new(turned, 7);
            let grouped = clusters.by(ClusteredBy::Point).expect("points");
            let groups = match points {
                3 => grouped.by_name(),
                _ => grouped.by_hash(),
            };
            assert!(groups.rows().is_sorted());
            assert!(SideBySide::of(turned, 7).is_none());
            let known = known.by(ClusteredBy::Point).expect("points");
            for by in [Grouped::by_name, Grouped::by_hash] {
                let [known, found] = [known, grouped].map(by);
                assert!(known.iter().eq(found.iter()));
            }
            let labels = turned.points().expect("points");
            for row in 0..turned.rows() {
                let number = turned.truth(0).get(row).expect("a number");
                let point = format!("point {}", number % f64::from(points));
                assert_eq!(labels.get(row), Some(point.as_str()));
            }
        }
        assert!(SideBySide::of(&in_turn(3, 40), 7).is_none(), "few rows");
    }
}
