//! Source of taxel values in a map, as written and as checked.

use serde::Deserialize;
use taceva_core::{SignalInfo, SourceUnit};
use toml::Spanned;

use super::check::{Check, ColumnName};
use taceva_dataset::{DatasetError, SignalsSpec};

/// Source and layout of taxel values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SignalsMap {
    pub(crate) from: SignalsFrom,
    /// Unit of the source.
    pub(crate) unit: SourceUnit,
    /// Taxels in the stored unit. The ranges of rows without contact are set later.
    pub(crate) spec: SignalsSpec,
    /// Numbers that mean "not measured", before conversion. A row that contains such a number is left out.
    pub(crate) placeholders: Vec<f64>,
    /// True if values are grouped by channel; false if values are grouped by taxel position.
    pub(crate) is_channel_first: bool,
    /// Ranges of rows without contact, counted in the order of reading, each as first and last row, from 0.
    pub(crate) rest: Vec<[u64; 2]>,
}

/// Source of the numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SignalsFrom {
    /// Columns with one number each, or a single column with all numbers in each cell.
    Columns(Vec<String>),
    /// Array in another file, with one row per table row.
    Array { file: String, path: Option<String> },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenSignals {
    from: Spanned<WrittenFrom>,
    unit: Spanned<String>,
    places: [u32; 2],
    channels: Vec<String>,
    order: Option<Order>,
    #[serde(default)]
    placeholders: Vec<f64>,
    rest: Option<Spanned<WrittenRest>>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a column, several as \"1..15\" or a list, or { file = …, path = … }"
)]
enum WrittenFrom {
    Text(String),
    Columns(Vec<ColumnName>),
    Array(WrittenArray),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenArray {
    file: String,
    path: Option<String>,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Order {
    PlaceFirst,
    ChannelFirst,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a range of rows such as \"0..99\", the last one included, or a list of ranges"
)]
enum WrittenRest {
    Run(String),
    Runs(Vec<String>),
}

impl SignalsMap {
    /// Columns of the taxel values; empty for an array.
    pub(crate) fn columns(&self) -> &[String] {
        match &self.from {
            SignalsFrom::Columns(columns) => columns,
            SignalsFrom::Array { .. } => &[],
        }
    }

    /// True if `number`, before conversion, means "not measured".
    pub(crate) fn is_placeholder(&self, number: f64) -> bool {
        let mut placeholders = self.placeholders.iter();
        placeholders.any(|known| {
            number
                .partial_cmp(known)
                .is_some_and(std::cmp::Ordering::is_eq)
        })
    }

    /// True if `row`, counted over all tables, is declared as without contact.
    pub(crate) fn is_rest(&self, row: u64) -> bool {
        let mut runs = self.rest.iter();
        runs.any(|[first, last]| (first..=last).contains(&&row))
    }
}

impl Check<'_> {
    pub(super) fn signals(
        &self,
        written: Spanned<WrittenSignals>,
    ) -> Result<SignalsMap, DatasetError> {
        let offset = written.span().start;
        let written = written.into_inner();
        let unit = self.unit(&written.unit)?;
        let [rows, columns] = written.places;
        let channels = u32::try_from(written.channels.len()).unwrap_or(u32::MAX);
        let info = SignalInfo::new(rows, columns, channels, unit.unit());
        let info = info.map_err(|error| self.at(offset, &error.to_string()))?;
        let spec = SignalsSpec::new(info, written.channels);
        let spec = spec.map_err(|problem| self.at(offset, &problem))?;
        let has_order = info.channels > 1 && info.rows.max(info.columns) > 1;
        if has_order && written.order.is_none() {
            return Err(self.at(
                offset,
                "[signals] with several numbers at several places needs `order`: \"place-first\" if the numbers of a place are adjacent, \
                 \"channel-first\" if those of a channel are",
            ));
        }
        let from_at = written.from.span().start;
        let from = self.signals_from(written.from.into_inner(), from_at)?;
        if let SignalsFrom::Columns(columns) = &from
            && columns.len() > 1
            && columns.len() != info.len()
        {
            return Err(self.at(
                from_at,
                &format!(
                    "{} columns for {info}, expected one or {}",
                    columns.len(),
                    info.len()
                ),
            ));
        }
        Ok(SignalsMap {
            from,
            unit,
            spec,
            placeholders: written.placeholders,
            is_channel_first: written.order == Some(Order::ChannelFirst),
            rest: self.rest(written.rest)?,
        })
    }

    fn signals_from(
        &self,
        written: WrittenFrom,
        offset: usize,
    ) -> Result<SignalsFrom, DatasetError> {
        Ok(match written {
            WrittenFrom::Array(WrittenArray { file, path }) => {
                self.relative(&file, offset)?;
                SignalsFrom::Array { file, path }
            }
            WrittenFrom::Columns(columns) => {
                if columns.is_empty() {
                    return Err(self.at(offset, "no column, expected at least one"));
                }
                let names = columns.into_iter().map(ColumnName::into_name);
                SignalsFrom::Columns(names.collect())
            }
            WrittenFrom::Text(text) => {
                let columns = columns_of(&text).map_err(|problem| self.at(offset, &problem))?;
                SignalsFrom::Columns(columns)
            }
        })
    }

    fn rest(&self, written: Option<Spanned<WrittenRest>>) -> Result<Vec<[u64; 2]>, DatasetError> {
        let Some(written) = written else {
            return Ok(Vec::new());
        };
        let offset = written.span().start;
        let texts = match written.into_inner() {
            WrittenRest::Run(text) => vec![text],
            WrittenRest::Runs(texts) => texts,
        };
        let runs = texts.iter().map(|text| {
            let (first, last) = text.split_once("..").unwrap_or((text, text));
            let bounds = [first, last].map(|bound| bound.trim().parse::<u64>().ok());
            match bounds {
                [Some(first), Some(last)] if first <= last => Ok([first, last]),
                _ => Err(self.at(
                    offset,
                    &format!(
                        "`{}`: expected rows such as \"0..99\", the last one included",
                        taceva_dataset::internal::shown(text)
                    ),
                )),
            }
        });
        runs.collect()
    }
}

/// Columns that `text` names. `1..15` names the columns with these numbers after any prefix, both ends included; another text names one column.
fn columns_of(text: &str) -> Result<Vec<String>, String> {
    let Some((before, last)) = text.split_once("..") else {
        return Ok(vec![text.to_owned()]);
    };
    let prefix = before.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let bounds = [&before[prefix.len()..], last].map(|bound| bound.parse::<u32>().ok());
    match bounds {
        [Some(first), Some(last)] if first <= last && last - first < SignalInfo::LEN_MAX => {
            Ok((first..=last)
                .map(|number| format!("{prefix}{number}"))
                .collect())
        }
        _ => Err(format!(
            "`{}`: expected columns by number such as \"1..15\" (positions) or \"s0..3\" (s0 to s3), the last one included, and at most {} columns",
            taceva_dataset::internal::shown(text),
            SignalInfo::LEN_MAX
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_of_columns_has_its_last_one_and_keeps_what_stands_before() {
        let names = |text| columns_of(text).expect("columns");
        assert_eq!(names("1..3"), ["1", "2", "3"]);
        assert_eq!(names("skin.s8..10"), ["skin.s8", "skin.s9", "skin.s10"]);
        assert_eq!(names("value"), ["value"]);
        for wrong in ["3..1", "1..", "..2", "0..4294967295", "a..b"] {
            assert!(columns_of(wrong).is_err(), "{wrong}");
        }
    }
}
