//! Summaries of samples by contact point. Intervals need them because samples at one point are correlated.

use std::collections::BTreeMap;

use super::row_groups::{Grouped, HASHED_CLUSTERS, bucket};
use crate::exact::merge::Merge;
use taceva_core::random::fnv_1a;

/// Greatest number of contact points that form separate clusters.
pub const NAMED_CLUSTERS: usize = 64;
/// Name of the cluster if all samples form one cluster.
const WHOLE: &str = "all";

/// One summary per cluster of samples.
///
/// Up to [`NAMED_CLUSTERS`] contact points are stored by name, more contact points by a hash of the name. One sample without a contact point merges
/// all clusters into one summary. The set of samples alone determines the variant. This type gets no further variant in a compatible version, because
/// saved states contain the variant.
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
    /// One summary per contact point, by name.
    Named(BTreeMap<String, T>),
    /// [`HASHED_CLUSTERS`] summaries. A contact point has the index `mix(seed ^ hash) mod 32`, with the FNV-1a `hash` of its name and
    /// [`mix`](taceva_core::random::mix).
    Hashed(Vec<T>),
    /// One summary of all samples, because a sample has no contact point.
    Pooled(T),
}

impl<T> Default for Clusters<T> {
    fn default() -> Clusters<T> {
        Clusters::Named(BTreeMap::new())
    }
}

impl<T> Clusters<T> {
    /// Summaries of the clusters, each with the hash of its name or with its index; `None` if the samples have no clusters.
    pub(crate) fn cells(&self) -> Option<Vec<(u64, &T)>> {
        match self {
            Clusters::Named(cells) => {
                let cells = cells.iter();
                Some(
                    cells
                        .map(|(name, cell)| (fnv_1a(name.as_bytes()), cell))
                        .collect(),
                )
            }
            Clusters::Hashed(cells) => Some((0..).zip(cells).collect()),
            Clusters::Pooled(_) => None,
        }
    }

    /// Converts the summary of each cluster with `convert`; returns the first error.
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

/// Settings for new clusters: an empty summary, and the seed of the hash.
#[derive(Clone, Debug)]
pub(crate) struct Clustering<T> {
    pub(crate) empty: T,
    pub(crate) seed: u64,
}

impl<T: Merge + Clone> Clustering<T> {
    /// Adds `rows` rows to the clusters of their `points`. `add` receives the summary and the rows of each cluster. For rows without clusters, `add`
    /// receives the summary of all samples and `None`.
    pub(crate) fn deposit(
        &self,
        clusters: &mut Clusters<T>,
        rows: usize,
        points: Option<&Grouped<'_>>,
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
                for (group, rows) in points.by_name().iter() {
                    add(self.named(cells, &points.names()[group]), Some(rows));
                }
            }
            Clusters::Hashed(cells) => {
                for (group, rows) in points.by_hash().iter() {
                    add(&mut cells[group], Some(rows));
                }
            }
            Clusters::Pooled(cell) => add(cell, None),
        }
    }

    /// Adds `rows` rows to one summary of all samples. The variant shows if any row had no cluster.
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

    /// Clusters merged into a single cluster. Samples without clusters stay without clusters.
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

    /// Merges the clusters of `other` into `clusters`.
    pub(crate) fn merge(&self, clusters: &mut Clusters<T>, other: &Clusters<T>) {
        match other {
            Clusters::Named(theirs) => {
                for (name, cell) in theirs {
                    match clusters {
                        Clusters::Named(cells) => self.named(cells, name).merge(cell),
                        Clusters::Hashed(cells) => cells[bucket(self.seed, name)].merge(cell),
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

    /// Summary of the samples of all clusters.
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
        cells
            .get_mut(name)
            .expect("the entry exists or was inserted")
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
                cells[bucket(self.seed, name)].merge(cell);
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
}
