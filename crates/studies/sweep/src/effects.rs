//! Effect of each setting on tasks that are otherwise equal.

mod dimension;

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_metrics::Repeats;
use taceva_report::{Cell, Column, Table};

use crate::analysis::Loaded;
use crate::choices::{ends, number};
use crate::task_list::TaskList;
use dimension::{Dimension, dimensions};

/// Least number of pairs for which an interval is computed.
const LEAST: usize = 2;

/// Table with one row for each setting, value and channel. It shows the mean difference in test error from the first value, over otherwise equal tasks.
pub(crate) fn table(loaded: &[Loaded<'_>], list: &TaskList, channels: &[String]) -> Table {
    let columns = [
        "setting",
        "value",
        "against",
        "channel",
        "difference of MAE",
        "95 % over pairs",
        "pairs",
        "unit",
    ];
    let mut table = Table::new("The effect of each setting", columns.map(Column::new));
    for dimension in dimensions(list) {
        let Some((first, rest)) = dimension.values.split_first() else {
            continue;
        };
        for value in rest {
            for channel in channels {
                if let Some(row) = row(loaded, &dimension, [value, first], channel) {
                    table.push(row);
                }
            }
        }
    }
    table.note("Each pair has two tasks that differ only in this setting. Their errors on test parts are compared; a negative difference means \
        a smaller error. The name of a model includes the settings that other models do not share. A channel with several units has no row. \
        The interval assumes independent pairs. Pairs from one recording are partly dependent, so the interval is valid for this sweep \
        only. A sweep does not choose models by this table.");
    table
}

fn row(
    loaded: &[Loaded<'_>],
    dimension: &Dimension,
    [value, first]: [&String; 2],
    channel: &str,
) -> Option<Vec<Cell>> {
    let mut pairs: BTreeMap<String, [Option<f64>; 2]> = BTreeMap::new();
    // Errors in different units have no mean, so a row needs the same unit throughout.
    let mut units: Vec<Unit> = Vec::new();
    for one in loaded {
        let word = dimension.word(one.task);
        let side = match word {
            Some(word) if word == *value => 0,
            Some(word) if word == *first => 1,
            _ => continue,
        };
        let Some(score) = one.result().and_then(|result| result.score("mae", channel)) else {
            continue;
        };
        if !units.contains(&score.unit) {
            units.push(score.unit);
        }
        pairs.entry(dimension.beside(one.task)).or_default()[side] = score.value.number();
    }
    let differences: Vec<f64> = pairs
        .values()
        .filter_map(|[value, first]| Some((*value)? - (*first)?))
        .collect();
    let [unit] = units.as_slice() else {
        return None;
    };
    if differences.is_empty() {
        return None;
    }
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    let interval = Repeats::of(&differences).filter(|_| differences.len() >= LEAST);
    Some(vec![
        Cell::text(dimension.title()),
        Cell::text(value.as_str()),
        Cell::text(first.as_str()),
        Cell::text(channel),
        number(mean),
        Cell::text(interval.map_or_else(
            || "none: one pair".to_owned(),
            |over| ends(mean, over.interval),
        )),
        Cell::Number(differences.len().to_string()),
        Cell::text(unit.symbol()),
    ])
}
