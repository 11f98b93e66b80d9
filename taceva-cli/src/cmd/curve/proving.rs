//! Series of readings of a force proving instrument, from a column with the name of the series.

use anyhow::anyhow;
use taceva_core::shown;
use taceva_import::CsvTable;
use taceva_metrology::curve::ProvingSeries;

use super::Axis;

/// Names of the series. Names of unloading series may end with an apostrophe.
const SERIES: [&str; 6] = ["X1", "X2", "X3", "X4", "X5", "X6"];

/// Reading of an instrument, with the applied force.
struct Reading {
    force: f64,
    value: f64,
}

/// Series by the names in `column`, each ordered by rising force. Skips rows without a name or a number.
pub(super) fn of(
    table: &CsvTable,
    axes: [&Axis; 2],
    column: &str,
) -> anyhow::Result<ProvingSeries> {
    let column = table.position(column)?;
    let mut all: [Vec<Reading>; 6] = Default::default();
    for row in 0..table.rows() {
        let name = table.cell(row, column).trim_end_matches('\'');
        if name.is_empty() {
            continue;
        }
        let Some(at) = SERIES.iter().position(|known| *known == name) else {
            let error = table.refuse(row, column, "expected X1, X2, X3, X4', X5 or X6'");
            return Err(error.into());
        };
        let [x, y] = axes.map(|axis| table.number(row, axis.column));
        if let (Some(force), Some(value)) = (x?, y?) {
            all[at].push(Reading { force, value });
        }
    }
    for series in &mut all {
        series.sort_by(|one, other| one.force.total_cmp(&other.force));
    }
    let [first, ..] = &all;
    let forces: Vec<f64> = first.iter().map(|of| of.force).collect();
    for (name, series) in SERIES.iter().zip(&all) {
        let mut pairs = series.iter().zip(&forces);
        if let Some((of, force)) = pairs.find(|(of, force)| of.force.total_cmp(force).is_ne()) {
            return Err(anyhow!(
                "{}, series {name}: reference value {}, expected {force} as in series X1",
                shown(table.path()),
                of.force
            ));
        }
    }
    let [x1, x2, x3, x4, x5, x6] =
        all.map(|series| series.into_iter().map(|of| of.value).collect::<Vec<f64>>());
    let mut series = ProvingSeries::new(&forces);
    (series.x1, series.x2, series.x3) = (x1, x2, x3);
    (series.x4, series.x5, series.x6) = (x4, x5, x6);
    Ok(series)
}
