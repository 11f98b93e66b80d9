//! Samples kept apart by contact point, so that intervals know which of them belong together.

use std::collections::BTreeMap;

use taceva_core::Labels;
use taceva_core::random::mix;

use crate::exact::merge::Merge;

/// Distinct locations up to which each is a cluster of its own.
pub const NAMED_CLUSTERS: usize = 64;
/// Number of clusters to which more locations than that are assigned by hash.
pub const HASHED_CLUSTERS: usize = 32;
/// The name of the only cluster of what is kept whole.
const WHOLE: &str = "all";

/// One summary per cluster of samples.
///
/// The kinds are stages that follow one another and never go back, and which one is reached depends on the set of samples alone: locations
/// are kept by name until there are more than [`NAMED_CLUSTERS`], then by a hash of the name, and once a sample names no
/// location there are no clusters at all. It gets no further variant in a compatible version: states hold it, and another stage would be
/// another state.
///
/// ```
/// use taceva_metrics::{Channel, Clusters, Evaluator, Rows};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
/// evaluator.update_rows(Rows::new().pairs(Channel::FZ, &[0.5, 1.0], &[0.5, 1.0]).points(["left", "right"]))?;
/// let states = evaluator.states()?;
/// assert!(matches!(states[0].clusters(), Clusters::Named(cells) if cells.len() == 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Clusters<T> {
    /// One summary per location, by its name.
    Named(BTreeMap<String, T>),
    /// [`HASHED_CLUSTERS`] summaries; a location's is `mix(seed ^ fnv1a64(name)) mod 32` with [`taceva_core::random::mix`].
    Hashed(Vec<T>),
    /// One summary of everything: some sample named no location.
    Pooled(T),
}

impl<T> Default for Clusters<T> {
    fn default() -> Clusters<T> {
        Clusters::Named(BTreeMap::new())
    }
}

impl<T> Clusters<T> {
    /// The summaries of the clusters in their order, each with a number that stands for its name; `None` if there are no
    /// clusters.
    pub(crate) fn cells(&self) -> Option<Vec<(u64, &T)>> {
        match self {
            Clusters::Named(cells) => {
                let cells = cells.iter();
                Some(
                    cells
                        .map(|(name, cell)| (fnv1a64(name.as_bytes()), cell))
                        .collect(),
                )
            }
            Clusters::Hashed(cells) => Some((0..).zip(cells).collect()),
            Clusters::Pooled(_) => None,
        }
    }

    /// The same clusters with other summaries.
    pub(crate) fn try_map<U, E>(
        &self,
        mut convert: impl FnMut(&T) -> Result<U, E>,
    ) -> Result<Clusters<U>, E> {
        Ok(match self {
            Clusters::Named(cells) => {
                let mut converted = BTreeMap::new();
                for (name, cell) in cells {
                    converted.insert(name.clone(), convert(cell)?);
                }
                Clusters::Named(converted)
            }
            Clusters::Hashed(cells) => {
                let mut converted = Vec::with_capacity(cells.len());
                for cell in cells {
                    converted.push(convert(cell)?);
                }
                Clusters::Hashed(converted)
            }
            Clusters::Pooled(cell) => Clusters::Pooled(convert(cell)?),
        })
    }
}

/// How clusters are made: what an empty one is, and the seed of the hash.
#[derive(Clone, Debug)]
pub(crate) struct Clustering<T> {
    pub(crate) empty: T,
    pub(crate) seed: u64,
}

impl<T: Merge + Clone> Clustering<T> {
    /// Adds `rows` rows, clustered by `points`: `add` gets each cluster's summary with its rows, or with `None` for all.
    pub(crate) fn deposit(
        &self,
        clusters: &mut Clusters<T>,
        rows: usize,
        points: Option<&Labels>,
        mut add: impl FnMut(&mut T, Option<&[u32]>),
    ) {
        if rows == 0 {
            return;
        }
        let Some(points) = points else {
            return add(self.pool(clusters), None);
        };
        if let Clusters::Named(cells) = clusters {
            for name in points.names() {
                self.named(cells, name);
            }
            self.hash_if_crowded(clusters);
        }
        match clusters {
            Clusters::Named(cells) => {
                let groups = Groups::new(points, points.names().len(), |name, _| name);
                for (group, rows) in groups.iter() {
                    add(self.named(cells, &points.names()[group]), Some(rows));
                }
            }
            Clusters::Hashed(cells) => {
                let groups = Groups::new(points, HASHED_CLUSTERS, |_, name| self.bucket(name));
                for (group, rows) in groups.iter() {
                    add(&mut cells[group], Some(rows));
                }
            }
            Clusters::Pooled(cell) => add(cell, None),
        }
    }

