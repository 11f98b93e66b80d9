//! Sums of the errors of each cluster, and of all clusters together.

use std::cell::OnceCell;

use crate::exact::merge::Merge;
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::families::cells::{Cells, add_times};
use crate::stats::{DifferenceLine, OneWaySums};

/// Greatest number of clusters per channel, which limits the memory. With more clusters, all clusters count as unknown.
pub(super) const MOST_CLUSTERS: u64 = 30_000;

/// Greatest number of clusters in one of the 32 groups into which rows are hashed.
///
/// A group of 1,501 is expected among 48,000 clusters, more than `MOST_CLUSTERS`. Its names would only take memory until the groups are merged. At
/// 30,000 clusters a group has about 937, with a standard deviation of 30.
const MOST_OF_GROUP: u64 = 1500;

/// Sums of the errors of one channel, in total and by cluster.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ErrorSums {
    pub(super) n: u64,
    pub(super) n_invalid: u64,
    /// Sums for the line of the errors over the means of truth and prediction.
    pub(super) line: DifferenceLine,
    /// Errors by cluster; a single cell if clusters are unknown or every sample is its own cluster.
    pub(super) clusters: Cells<Moments>,
    pub(super) known: KnownTotals,
}

/// Totals of sums, computed at first use, because several scores need them. Sums are equal whether or not their totals are known.
#[derive(Clone, Debug, Default)]
pub(super) struct KnownTotals(OnceCell<Totals>);

impl PartialEq for KnownTotals {
    fn eq(&self, _: &KnownTotals) -> bool {
        true
    }
}

impl ErrorSums {
    /// Totals over all errors and clusters.
    pub(super) fn totals(&self) -> &Totals {
        self.known.0.get_or_init(|| Totals::of(self))
    }

    /// Forgets the totals. Every change of the sums begins with this call.
    pub(super) fn forget_totals(&mut self) {
        self.known = KnownTotals::default();
    }

    /// Merges all clusters of a group with more than 1,500 clusters. The order of rows has no effect.
    pub(super) fn bound_group(&mut self) {
        if self.is_group_full() {
            self.forget_totals();
            self.clusters.forget_names();
        }
    }

    fn is_group_full(&self) -> bool {
        self.clusters.len() as u64 > MOST_OF_GROUP
    }

    /// Converts the sums of a group of rows to a record for a saved state.
    pub(super) fn to_record(&self) -> Record {
        if self.is_group_full() {
            let mut bounded = self.clone();
            bounded.bound_group();
            return bounded.to_record();
        }
        Record {
            counts: vec![self.n, self.n_invalid, u64::from(self.clusters.are_named())],
            sums: self.line.sums.to_vec(),
            cells: self.clusters.to_records(Moments::to_record),
            ..Record::default()
        }
    }

    /// Reads the sums from a record of a saved state.
    pub(super) fn read_record(record: &Record) -> Result<ErrorSums, String> {
        let (&[n, n_invalid, named], sums) = record.with_cells()?;
        let clusters = Cells::from_record(record, named == 1, Moments::read_record)?;
        let counts = clusters.iter().map(|(_, errors)| errors.n);
        let of_clusters = counts.fold(0, u64::saturating_add);
        if of_clusters != n || !record.values.is_empty() {
            return Err(format!("{of_clusters} errors in clusters, expected {n}"));
        }
        Ok(ErrorSums {
            n,
            n_invalid,
            line: DifferenceLine { sums: sums.clone() },
            clusters,
            known: KnownTotals::default(),
        })
    }
}

impl Merge for ErrorSums {
    fn merge(&mut self, other: &ErrorSums) {
        self.merge_times(other, 1);
    }

    fn merge_times(&mut self, other: &ErrorSums, times: u32) {
        self.forget_totals();
        add_times(&mut self.n, other.n, times);
        add_times(&mut self.n_invalid, other.n_invalid, times);
        self.line.merge_times(&other.line, times);
        self.clusters.merge_times(&other.clusters, times);
        if self.clusters.len() as u64 > MOST_CLUSTERS {
            self.clusters.forget_names();
        }
    }
}

/// Sums over all errors and over clusters, from which value and variants are computed.
#[derive(Clone, Debug, Default)]
pub(super) struct Totals {
    pub(super) line: DifferenceLine,
    pub(super) errors: Moments,
    pub(super) groups: OneWaySums,
    /// True if the cluster of an error is unknown.
    pub(super) is_unnamed: bool,
}

impl Totals {
    fn of(sums: &ErrorSums) -> Totals {
        let mut totals = Totals {
            line: sums.line.clone(),
            is_unnamed: !sums.clusters.are_named(),
            ..Totals::default()
        };
        for (_, errors) in sums.clusters.iter() {
            totals.errors.merge(errors);
            totals.groups.add(errors);
        }
        totals
    }

    /// Totals of all `parts` together.
    pub(super) fn of_all(parts: &[&Totals]) -> Totals {
        let mut all = Totals::default();
        parts.iter().for_each(|part| all.merge(part));
        all
    }

    /// Totals of all `parts` but one, for each part in turn. They are added up without any subtraction.
    pub(super) fn without_each(parts: &[&Totals]) -> Vec<Totals> {
        let mut others = Vec::with_capacity(parts.len());
        let mut after = Totals::default();
        for part in parts.iter().rev() {
            others.push(after.clone());
            after.merge(part);
        }
        others.reverse();
        let mut before = Totals::default();
        for (others, part) in others.iter_mut().zip(parts) {
            others.merge(&before);
            before.merge(part);
        }
        others
    }
}

impl Merge for Totals {
    fn merge(&mut self, other: &Totals) {
        self.line.merge(&other.line);
        self.errors.merge(&other.errors);
        self.groups.merge(&other.groups);
        self.is_unnamed |= other.is_unnamed || self.groups.groups() > MOST_CLUSTERS;
    }
}
