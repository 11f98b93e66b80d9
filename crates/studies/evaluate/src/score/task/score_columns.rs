//! Columns `NAME.p.CLASS`: scores of the classes of a task.

use taceva_core::{nearest, shown};
use taceva_import::CsvTable;

use super::labels::ClassNames;
use super::{TaskSpec, TaskTables, is_not_finite, listed};
use crate::error::EvaluateError;
use crate::score::row_key::key_of;

/// Prefix of the score columns of `task`.
pub(super) fn prefix(task: &TaskSpec) -> String {
    format!("{}.p.", task.name)
}

/// Scores of the classes in a table of predictions.
pub(super) struct ScoreColumns<'a> {
    table: &'a CsvTable,
    /// Column of each class, in the order of the names; `None` for a class without a column.
    columns: Vec<Option<usize>>,
}

impl<'a> ScoreColumns<'a> {
    /// Columns of the scores of `task`; `None` if the predictions have no such columns.
    ///
    /// # Errors
    /// [`EvaluateError`] for a column of an unknown class, or if only some classes have a column. If there are two classes, a column of the positive
    /// class suffices.
    pub(super) fn of(
        tables: &'a TaskTables,
        task: &TaskSpec,
        names: &ClassNames,
    ) -> Result<Option<ScoreColumns<'a>>, EvaluateError> {
        let table = &tables.prediction;
        let prefix = prefix(task);
        let refused = |problem: String| EvaluateError::Tables {
            path: table.path().to_owned(),
            problem,
        };
        let of_classes = table
            .names()
            .iter()
            .filter_map(|name| name.strip_prefix(&prefix));
        for class in of_classes {
            if !names.all().iter().any(|name| name == class) {
                return Err(refused(format!(
                    "column `{}` names no class of the task, expected one of {}",
                    shown(&format!("{prefix}{class}")),
                    listed(names.all().iter().map(String::as_str))
                )));
            }
        }
        let position = |class: &String| {
            let name = format!("{prefix}{class}");
            table.names().iter().position(|known| *known == name)
        };
        let columns: Vec<Option<usize>> = names.all().iter().map(position).collect();
        let positive = names.positive(task).map(|at| at as usize);
        let suffices = columns.len() == 2 && positive.is_some_and(|at| columns[at].is_some());
        let classes = names.all().iter().map(String::as_str).zip(&columns);
        let (missing, stated): (Vec<_>, Vec<_>) = classes.partition(|(_, column)| column.is_none());
        if stated.is_empty() {
            return Ok(None);
        }
        if !missing.is_empty() && !suffices {
            let [missing, stated] =
                [missing, stated].map(|of| of.into_iter().map(|(class, _)| class).collect());
            return Err(Unmatched { missing, stated }.refusal(tables, task));
        }
        Ok(Some(ScoreColumns { table, columns }))
    }

    /// True if each class has a column.
    pub(super) fn are_all(&self) -> bool {
        self.columns.iter().all(Option::is_some)
    }

    /// True if a score in a row is NaN or infinite.
    pub(super) fn has_invalid(&self, row: usize) -> bool {
        let mut columns = self.columns.iter().flatten();
        columns.any(|column| is_not_finite(self.table.cell(row, *column)))
    }

    /// Scores of all classes in a row; NaN for a class without a column.
    pub(super) fn scores(&self, row: usize) -> Result<Vec<f64>, EvaluateError> {
        let score = |column: &Option<usize>| match column {
            None => Ok(f64::NAN),
            Some(column) => self.table.number(row, *column)?.ok_or_else(|| {
                let expected = "expected a score, because the truth has a class";
                EvaluateError::from(self.table.refuse(row, *column, expected))
            }),
        };
        self.columns.iter().map(score).collect()
    }

    /// Score of the class at `position`; `None` without a column.
    pub(super) fn of_class(scores: &[f64], position: u32) -> Option<f64> {
        scores
            .get(position as usize)
            .copied()
            .filter(|score| !score.is_nan())
    }

    /// Class with the greatest score, the first of classes with equal scores.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] if only the positive class has scores, which predict no class without a threshold.
    pub(super) fn greatest(
        scores: &[f64],
        task: &TaskSpec,
        names: &ClassNames,
    ) -> Result<u32, EvaluateError> {
        if scores.iter().any(|score| score.is_nan()) {
            return Err(EvaluateError::Request(format!(
                "task `{0}`: only the positive class has scores; add --threshold {0}=0.5, the scores of the other class, or a column `{0}`",
                shown(&task.name)
            )));
        }
        let places = (0_u32..).zip(scores).take(names.all().len());
        let first = |best: (u32, f64), (at, score): (u32, &f64)| {
            if *score > best.1 { (at, *score) } else { best }
        };
        Ok(places.fold((0, f64::NEG_INFINITY), first).0)
    }
}

/// Classes without a column of scores, although other classes have a column.
struct Unmatched<'a> {
    missing: Vec<&'a str>,
    stated: Vec<&'a str>,
}

impl Unmatched<'_> {
    /// Error for a label without a score column. Also names a score column without a label, because either name may be misspelt.
    fn refusal(&self, tables: &TaskTables, task: &TaskSpec) -> EvaluateError {
        let column = |class: &str| format!("{}{class}", prefix(task));
        let first = self.missing[0];
        let absent = |class: &&&str| Label::of(tables, task, class).is_none();
        // If classes are stated, cells may contain their positions, and some classes may not occur.
        let stray = match task.names.is_empty() {
            true => self.stated.iter().find(absent).copied(),
            false => None,
        };
        let is_like = |class: &&&str| nearest(class, self.stated.iter().copied()).is_some();
        let class = match stray {
            Some(stray) => nearest(stray, self.missing.iter().copied()),
            None => self.missing.iter().find(is_like).copied(),
        };
        let class = class.unwrap_or(first);
        let lacking = column(class);
        let Some(label) = Label::of(tables, task, class) else {
            return EvaluateError::Tables {
                path: tables.prediction.path().to_owned(),
                problem: format!(
                    "no column `{}`, although other classes have scores: write a column for each class, or none",
                    shown(&lacking)
                ),
            };
        };
        let remedy = match (stray, nearest(class, self.stated.iter().copied())) {
            (Some(stray), _) => format!(
                ", and no row has the class of the column `{}`: write both alike",
                shown(&column(stray))
            ),
            (None, Some(meant)) => format!(
                "; did you mean `{}`? Correct the label, or write a column for each class",
                shown(meant)
            ),
            (None, None) => ": write a column for each class, or none".to_owned(),
        };
        let expected = format!("no column `{}` has its scores{remedy}", shown(&lacking));
        label
            .table
            .refuse(label.row, label.column, &expected)
            .into()
    }
}

/// First cell with a class.
struct Label<'a> {
    table: &'a CsvTable,
    row: usize,
    column: usize,
}

impl<'a> Label<'a> {
    fn of(tables: &'a TaskTables, task: &TaskSpec, class: &str) -> Option<Label<'a>> {
        let both = [&tables.truth, &tables.prediction].into_iter();
        let mut labels = both.filter_map(|table| {
            let column = table.position(&task.name).ok()?;
            let row = (0..table.rows()).find(|row| key_of(table.cell(*row, column)) == class)?;
            Some(Label { table, row, column })
        });
        labels.next()
    }
}
