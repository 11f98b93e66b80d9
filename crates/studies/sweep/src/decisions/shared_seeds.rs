//! Errors of two configurations, for seeds with a result of both configurations.

use std::collections::BTreeMap;

use taceva_metrics::{ClusterSums, Sides};

use crate::analysis::Group;

/// Errors of both compared configurations, for the seeds with a result of both.
pub(super) struct SharedSeeds {
    /// Errors of each configuration by contact point. A press counts once, even if it was in the test part of several seeds.
    pub(super) sums: Sides<ClusterSums>,
    /// Number of seeds with a result, for each of the two configurations.
    of: Sides<usize>,
    /// Number of shared seeds.
    pub(super) count: usize,
}

impl SharedSeeds {
    /// Computes the shared errors of two groups on `channel`.
    pub(super) fn of(groups: Sides<&Group<'_>>, channel: &str) -> SharedSeeds {
        let [a, b] = [groups.a, groups.b].map(|group| by_seed(group, channel));
        let mut shared = SharedSeeds {
            sums: Sides::default(),
            of: Sides {
                a: a.len(),
                b: b.len(),
            },
            count: 0,
        };
        for (seed, of_a) in &a {
            if let Some(of_b) = b.get(seed) {
                shared.sums.a.merge(of_a);
                shared.sums.b.merge(of_b);
                shared.count += 1;
            }
        }
        shared
    }

    /// Number of compared seeds, as text. Also states the number of seeds of each configuration if some are not shared.
    pub(super) fn words(&self) -> String {
        let Sides { a, b } = self.of;
        match a == self.count && b == self.count {
            true => self.count.to_string(),
            false => format!("{} shared (chosen {a}, other {b})", self.count),
        }
    }
}

/// Errors by contact point of each seed with a result.
fn by_seed(group: &Group<'_>, channel: &str) -> BTreeMap<u64, ClusterSums> {
    let results = group.results.iter();
    results
        .filter_map(|(seed, result)| Some((*seed, result.sums(channel)?)))
        .collect()
}
