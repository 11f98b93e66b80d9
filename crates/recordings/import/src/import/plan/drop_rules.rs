//! Checks the rules of `[drop]` that name rows and pictures.

use std::path::{Path, PathBuf};

use super::reading::Reading;
use crate::error::{ImportError, table_error};
use crate::foreign::TableForm;
use crate::import::map::ImportMap;
use crate::import::rows::MappedTable;
use crate::import::warning::ImportWarning;
use crate::source_folder::SourceFolder;
use taceva_core::counted;
use taceva_dataset::internal::shown;

/// Checks that `rows` of `[drop]` names existing tables. The name may be omitted only for a single table.
pub(super) fn check_tables(
    folder: &SourceFolder,
    map: &ImportMap,
    tables: &[PathBuf],
) -> Result<(), ImportError> {
    let relative = |path: &PathBuf| match folder.inside(path, "") {
        itself if itself.is_empty() => ".".to_owned(),
        inside => inside,
    };
    for dropped in &map.drop.rows {
        let number = dropped.row;
        match (&dropped.table, tables) {
            (None, [first, _, ..]) if map.form == TableForm::Files => {
                return Err(table_error!(
                    first,
                    "row {number} in `rows` of [drop]: each of the {} files is a row, so name it: `frames_named = [\"{}\"]`",
                    tables.len(),
                    shown(&relative(first))
                ));
            }
            (None, [first, _, ..]) => {
                return Err(table_error!(
                    first,
                    "row {number} in `rows` of [drop] names none of the {} tables: write `{{ table = \"{}\", row = {number} }}`",
                    tables.len(),
                    shown(&relative(first))
                ));
            }
            (Some(table), [first, ..]) if !tables.iter().any(|path| relative(path) == *table) => {
                return Err(table_error!(
                    first,
                    "row {number} in `rows` of [drop] names `{}`, which is not a table of the map: write its path relative to the folder, \
                     such as `{}`",
                    shown(table),
                    shown(&relative(first))
                ));
            }
            _ => {}
        }
    }
    Ok(())
}

impl Reading<'_> {
    /// Checks that the table has the rows that `[drop]` names.
    pub(super) fn check_dropped_rows(&self, rows: &MappedTable<'_>) -> Result<(), ImportError> {
        let count = rows.rows();
        let own = self.map.drop.rows.iter().filter(|dropped| {
            let table = dropped.table.as_deref();
            table.is_none_or(|table| table == rows.source())
        });
        for dropped in own {
            if dropped.row > count as u64 {
                return Err(table_error!(
                    &self.current,
                    "row {} in `rows` of [drop] does not exist: the table has {}, counted from 1",
                    dropped.row,
                    counted(count, "row")
                ));
            }
        }
        Ok(())
    }

    /// Warns of picture names in `[drop]` that excluded no row. Marks for a missing picture, such as `---`, cause no warning.
    pub(super) fn warn_of_unused_names(&mut self) {
        let is_used = |rule: &str| {
            let mut names = self.summary.dropped.keys().filter_map(|reason| {
                let name = reason.strip_prefix("frame `")?;
                Some(name.split_once('`')?.0)
            });
            let (rule, known) = (Path::new(rule), shown(rule));
            names.any(|name| {
                let path = Path::new(name);
                name == known || !name.is_empty() && (rule.ends_with(path) || path.ends_with(rule))
            })
        };
        let rules = self.map.drop.frames_named.iter();
        let unused =
            rules.filter(|rule| rule.contains(char::is_alphanumeric) && !is_used(rule.as_str()));
        let unused = unused.map(|rule| ImportWarning::DropUnmatched { name: rule.clone() });
        let unused: Vec<ImportWarning> = unused.collect();
        self.summary.warnings.extend(unused);
    }
}
