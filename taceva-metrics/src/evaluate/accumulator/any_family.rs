//! Type-erased families.

use std::borrow::Cow;
use std::collections::BTreeMap;

use taceva_core::{Batch, Labels};

use super::erased_sums::ErasedSums;
use crate::evaluate::family::{Details, Family, Intervals, Numbers, Output};
use crate::evaluate::metric::Metric;
use crate::exact::record::Record;
use crate::score::value::{InapplicableReason, UndefinedReason};

/// Type-erased [`Family`]: its methods with [`ErasedSums`] instead of typed sums.
pub(crate) trait AnyFamily: Send {
    fn parameters(&self) -> BTreeMap<String, String>;
    fn empty(&self) -> ErasedSums;
    fn deposit(&mut self, parts: &mut ErasedSums, batch: &Batch, rows: Option<&[u32]>);
    fn clusters<'a>(&self, batch: &'a Batch) -> Option<Cow<'a, Labels>>;
    fn unclustered(&self) -> UndefinedReason;
    fn to_records(&self, parts: &ErasedSums) -> Vec<Record>;
    /// Reads the records of a state, one per part.
    fn read_records(&self, records: &[Record]) -> Result<ErasedSums, String>;
    fn outputs(&self, metric: &Metric) -> Vec<Output>;
    fn count(&self, metric: &Metric, parts: &ErasedSums, part: usize) -> u64;
    fn invalid(&self, parts: &ErasedSums, part: usize) -> u64;
    fn numbers(&self, metric: &Metric, output: &Output, parts: &ErasedSums, part: usize)
    -> Numbers;
    fn resampled(
        &self,
        metric: &Metric,
        output: &Output,
        parts: &ErasedSums,
        part: usize,
    ) -> Numbers;
    fn joint(&self, metric: &Metric, output: &Output, parts: &ErasedSums) -> Option<Numbers>;
    fn inapplicable(&self, metric: &Metric, output: &Output) -> Option<InapplicableReason>;
    fn details(&self, metric: &Metric, output: &Output, parts: &ErasedSums) -> Details;
    fn intervals(
        &self,
        metric: &Metric,
        output: &Output,
        clusters: &[&ErasedSums],
    ) -> Option<Intervals>;
}

/// Erases the type of `family`. The result is always `Some`, the return type of `FamilyKind::build`.
pub(crate) fn erased(family: impl Family) -> Option<Box<dyn AnyFamily>> {
    Some(Box::new(Erased(family)))
}

/// A family behind the interface [`AnyFamily`].
struct Erased<F>(F);

impl<F: Family> AnyFamily for Erased<F> {
    fn parameters(&self) -> BTreeMap<String, String> {
        self.0.parameters()
    }

    fn empty(&self) -> ErasedSums {
        ErasedSums::new(self.0.empty())
    }

    fn deposit(&mut self, parts: &mut ErasedSums, batch: &Batch, rows: Option<&[u32]>) {
        self.0.deposit(parts.sums_mut(), batch, rows);
    }

    fn clusters<'a>(&self, batch: &'a Batch) -> Option<Cow<'a, Labels>> {
        self.0.clusters(batch)
    }

    fn unclustered(&self) -> UndefinedReason {
        self.0.unclustered()
    }

    fn to_records(&self, parts: &ErasedSums) -> Vec<Record> {
        let mut records = Vec::new();
        for sums in parts.sums() {
            records.push(self.0.to_record(sums));
        }
        records
    }

    fn read_records(&self, records: &[Record]) -> Result<ErasedSums, String> {
        let expected = self.0.empty().len();
        if records.len() != expected {
            return Err(format!("{} records, expected {expected}", records.len()));
        }
        let mut parts = Vec::with_capacity(expected);
        for (position, record) in records.iter().enumerate() {
            parts.push(self.0.read_record(position, record)?);
        }
        Ok(ErasedSums::new(parts))
    }

    fn outputs(&self, metric: &Metric) -> Vec<Output> {
        self.0.outputs(metric)
    }

    fn count(&self, metric: &Metric, parts: &ErasedSums, part: usize) -> u64 {
        self.0.count(metric, &parts.sums()[part])
    }

    fn invalid(&self, parts: &ErasedSums, part: usize) -> u64 {
        self.0.invalid(&parts.sums()[part])
    }

    fn numbers(
        &self,
        metric: &Metric,
        output: &Output,
        parts: &ErasedSums,
        part: usize,
    ) -> Numbers {
        self.0.numbers(metric, output, &parts.sums()[part])
    }

    fn resampled(
        &self,
        metric: &Metric,
        output: &Output,
        parts: &ErasedSums,
        part: usize,
    ) -> Numbers {
        self.0.resampled(metric, output, &parts.sums()[part])
    }

    fn joint(&self, metric: &Metric, output: &Output, parts: &ErasedSums) -> Option<Numbers> {
        self.0.joint(metric, output, parts.sums())
    }

    fn inapplicable(&self, metric: &Metric, output: &Output) -> Option<InapplicableReason> {
        self.0.inapplicable(metric, output)
    }

    fn details(&self, metric: &Metric, output: &Output, parts: &ErasedSums) -> Details {
        let sums = parts.sums();
        let mut of_output = Vec::new();
        for &part in &output.parts {
            of_output.push(&sums[part]);
        }
        self.0.details(metric, output, &of_output)
    }

    fn intervals(
        &self,
        metric: &Metric,
        output: &Output,
        clusters: &[&ErasedSums],
    ) -> Option<Intervals> {
        let mut sums = Vec::with_capacity(clusters.len());
        for parts in clusters {
            sums.push(parts.sums());
        }
        self.0.intervals(metric, output, &sums)
    }
}
