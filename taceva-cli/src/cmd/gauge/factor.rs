//! Labels of the rows of a table: part, operator and trial.

use std::borrow::Cow;

use taceva_core::shown;
use taceva_import::{CsvTable, ImportError};
use taceva_results::unescape_csv;

use crate::args::Gauge;

/// Columns that name the part, the operator and the trial of each row.
pub(super) struct Factors {
    part: Factor,
    operator: Factor,
    trial: Factor,
}

/// Labels of one row.
pub(super) struct Labels<'t> {
    pub(super) part: Cow<'t, str>,
    pub(super) operator: Cow<'t, str>,
    pub(super) trial: Cow<'t, str>,
}

/// Columns whose cells together form one label.
struct Factor {
    columns: Vec<usize>,
}

impl Factors {
    pub(super) fn of(table: &CsvTable, args: &Gauge) -> Result<Factors, ImportError> {
        Ok(Factors {
            part: Factor::of(table, &args.part)?,
            operator: Factor::of(table, &args.by)?,
            trial: Factor::of(table, &args.trial)?,
        })
    }

    /// Labels of a row; `None` if one of their cells is empty.
    pub(super) fn labels<'t>(&self, table: &'t CsvTable, row: usize) -> Option<Labels<'t>> {
        Some(Labels {
            part: self.part.label(table, row)?,
            operator: self.operator.label(table, row)?,
            trial: self.trial.label(table, row)?,
        })
    }

    /// Names of all columns, for messages.
    pub(super) fn names(&self, table: &CsvTable) -> String {
        let factors = [&self.part, &self.operator, &self.trial];
        let columns = factors.into_iter().flat_map(|of| &of.columns);
        let names: Vec<String> = columns
            .map(|column| format!("`{}`", shown(&table.names()[*column])))
            .collect();
        names.join(", ")
    }
}

impl Factor {
    fn of(table: &CsvTable, names: &[String]) -> Result<Factor, ImportError> {
        let columns = names.iter().map(|name| table.position(name));
        Ok(Factor {
            columns: columns.collect::<Result<_, _>>()?,
        })
    }

    /// Label of a row: the cell of a single column, or `point_id=a, depth_step=3` for several columns. `None` if one of their cells is empty.
    fn label<'t>(&self, table: &'t CsvTable, row: usize) -> Option<Cow<'t, str>> {
        let cell = |column: usize| {
            let cell = unescape_csv(table.cell(row, column));
            (!cell.is_empty()).then_some(cell)
        };
        if let [only] = self.columns.as_slice() {
            return cell(*only).map(Cow::Borrowed);
        }
        let named = |column: &usize| {
            let name = &table.names()[*column];
            cell(*column).map(|cell| format!("{name}={cell}"))
        };
        let cells: Option<Vec<String>> = self.columns.iter().map(named).collect();
        Some(Cow::Owned(cells?.join(", ")))
    }
}
