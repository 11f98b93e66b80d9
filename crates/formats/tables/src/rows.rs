//! Checks of the rows that a caller requests from a table.

use crate::error::TableError;
use crate::source::Source;

/// Checks that `sorted` is ascending and that its rows are below `rows`.
pub(crate) fn check_sorted(
    source: &Source,
    name: &str,
    sorted: &[u64],
    rows: u64,
) -> Result<(), TableError> {
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0] > pair[1]) {
        let problem = format!(
            "row {} is requested after row {}: rows must ascend",
            pair[1], pair[0]
        );
        return Err(source.mismatch(name, problem));
    }
    match sorted.last() {
        Some(last) if *last >= rows => Err(source.mismatch(
            name,
            format!("row {last} was requested, but there are {rows} rows, counted from 0"),
        )),
        _ => Ok(()),
    }
}
