//! Statistics of every taxel, computed in one pass over a recording.

use std::num::NonZeroUsize;
use taceva_core::random::{FNV_OFFSET, fnv_1a_after};

use taceva_core::{Progress, SignalInfo, Signals};
use taceva_dataset::{Dataset, Pass};

use taceva_evaluate::EvaluateError;

use crate::count::count;

/// Statistics of every taxel of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalFacts {
    /// Grid and unit of the taxels.
    pub info: SignalInfo,
    /// Names of the values, taxel by taxel.
    pub names: Vec<String>,
    /// Statistics of each value, taxel by taxel.
    pub taxels: Vec<TaxelFacts>,
    /// Number of samples read.
    pub samples: u64,
    /// Rows whose values are all zero; empty if this holds for every row.
    pub zero_rows: Vec<usize>,
    /// Rows declared as without contact.
    pub rest_rows: Vec<usize>,
    /// Mean over the rows without contact; `None` if no row is declared so.
    pub rest: Option<Signals>,
    /// Difference of each row from `rest`, as a mean of absolute values over the taxels, in the unit of the signals; empty without `rest`.
    pub distance: Vec<f64>,
}

/// Value, and the number of samples with this value.
///
/// This type gets no further field: a value and its count are complete.
///
/// ```
/// use taceva_check::ValueCount;
/// let least = ValueCount { value: 0.5, count: 3 };
/// assert_eq!((least.value, least.count), (0.5, 3));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueCount {
    /// Value, in the unit of the signals.
    pub value: f32,
    /// Number of samples with this value.
    pub count: u64,
}

/// Statistics of one taxel.
///
/// # Units
/// Values are in the unit of the signals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaxelFacts {
    /// Least value, and the number of samples with it.
    pub least: ValueCount,
    /// Second least value, and the number of samples with it; `None` if all values are equal.
    pub above_least: Option<ValueCount>,
    /// Greatest value, and the number of samples with it.
    pub greatest: ValueCount,
    /// Second greatest value, and the number of samples with it; `None` if all values are equal.
    pub below_greatest: Option<ValueCount>,
    /// Digest of all values in order. Taxels with equal values have equal digests.
    pub series: u64,
}

impl SignalFacts {
    /// Statistics of the taxels of `dataset` before the first sample is added; `None` without signals.
    ///
    /// # Errors
    /// [`EvaluateError`] if the signals without contact cannot be read.
    pub fn empty(dataset: &Dataset) -> Result<Option<SignalFacts>, EvaluateError> {
        let Some(header) = &dataset.header().signals else {
            return Ok(None);
        };
        Ok(Some(SignalFacts {
            info: header.spec.info,
            names: header.spec.column_names().collect(),
            taxels: Vec::new(),
            samples: 0,
            zero_rows: Vec::new(),
            rest_rows: dataset.rest_rows().collect(),
            rest: dataset.rest()?,
            distance: Vec::new(),
        }))
    }

    /// Computes the statistics of `dataset`; `None` without signals.
    pub(crate) fn of(
        dataset: &Dataset,
        progress: &dyn Progress,
    ) -> Result<Option<SignalFacts>, EvaluateError> {
        let Some(mut facts) = SignalFacts::empty(dataset)? else {
            return Ok(None);
        };
        let rows = dataset.all_rows();
        let pass = Pass::new(&rows, NonZeroUsize::MIN, progress);
        dataset.map_rows(
            pass,
            "read signals",
            |row| dataset.signals(row),
            |row, signals| {
                if let Some(signals) = signals {
                    if signals.values().iter().all(|value| value.abs() <= 0.0) {
                        facts.zero_rows.push(row);
                    }
                    facts.add(signals.values());
                }
                Ok(())
            },
        )?;
        Ok(Some(facts))
    }

    /// Adds the `values` of the next sample.
    pub fn add(&mut self, values: &[f32]) {
        if self.taxels.is_empty() {
            let first = values.iter().map(|value| TaxelFacts::first(*value));
            self.taxels = first.collect();
        } else {
            let taxels = self.taxels.iter_mut().zip(values);
            taxels.for_each(|(taxel, value)| taxel.add(*value));
        }
        self.samples += 1;
        if let Some(rest) = &self.rest {
            let differences = values.iter().zip(rest.values());
            let sum: f64 = differences
                .map(|(value, rest)| (f64::from(*value) - f64::from(*rest)).abs())
                .sum();
            self.distance.push(sum / count(values.len()));
        }
    }
}

impl TaxelFacts {
    fn first(value: f32) -> TaxelFacts {
        TaxelFacts {
            least: ValueCount { value, count: 1 },
            above_least: None,
            greatest: ValueCount { value, count: 1 },
            below_greatest: None,
            series: next_in_series(FNV_OFFSET, value),
        }
    }

    fn add(&mut self, value: f32) {
        self.series = next_in_series(self.series, value);
        extend(
            value,
            &mut self.least,
            &mut self.above_least,
            |one, other| one < other,
        );
        extend(
            value,
            &mut self.greatest,
            &mut self.below_greatest,
            |one, other| one > other,
        );
    }

    /// True if all values are equal.
    pub fn is_stuck(&self) -> bool {
        self.above_least.is_none()
    }
}

/// Digest of a series after one more value, in which −0 counts as 0.
fn next_in_series(series: u64, value: f32) -> u64 {
    let value = if value.abs() <= 0.0 { 0.0 } else { value };
    fnv_1a_after(series, &value.to_bits().to_le_bytes())
}

/// Counts `value` in `end`, the most extreme value, or in `next`, the second most extreme. `beyond` is true if its first argument is more extreme.
fn extend(
    value: f32,
    end: &mut ValueCount,
    next: &mut Option<ValueCount>,
    beyond: impl Fn(f32, f32) -> bool,
) {
    if beyond(value, end.value) {
        *next = Some(*end);
        *end = ValueCount { value, count: 1 };
    } else if !beyond(end.value, value) {
        end.count += 1;
    } else {
        match next {
            Some(known) if beyond(known.value, value) => {}
            Some(known) if !beyond(value, known.value) => known.count += 1,
            _ => *next = Some(ValueCount { value, count: 1 }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_what_is_next_to_them_are_counted_in_any_order() {
        for values in [
            [3.0, 1.0, 2.0, 3.0, 1.0, 3.0, 2.0_f32],
            [1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 3.0],
            [3.0, 3.0, 3.0, 2.0, 2.0, 1.0, 1.0],
        ] {
            let mut facts = TaxelFacts::first(values[0]);
            values[1..].iter().for_each(|value| facts.add(*value));
            let counted = |value, count| ValueCount { value, count };
            let next = Some(counted(2.0, 2));
            assert_eq!((facts.least, facts.above_least), (counted(1.0, 2), next));
            assert_eq!(
                (facts.greatest, facts.below_greatest),
                (counted(3.0, 3), next)
            );
        }
        let mut same = TaxelFacts::first(-0.0);
        same.add(0.0);
        assert!(same.is_stuck());
    }
}
