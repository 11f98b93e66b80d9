//! Decides if the cells of a column of classes are names, or positions in the list of names.

use super::Sources;
use super::columns::base_of;
use crate::error::{ImportError, Place, table_error};
use crate::foreign::ForeignTable;
use crate::import::map::ClassMap;
use taceva_dataset::internal::shown;

/// Interpretation of the cells of a column of classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::import) enum ClassCells {
    /// Positions in the list of names, even if a name is an equal number.
    Positions,
    /// Names in the list of names.
    Names,
    /// Positions or names. No name is the position of another name.
    Either,
}

/// Interpretation of the cells of each column of classes, in map order.
///
/// # Errors
/// [`ImportError::Table`] if a name is also the position of another name and the file does not state the interpretation.
pub(super) fn of(sources: &Sources<'_>) -> Result<Vec<ClassCells>, ImportError> {
    let classes = sources.map.classes.iter();
    classes
        .map(|(key, class)| sources.class_cells(key, class))
        .collect()
}

impl Sources<'_> {
    fn class_cells(&self, key: &str, class: &ClassMap) -> Result<ClassCells, ImportError> {
        let Some((name, position)) = class.ambiguous() else {
            return Ok(ClassCells::Either);
        };
        if let Some(part) = class.from.strip_prefix("path.") {
            let mut patterns = self.map.path.iter();
            if patterns.any(|pattern| pattern.is_text(part)) {
                return Ok(ClassCells::Names);
            }
        } else if self.holds_integers(&class.from) {
            return Ok(ClassCells::Positions);
        }
        let other = class.names.get(position).map_or("", String::as_str);
        Err(table_error!(
            Place::file(self.main.path()).in_column(&class.from),
            "[classes] {key}: `names` has \"{}\", which is also the position of \"{}\", so a cell `{position}` is ambiguous. If cells \
                 are positions, use names that are not positions, such as \"class {}\"; if cells are names, use `[attributes]`, which \
                 needs no `names`",
            shown(name),
            shown(other),
            shown(name)
        ))
    }

    /// True if the file states that a column contains integers.
    fn holds_integers(&self, name: &str) -> bool {
        match self.joined_column(name) {
            Some((joined, column)) => joined.holds_integers(column),
            None => holds_integers(&self.main, name),
        }
    }
}

/// True if the file of `table` states that the column `name`, or the column of which `name` is an element, contains integers.
pub(super) fn holds_integers(table: &ForeignTable, name: &str) -> bool {
    let column = if table.has(name) { name } else { base_of(name) };
    table.has(column) && table.holds_integers(column)
}