    /// Adds `rows` rows that are kept together: whether their clusters are known stays known, which ones they are does not.
    pub(crate) fn deposit_whole(
        &self,
        clusters: &mut Clusters<T>,
        rows: usize,
        are_clustered: bool,
        add: impl FnOnce(&mut T),
    ) {
        if rows == 0 {
            return;
        }
        if !are_clustered {
            return add(self.pool(clusters));
        }
        match clusters {
            Clusters::Named(cells) => add(self.named(cells, WHOLE)),
            Clusters::Hashed(_) => {
                *clusters = self.whole(clusters);
                self.deposit_whole(clusters, rows, are_clustered, add);
            }
            Clusters::Pooled(cell) => add(cell),
        }
    }

    /// The same samples as one cluster, or as none where none were known.
    pub(crate) fn whole(&self, clusters: &Clusters<T>) -> Clusters<T> {
        match clusters {
            Clusters::Named(cells) if cells.is_empty() => Clusters::default(),
            Clusters::Pooled(cell) => Clusters::Pooled(cell.clone()),
            _ => {
                let mut cells = BTreeMap::new();
                cells.insert(WHOLE.to_owned(), self.total(clusters));
                Clusters::Named(cells)
            }
        }
    }

    /// Takes over the clusters of `other`.
    pub(crate) fn merge(&self, clusters: &mut Clusters<T>, other: &Clusters<T>) {
        match other {
            Clusters::Named(theirs) => {
                for (name, cell) in theirs {
                    match clusters {
                        Clusters::Named(cells) => self.named(cells, name).merge(cell),
                        Clusters::Hashed(cells) => cells[self.bucket(name)].merge(cell),
                        Clusters::Pooled(all) => all.merge(cell),
                    }
                    self.hash_if_crowded(clusters);
                }
            }
            Clusters::Hashed(theirs) => {
                self.hash(clusters);
                match clusters {
                    Clusters::Pooled(all) => theirs.iter().for_each(|cell| all.merge(cell)),
                    Clusters::Hashed(cells) => cells.merge(theirs),
                    Clusters::Named(_) => {}
                }
            }
            Clusters::Pooled(cell) => self.pool(clusters).merge(cell),
        }
    }

    /// All clusters together.
    pub(crate) fn total(&self, clusters: &Clusters<T>) -> T {
        let mut total = self.empty.clone();
        match clusters {
            Clusters::Named(cells) => cells.values().for_each(|cell| total.merge(cell)),
            Clusters::Hashed(cells) => cells.iter().for_each(|cell| total.merge(cell)),
            Clusters::Pooled(cell) => total.merge(cell),
        }
        total
    }

    fn named<'a>(&self, cells: &'a mut BTreeMap<String, T>, name: &str) -> &'a mut T {
        if !cells.contains_key(name) {
            cells.insert(name.to_owned(), self.empty.clone());
        }
        cells.get_mut(name).expect("it was there or was inserted")
    }

    fn hash_if_crowded(&self, clusters: &mut Clusters<T>) {
        if matches!(clusters, Clusters::Named(cells) if cells.len() > NAMED_CLUSTERS) {
            self.hash(clusters);
        }
    }

    fn hash(&self, clusters: &mut Clusters<T>) {
        if let Clusters::Named(named) = clusters {
            let mut cells = vec![self.empty.clone(); HASHED_CLUSTERS];
            for (name, cell) in named {
                cells[self.bucket(name)].merge(cell);
            }
            *clusters = Clusters::Hashed(cells);
        }
    }

    fn pool<'a>(&self, clusters: &'a mut Clusters<T>) -> &'a mut T {
        if !matches!(clusters, Clusters::Pooled(_)) {
            *clusters = Clusters::Pooled(self.total(clusters));
        }
        match clusters {
            Clusters::Pooled(cell) => cell,
            _ => unreachable!("it was pooled above"),
        }
    }

    fn bucket(&self, name: &str) -> usize {
        let clusters = u64::try_from(HASHED_CLUSTERS).expect("32 fits");
        let bucket = mix(self.seed ^ fnv1a64(name.as_bytes())) % clusters;
        usize::try_from(bucket).expect("below 32")
    }
}

/// The rows of a batch, those of one cluster side by side: a cluster's sums are then visited once per batch.
struct Groups {
    rows: Vec<u32>,
    ends: Vec<usize>,
}

impl Groups {
    /// Rows by the group of their name; within a group in the order of the batch.
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

    /// The groups that have rows.
    fn iter(&self) -> impl Iterator<Item = (usize, &[u32])> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let bounds = starts.zip(&self.ends).enumerate();
        bounds
            .filter(|(_, (start, end))| start < end)
            .map(|(group, (start, &end))| (group, &self.rows[start..end]))
    }
}

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
pub(crate) fn fnv1a64(bytes: &[u8]) -> u64 {
    fnv1a64_from(FNV_OFFSET, bytes)
}

/// The hash of no byte.
pub(crate) const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;

/// The hash of the bytes behind `hash` and then of `bytes`.
pub(crate) fn fnv1a64_from(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hashes_give_their_published_values() {
        assert_eq!(fnv1a64(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a64(b"foobar"), 0x8594_4171_f739_67e8);
    }

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
