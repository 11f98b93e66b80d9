//! Records of a state: counts and exact sums.

use std::collections::BTreeMap;

use crate::exact::ExactSum;
use crate::exact::sorted_map::SortedMap;

/// Counts and exact sums; the schema defines their meaning.
///
/// ```
/// use taceva_metrics::Record;
/// assert!(Record::default().counts.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Record {
    /// Counts, in the order of the schema.
    pub counts: Vec<u64>,
    /// Sums, in the order of the schema.
    pub sums: Vec<ExactSum>,
    /// Unrounded numbers, in the order of the schema; empty if the schema has none.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Vec::is_empty")
    )]
    pub values: Vec<f64>,
    /// Records of groups such as places and scenes, by key. Only groups with samples have a record.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "BTreeMap::is_empty")
    )]
    pub cells: BTreeMap<String, Record>,
}

impl Record {
    /// Counts and sums of a record with exactly `C` counts, `S` sums and no other content.
    pub(crate) fn exactly<const C: usize, const S: usize>(
        &self,
    ) -> Result<(&[u64; C], &[ExactSum; S]), String> {
        if !self.values.is_empty() || !self.cells.is_empty() {
            return Err("the record has values or cells, expected none".to_owned());
        }
        self.with_cells()
    }

    /// Counts and sums of a record with `C` counts and `S` sums. Values and cells are optional.
    pub(crate) fn with_cells<const C: usize, const S: usize>(
        &self,
    ) -> Result<(&[u64; C], &[ExactSum; S]), String> {
        match (
            self.counts.as_slice().try_into(),
            self.sums.as_slice().try_into(),
        ) {
            (Ok(counts), Ok(sums)) => Ok((counts, sums)),
            _ => {
                let found = (self.counts.len(), self.sums.len());
                Err(format!(
                    "{} counts and {} sums, expected {C} and {S}",
                    found.0, found.1
                ))
            }
        }
    }

    /// Cells by key, each converted by `read`. Keys that `parse` does not accept are rejected.
    pub(crate) fn read_cells<K: Ord, T>(
        &self,
        parse: impl Fn(&str) -> Option<K>,
        read: impl Fn(&Record) -> Result<T, String>,
    ) -> Result<SortedMap<K, T>, String> {
        let mut cells = SortedMap::default();
        for (name, record) in &self.cells {
            let key = parse(name).ok_or_else(|| format!("`{name}` is not a key of a cell"))?;
            let sums = read(record).map_err(|what| format!("cell `{name}`: {what}"))?;
            if !cells.insert(key, sums) {
                return Err(format!("cell `{name}` occurs twice"));
            }
        }
        Ok(cells)
    }
}
