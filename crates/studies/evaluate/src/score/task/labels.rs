//! Names of the classes of a task, and columns of classes.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::{counted, nearest, shown};
use taceva_import::CsvTable;

use super::{TaskSpec, TaskTables, listed};
use crate::error::EvaluateError;
use crate::score::row_key::key_of;

/// Greatest number of classes that a table may introduce without names.
const MOST_CLASSES: usize = 1000;

/// Names of the classes, in their order.
pub(super) struct ClassNames {
    names: Vec<String>,
    /// Index of each name. The names `7.0` and `7` have the same index.
    positions: BTreeMap<String, u32>,
    are_stated: bool,
}

impl ClassNames {
    fn new(names: Vec<String>, are_stated: bool) -> ClassNames {
        let keys = names.iter().map(|name| key_of(name).to_owned());
        ClassNames {
            positions: keys.zip(0..).collect(),
            names,
            are_stated,
        }
    }

    /// Stated names, or the names in both tables and their score columns, sorted as text or as numbers.
    ///
    /// # Errors
    /// [`EvaluateError`] for more classes than a table may introduce, fewer than two, or a cell `nan`.
    pub(super) fn of(tables: &TaskTables, task: &TaskSpec) -> Result<ClassNames, EvaluateError> {
        if !task.names.is_empty() {
            return Ok(ClassNames::new(task.names.clone(), true));
        }
        let prefix = super::score_columns::prefix(task);
        let columns = tables.prediction.names().iter();
        let with_scores = columns.filter_map(|name| name.strip_prefix(&prefix));
        let mut found: BTreeSet<String> = with_scores.map(str::to_owned).collect();
        let mut by_table: [BTreeSet<&str>; 2] = Default::default();
        let both = [(&tables.truth, true), (&tables.prediction, false)];
        for ((table, is_needed), own) in both.into_iter().zip(&mut by_table) {
            if !is_needed && !table.has(&task.name) {
                continue;
            }
            let column = table.position(&task.name)?;
            for row in 0..table.rows() {
                let cell = key_of(table.cell(row, column));
                if cell.eq_ignore_ascii_case("nan") {
                    let expected = "expected a class, or an empty cell for a row without a label";
                    return Err(table.refuse(row, column, expected).into());
                }
                if !cell.is_empty() {
                    own.insert(cell);
                }
                if !cell.is_empty() && !found.contains(cell) {
                    found.insert(cell.to_owned());
                }
                if found.len() > MOST_CLASSES {
                    let expected = format!(
                        "column `{1}` has {0} classes or more, expected at most {MOST_CLASSES}: state the classes with --task {2}=KIND:names=A|B, or name another column",
                        found.len(),
                        shown(&task.name),
                        shown(&task.name)
                    );
                    return Err(table.refuse(row, column, &expected).into());
                }
            }
        }
        let [truth, predicted] = &by_table;
        if !predicted.is_empty() && truth.is_disjoint(predicted) {
            return Err(EvaluateError::Tables {
                path: tables.prediction.path().to_owned(),
                problem: format!(
                    "column `{}` has no class of the truth: {}, expected some of {}; write both tables alike, or state the classes with \
                     :names=A|B behind the kind",
                    shown(&task.name),
                    listed(predicted.iter().copied()),
                    listed(truth.iter().copied())
                ),
            });
        }
        let mut names: Vec<String> = found.into_iter().collect();
        let numbers: Option<Vec<i64>> = names.iter().map(|name| name.parse().ok()).collect();
        if numbers.is_some() {
            names.sort_by_key(|name| name.parse::<i64>().unwrap_or_default());
        }
        if names.len() < 2 {
            return Err(EvaluateError::Tables {
                path: tables.truth.path().to_owned(),
                problem: format!(
                    "column `{0}` has {1}, expected two or more: state all classes with --task {0}={2}:names=A|B",
                    shown(&task.name),
                    counted(names.len(), "class"),
                    task.kind.name()
                ),
            });
        }
        Ok(ClassNames::new(names, false))
    }

    /// Names of all classes, in their order.
    pub(super) fn all(&self) -> &[String] {
        &self.names
    }

    /// Position of the positive class of `task`; `None` without a positive class.
    pub(super) fn positive(&self, task: &TaskSpec) -> Option<u32> {
        self.position(task.positive.as_deref()?)
    }

    fn position(&self, name: &str) -> Option<u32> {
        self.positions.get(key_of(name)).copied()
    }

    /// Class in a cell: a name, or the position of a stated name; `None` for other text.
    fn class(&self, cell: &str) -> Option<u32> {
        self.position(cell).or_else(|| {
            let position: u32 = key_of(cell).parse().ok()?;
            (self.are_stated && (position as usize) < self.names.len()).then_some(position)
        })
    }

    /// Remark on class names from the tables; `None` if the caller stated names.
    pub(super) fn note(&self) -> Option<String> {
        (!self.are_stated).then(|| {
            "the classes are those of the tables, because no names are stated; a class that never occurs is unknown".to_owned()
        })
    }
}

/// Column of classes.
pub(super) struct ClassColumn<'a> {
    table: &'a CsvTable,
    column: usize,
    names: &'a ClassNames,
}

impl<'a> ClassColumn<'a> {
    /// Column `name` of `table`.
    pub(super) fn of(
        table: &'a CsvTable,
        name: &str,
        names: &'a ClassNames,
    ) -> Result<ClassColumn<'a>, EvaluateError> {
        Ok(ClassColumn {
            table,
            column: table.position(name)?,
            names,
        })
    }

    /// Class in a row; `None` for an empty cell.
    pub(super) fn class(&self, row: usize) -> Result<Option<u32>, EvaluateError> {
        let cell = self.table.cell(row, self.column);
        if cell.is_empty() {
            return Ok(None);
        }
        let class = self.names.class(cell);
        class.map(Some).ok_or_else(|| {
            let names = self.names.all().iter().map(String::as_str);
            let meant = nearest(cell, names.clone()).map_or_else(String::new, |name| {
                format!("; did you mean `{}`?", shown(name))
            });
            let expected = format!("expected a class of the task, {}{meant}", listed(names));
            self.table.refuse(row, self.column, &expected).into()
        })
    }

    /// Class in a row whose cell may not be empty.
    pub(super) fn stated(&self, row: usize) -> Result<u32, EvaluateError> {
        self.class(row)?.ok_or_else(|| {
            let expected = "expected a class, because the truth has one";
            self.table.refuse(row, self.column, expected).into()
        })
    }
}
