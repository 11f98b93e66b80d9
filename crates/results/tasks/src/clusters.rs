//! Sums by cluster: trajectory, clip or object.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Sums of each cluster by its name, in the order of names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct ByCluster<T>(BTreeMap<String, T>);

impl<T> Default for ByCluster<T> {
    fn default() -> ByCluster<T> {
        ByCluster(BTreeMap::new())
    }
}

impl<T> ByCluster<T> {
    /// Sums of all clusters, in the order of their names.
    pub(crate) fn values(&self) -> impl Iterator<Item = &T> {
        self.0.values()
    }

    /// Names and sums of all clusters, in the order of the names.
    pub(crate) fn into_sums(self) -> impl Iterator<Item = (String, T)> {
        self.0.into_iter()
    }

    /// Names of all clusters, in order.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Removes the clusters in `names`.
    pub(crate) fn remove(&mut self, names: &[&str]) {
        self.0.retain(|name, _| !names.contains(&name.as_str()));
    }

    /// Mutable sums of all clusters, in the order of their names.
    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.0.values_mut()
    }

    /// Sums of `cluster`, created by `T::default` if missing.
    pub(crate) fn entry(&mut self, cluster: &str) -> &mut T
    where
        T: Default,
    {
        // A known cluster allocates no name. Only a new cluster needs a third lookup.
        if !self.0.contains_key(cluster) {
            self.0.insert(cluster.to_owned(), T::default());
        }
        self.0.get_mut(cluster).expect("inserted above if missing")
    }

    /// Adds the sums of `other`. `add` combines the sums of a cluster that both contain.
    pub(crate) fn merge(&mut self, other: ByCluster<T>, add: impl Fn(&mut T, T))
    where
        T: Default,
    {
        for (cluster, sums) in other.0 {
            add(self.0.entry(cluster).or_default(), sums);
        }
    }
}
