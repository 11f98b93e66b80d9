//! What the rows of a batch are clustered by, found once for all accumulators.

use std::borrow::Cow;
use std::cell::OnceCell;

use taceva_core::{Batch, Labels};

use crate::evaluate::independent::rows_as_clusters;
use crate::score::ClusteredBy;
use crate::stats::grouped::Grouped;

/// What the rows of one batch are clustered by.
pub(crate) struct BatchClusters<'a> {
    batch: &'a Batch,
    seed: u64,
    points: OnceCell<Option<Grouped<'a>>>,
    recordings: OnceCell<Option<Grouped<'a>>>,
    samples: OnceCell<Grouped<'a>>,
}

impl<'a> BatchClusters<'a> {
    /// Those of `batch`; `seed` is that of the hash.
    pub(crate) fn new(batch: &'a Batch, seed: u64) -> BatchClusters<'a> {
        BatchClusters {
            batch,
            seed,
            points: OnceCell::new(),
            recordings: OnceCell::new(),
            samples: OnceCell::new(),
        }
    }

    /// The clusters of this kind, if the batch has them.
    pub(crate) fn by(&self, kind: ClusteredBy) -> Option<&Grouped<'a>> {
        let borrowed = |labels: Option<&'a Labels>| {
            labels.map(|labels| Grouped::new(Cow::Borrowed(labels), self.seed))
        };
        match kind {
            ClusteredBy::Point => {
                let find = || borrowed(self.batch.points());
                self.points.get_or_init(find).as_ref()
            }
            ClusteredBy::Recording => {
                let find = || borrowed(self.batch.recordings());
                self.recordings.get_or_init(find).as_ref()
            }
            ClusteredBy::Sample => {
                let find = || Grouped::new(Cow::Owned(rows_as_clusters(self.batch)), self.seed);
                Some(self.samples.get_or_init(find))
            }
        }
    }

    /// Whether `labels` are those of the contact points of the batch.
    pub(crate) fn are_points(&self, labels: &Labels) -> bool {
        let points = self.batch.points();
        points.is_some_and(|points| std::ptr::eq(points, labels))
    }
}
