//! Finds the names of taxel columns that a map gives by position.

use crate::error::{ImportError, table_error};
use crate::foreign::ForeignTable;
use crate::import::map::{ImportMap, SignalsFrom};
use taceva_dataset::internal::listed;

/// Copy of `map` that names taxel columns which `map` gives by position, from 0; `None` if `map` gives names. For example, `1..64` are positions if
/// the table lacks these names.
///
/// # Errors
/// A table with too few columns.
pub(super) fn with_names(
    map: &ImportMap,
    main: &ForeignTable,
) -> Result<Option<ImportMap>, ImportError> {
    let Some(signals) = &map.signals else {
        return Ok(None);
    };
    let known = main.names();
    let is_position = |column: &String| {
        let number = column.parse::<usize>().ok();
        number.filter(|number| number.to_string() == *column && !known.contains(column))
    };
    let positions: Option<Vec<usize>> = signals.columns().iter().map(is_position).collect();
    let is_delimited = matches!(main, ForeignTable::Delimited(_));
    let positions = positions.filter(|positions| is_delimited && positions.len() > 1);
    let Some(positions) = positions else {
        return Ok(None);
    };
    let names: Option<Vec<String>> = positions
        .iter()
        .map(|position| known.get(*position).cloned())
        .collect();
    let Some(names) = names else {
        let (first, last) = (positions.iter().min(), positions.iter().max());
        let [first, last] = [first, last].map(|end| end.copied().unwrap_or_default());
        return Err(table_error!(
            main.path(),
            "[signals]: `{first}..{last}` are not in the header, and as positions they go beyond its {}, which are 0 to {}: correct \
             `from`, or list names; the columns are {}",
            taceva_core::counted(known.len() as u64, "column"),
            known.len().saturating_sub(1),
            listed(&known)
        ));
    };
    let mut map = map.clone();
    if let Some(signals) = &mut map.signals {
        signals.from = SignalsFrom::Columns(names);
    }
    Ok(Some(map))
}
