//! Schema of the map sections besides columns and frames: labels in paths, joins, matrices, classes.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::check::{Check, ColumnName};
use super::table_schema::WrittenTable;
use super::{
    ClassMap, JoinBy, JoinMap, Lag, MatrixMap, MatrixRows, PathPattern, Pick, TimeJoin, Unmatched,
};
use crate::foreign::TableForm;
use taceva_dataset::DatasetError;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenPath {
    pattern: Spanned<String>,
    of: Option<ColumnName>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenJoin {
    name: String,
    table: Spanned<WrittenTable>,
    on: Option<WrittenOn>,
    time: Option<WrittenJoinTime>,
    until: Option<ColumnName>,
    pick: Option<Pick>,
    tolerance_ms: Option<f64>,
    lag_ms: Option<WrittenLag>,
    unmatched: Option<Unmatched>,
    #[serde(default)]
    skip: BTreeMap<String, f64>,
    frame_id: Option<String>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "{ column = \"column of the joined table\" }, \"row\" or \"all\""
)]
enum WrittenOn {
    Word(String),
    Columns(BTreeMap<String, ColumnName>),
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a lag in ms, { \"FILE\" = lag in ms, … } or the name of a column that holds the lag"
)]
enum WrittenLag {
    Fixed(f64),
    Files(BTreeMap<String, f64>),
    Column(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct WrittenJoinTime {
    column: ColumnName,
    unit: Spanned<String>,
    zone: Option<Spanned<String>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenMatrix {
    from: Vec<ColumnName>,
    offset: Option<Vec<f64>>,
    by: WrittenRows,
    gives: BTreeMap<String, Spanned<String>>,
    kind: Option<Spanned<String>>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "rows of numbers, or the path of a CSV file without a header"
)]
enum WrittenRows {
    Rows(Vec<Vec<f64>>),
    File(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenClass {
    from: ColumnName,
    names: Vec<String>,
}

impl Check<'_> {
    pub(super) fn path_pattern(
        &self,
        written: Option<Spanned<WrittenPath>>,
    ) -> Result<Option<PathPattern>, DatasetError> {
        let Some(written) = written else {
            return Ok(None);
        };
        let WrittenPath { pattern, of } = written.into_inner();
        let parsed = PathPattern::parse(pattern.get_ref(), of.map(ColumnName::into_name));
        parsed
            .map(Some)
            .map_err(|problem| self.at(pattern.span().start, &problem))
    }

    pub(super) fn joins(
        &self,
        written: Vec<Spanned<WrittenJoin>>,
    ) -> Result<Vec<JoinMap>, DatasetError> {
        let mut joins: Vec<JoinMap> = Vec::new();
        for written in written {
            let offset = written.span().start;
            let join = self.join(written.into_inner(), offset)?;
            let is_name = join
                .name
                .chars()
                .all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
            if !is_name || ["", "path", "row", "file", "key"].contains(&join.name.as_str()) {
                return Err(self.at(
                    offset,
                    &format!(
                        "join name `{}` is reserved or invalid: expected letters, digits or `_`, and not path, row, file or key",
                        join.name
                    ),
                ));
            }
            if joins.iter().any(|known| known.name == join.name) {
                return Err(self.at(offset, &format!("two joins are called `{}`", join.name)));
            }
            joins.push(join);
        }
        Ok(joins)
    }

    fn join(&self, written: WrittenJoin, offset: usize) -> Result<JoinMap, DatasetError> {
        let (file, form) = self.table(&written.table)?;
        if form == TableForm::Files {
            return Err(self.at(offset, "a join needs a table, not `files`"));
        }
        let times = (written.pick, written.tolerance_ms, written.lag_ms);
        let by = match (written.on, written.time, times) {
            (None, None, (None, None, None)) if written.until.is_some() => {
                JoinBy::Until(written.until.map(ColumnName::into_name).unwrap_or_default())
            }
            _ if written.until.is_some() => {
                return Err(self.at(offset, "`until` excludes `on`, `time`, `pick`, `tolerance_ms` and `lag_ms`: it joins the first row \
                    whose number exceeds the number of the row of the main table"));
            }
            (Some(on), None, (None, None, None)) => match on {
                WrittenOn::Word(word) if word == "row" => JoinBy::Row,
                WrittenOn::Word(word) if word == "all" => JoinBy::All,
                WrittenOn::Columns(columns) if !columns.is_empty() => {
                    let columns = columns.into_iter();
                    JoinBy::Columns(columns.map(|(own, other)| (own, other.into_name())).collect())
                }
                _ => return Err(self.at(offset, "invalid `on`, expected { column = \"column of the joined table\" }, \"row\" or \"all\"")),
            },
            (None, Some(time), (pick, Some(tolerance_ms), Some(lag))) => {
                let numbers: Vec<f64> = match &lag {
                    WrittenLag::Fixed(lag) => vec![*lag],
                    WrittenLag::Files(lags) => lags.values().copied().collect(),
                    WrittenLag::Column(_) => Vec::new(),
                };
                let is_finite = numbers.iter().all(|lag| lag.is_finite());
                if !(tolerance_ms >= 0.0 && tolerance_ms.is_finite() && is_finite) {
                    return Err(self.at(offset, "invalid `tolerance_ms` or `lag_ms`, expected a tolerance from 0 and a finite lag"));
                }
                JoinBy::Time(TimeJoin {
                    time: self.time_of(time.column, &time.unit, time.zone.as_ref())?,
                    pick: pick.unwrap_or(Pick::Nearest),
                    tolerance_ms,
                    lag: match lag {
                        WrittenLag::Fixed(lag) => Lag::Fixed(lag),
                        WrittenLag::Files(lags) => Lag::Files(lags),
                        WrittenLag::Column(column) => Lag::Column(column),
                    },
                })
            }
            (None, Some(_), _) => {
                return Err(self.at(offset, "a join by time needs `tolerance_ms`, the greatest time between matched rows, and `lag_ms`, \
                    how far this table's clock is ahead (0 for one clock)"));
            }
            _ => return Err(self.at(offset, "a join has `on`, or `time` with `pick`, `tolerance_ms` and `lag_ms`, or `until`: expected one of the three")),
        };
        Ok(JoinMap {
            name: written.name,
            file,
            form,
            by,
            unmatched: written.unmatched.unwrap_or(Unmatched::Refuse),
            skip: written.skip.into_iter().collect(),
            frame_id: written.frame_id,
        })
    }

    pub(super) fn matrices(
        &self,
        written: &[Spanned<WrittenMatrix>],
    ) -> Result<Vec<MatrixMap>, DatasetError> {
        written.iter().map(|written| self.matrix(written)).collect()
    }

    fn matrix(&self, written: &Spanned<WrittenMatrix>) -> Result<MatrixMap, DatasetError> {
        let offset = written.span().start;
        let written = written.get_ref();
        let is_rotation = match &written.kind {
            None => false,
            Some(kind) if kind.get_ref() == "rotation" => true,
            Some(kind) => {
                return Err(self.at(kind.span().start, "unknown `kind`, expected \"rotation\""));
            }
        };
        // The order in the file is the order of the matrix rows.
        let mut gives: Vec<_> = written.gives.iter().collect();
        gives.sort_by_key(|(_, unit)| unit.span().start);
        let gives: Result<Vec<_>, DatasetError> = gives
            .into_iter()
            .map(|(name, unit)| Ok((name.clone(), self.unit(unit)?)))
            .collect();
        let by = match &written.by {
            WrittenRows::Rows(rows) => MatrixRows::Written(rows.clone()),
            WrittenRows::File(file) => {
                self.relative(file, offset)?;
                MatrixRows::File(file.clone())
            }
        };
        let from: Vec<String> = written
            .from
            .iter()
            .cloned()
            .map(ColumnName::into_name)
            .collect();
        let taken = written
            .offset
            .clone()
            .unwrap_or_else(|| vec![0.0; from.len()]);
        let map = MatrixMap {
            from,
            offset: taken,
            by,
            gives: gives?,
            is_rotation,
        };
        if map.offset.len() != map.from.len() {
            let problem = format!(
                "`offset` has {} numbers, expected {}, one for each column of `from`",
                map.offset.len(),
                map.from.len()
            );
            return Err(self.at(offset, &problem));
        }
        if let MatrixRows::Written(rows) = &map.by
            && let Some(problem) = map.problem(rows)
        {
            return Err(self.at(offset, &problem));
        }
        Ok(map)
    }

    pub(super) fn classes(
        &self,
        written: &BTreeMap<String, Spanned<WrittenClass>>,
    ) -> Result<BTreeMap<String, ClassMap>, DatasetError> {
        let classes = written.iter().map(|(name, class)| {
            let offset = class.span().start;
            let class = class.get_ref();
            let mut sorted: Vec<&String> = class.names.iter().collect();
            sorted.sort_unstable();
            if sorted.is_empty() || sorted.windows(2).any(|pair| pair[0] == pair[1]) {
                return Err(self.at(offset, "`names` needs every class, each once"));
            }
            let map = ClassMap {
                from: class.from.clone().into_name(),
                names: class.names.clone(),
            };
            Ok((name.clone(), map))
        });
        classes.collect()
    }
}
