//! Rows of a batch by cluster, computed once for all families with the same cluster labels.

use std::borrow::Cow;
use std::cell::OnceCell;

use taceva_core::Labels;
use taceva_core::random::mix;

use taceva_core::random::fnv_1a;

/// Number of clusters formed by hash, if there are more than [`NAMED_CLUSTERS`](crate::NAMED_CLUSTERS) contact points.
pub const HASHED_CLUSTERS: usize = 32;

/// Cluster labels of a batch, with the rows of each cluster.
pub(crate) struct Grouped<'a> {
    labels: Cow<'a, Labels>,
    seed: u64,
    by_name: OnceCell<Groups>,
    by_hash: OnceCell<Groups>,
}

impl<'a> Grouped<'a> {
    /// Rows of `labels`, grouped at first use; `seed` is the seed of the hash.
    pub(crate) fn new(labels: Cow<'a, Labels>, seed: u64) -> Grouped<'a> {
        Grouped {
            labels,
            seed,
            by_name: OnceCell::new(),
            by_hash: OnceCell::new(),
        }
    }

    /// Distinct names of clusters.
    pub(crate) fn names(&self) -> &[String] {
        self.labels.names()
    }

    /// Rows grouped by name.
    pub(crate) fn by_name(&self) -> &Groups {
        let find = || Groups::new(&self.labels, self.names().len(), |name, _| name);
        self.by_name.get_or_init(find)
    }

    /// Stores groups that are computed already, grouped by hash if `is_by_hash`, otherwise by name.
    pub(crate) fn know(&self, is_by_hash: bool, groups: &Groups) {
        let cell = match is_by_hash {
            true => &self.by_hash,
            false => &self.by_name,
        };
        cell.get_or_init(|| groups.clone());
    }

    /// Rows grouped by the hash of their name.
    pub(crate) fn by_hash(&self) -> &Groups {
        let of_name = |_, name: &str| bucket(self.seed, name);
        let find = || Groups::new(&self.labels, HASHED_CLUSTERS, of_name);
        self.by_hash.get_or_init(find)
    }
}

/// Index of the hashed cluster of a name.
pub(super) fn bucket(seed: u64, name: &str) -> usize {
    let clusters = u64::try_from(HASHED_CLUSTERS).expect("32 fits");
    let bucket = mix(seed ^ fnv_1a(name.as_bytes())) % clusters;
    usize::try_from(bucket).expect("below 32")
}

/// Rows of a batch, grouped by cluster. The sums of each cluster are then accessed once per batch.
#[derive(Clone, Debug)]
pub(crate) struct Groups {
    rows: Vec<u32>,
    ends: Vec<usize>,
}

impl Groups {
    /// Groups the rows of a batch: `group_of` returns the group of a name. Rows of a group stay in batch order.
    fn new(points: &Labels, groups: usize, group_of: impl Fn(usize, &str) -> usize) -> Groups {
        let names = points.names().iter().enumerate();
        let group_of_name: Vec<usize> = names.map(|(at, name)| group_of(at, name)).collect();
        let group = |name: &u32| group_of_name[*name as usize];
        let mut ends = vec![0; groups];
        points
            .index()
            .iter()
            .for_each(|name| ends[group(name)] += 1);
        let mut start = 0;
        for end in &mut ends {
            start += std::mem::replace(end, start);
        }
        let mut rows = vec![0; points.index().len()];
        for (row, name) in (0..).zip(points.index()) {
            let end = &mut ends[group(name)];
            rows[*end] = row;
            *end += 1;
        }
        Groups { rows, ends }
    }

    /// The same groups after the rows of the batch are sorted by group.
    pub(crate) fn side_by_side(&self) -> Groups {
        Groups {
            rows: (0..).take(self.rows.len()).collect(),
            ends: self.ends.clone(),
        }
    }

    /// All rows, group by group.
    pub(crate) fn rows(&self) -> &[u32] {
        &self.rows
    }

    /// Groups with at least one row: each with its index and its rows.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, &[u32])> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let bounds = starts.zip(&self.ends).enumerate();
        bounds
            .filter(|(_, (start, end))| start < end)
            .map(|(group, (start, &end))| (group, &self.rows[start..end]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_a_group_stand_side_by_side_in_their_order() {
        let mut points = Labels::default();
        ["b", "a", "b", "c"]
            .iter()
            .for_each(|name| points.push(name));
        let groups = Groups::new(&points, 3, |name, _| name);
        let collected: Vec<_> = groups.iter().collect();
        assert_eq!(collected, [(0, &[0, 2][..]), (1, &[1][..]), (2, &[3][..])]);
    }
}
