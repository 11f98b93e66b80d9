//! Section `[drop]` of a map, as written.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::Channels;
use toml::Spanned;

use super::check::Check;
use super::{DropRules, DroppedRow, Placeholder};
use taceva_dataset::DatasetError;
use taceva_dataset::internal::toml_error;

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(super) struct WrittenDrop {
    column: Option<String>,
    quality_flags: Vec<String>,
    frames_named: Vec<String>,
    placeholders: BTreeMap<String, f64>,
    rows: Vec<Spanned<WrittenRow>>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "the number of a row, from 1, or { row = 204, table = \"run1.csv\", reason = \"…\" }"
)]
enum WrittenRow {
    Number(u64),
    Described(DescribedRow),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DescribedRow {
    row: u64,
    table: Option<String>,
    reason: Option<String>,
}

impl Check<'_> {
    pub(super) fn drop(
        &self,
        written: WrittenDrop,
        channels: &Channels,
    ) -> Result<DropRules, DatasetError> {
        let stranger = written
            .placeholders
            .keys()
            .find(|name| channels.position(name).is_none());
        if let Some(name) = stranger {
            return Err(toml_error(
                self.path,
                None,
                &format!("[drop.placeholders] names `{name}`, which is not a channel of [columns]"),
            ));
        }
        let rows = written.rows.into_iter().map(|row| self.dropped_row(row));
        Ok(DropRules {
            flag_column: written.column.unwrap_or_else(|| "quality_flags".to_owned()),
            quality_flags: written.quality_flags,
            frames_named: written.frames_named,
            placeholders: written
                .placeholders
                .into_iter()
                .map(|(channel, number)| Placeholder { channel, number })
                .collect(),
            rows: rows.collect::<Result<_, _>>()?,
        })
    }

    fn dropped_row(&self, written: Spanned<WrittenRow>) -> Result<DroppedRow, DatasetError> {
        let offset = written.span().start;
        let dropped = match written.into_inner() {
            WrittenRow::Number(row) => DroppedRow::new(row),
            WrittenRow::Described(described) => DroppedRow {
                row: described.row,
                table: described.table,
                reason: described.reason,
            },
        };
        match dropped.row {
            0 => Err(self.at(
                offset,
                "row 0 in `rows` of [drop]: rows of a table are counted from 1, below its header",
            )),
            _ => Ok(dropped),
        }
    }
}
