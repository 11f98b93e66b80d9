//! What each setting changes, paired within everything else.

use std::collections::BTreeMap;

use taceva_metrics::Repeats;
use taceva_report::{Cell, Column, Table};

use crate::analysis::Loaded;
use crate::chosen::{ends, number};
use crate::task::Task;
use crate::task_list::TaskList;

/// Pairs that an interval needs.
const LEAST: usize = 2;

/// A row a setting, value and channel: the mean difference of test errors to the first value, over all pairs of tasks that are alike in all else.
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
    for (name, values) in dimensions(list) {
        let Some((first, rest)) = values.split_first() else {
            continue;
        };
        for value in rest {
            for channel in channels {
                if let Some(row) = row(loaded, &name, [value, first], channel) {
                    table.push(row);
                }
            }
        }
    }
    table.note("Each pair is two tasks that differ in this setting alone, on their test parts; a negative difference is a smaller error. A channel whose unit is not the same everywhere has no row. The interval takes pairs for independent, which those of one recording are not quite: it describes this sweep. Nothing is chosen by it.");
    table
}

fn row(
    loaded: &[Loaded<'_>],
    name: &str,
    [value, first]: [&String; 2],
    channel: &str,
) -> Option<Vec<Cell>> {
    let mut pairs: BTreeMap<String, [Option<f64>; 2]> = BTreeMap::new();
    // Errors in several units have no mean; a row is of the unit that the channel has everywhere.
    let mut units: Vec<String> = Vec::new();
    for one in loaded {
        let word = one.task.word(name);
        let side = match word {
            Some(word) if word == *value => 0,
            Some(word) if word == *first => 1,
            _ => continue,
        };
        let Some(score) = one.result().and_then(|result| result.score("mae", channel)) else {
            continue;
        };
        if !units.contains(&score.unit) {
            units.push(score.unit.clone());
        }
        pairs.entry(beside(one.task, name)).or_default()[side] = score.value;
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
        Cell::text(name),
        Cell::text(value.as_str()),
        Cell::text(first.as_str()),
        Cell::text(channel),
        number(mean),
        Cell::text(interval.map_or_else(
            || "none: one pair".to_owned(),
            |over| ends(mean, over.interval),
        )),
        Cell::Number(differences.len().to_string()),
        Cell::text(unit.as_str()),
    ])
}

/// What varies: each with its values in the order of the file.
fn dimensions(list: &TaskList) -> Vec<(String, Vec<String>)> {
    let mut all = list.vary.clone();
    for name in ["model", "split"] {
        let mut values: Vec<String> = Vec::new();
        for word in list.tasks.iter().filter_map(|task| task.word(name)) {
            if !values.contains(&word) {
                values.push(word);
            }
        }
        all.insert(0, (name.to_owned(), values));
    }
    all.retain(|(_, values)| values.len() > 1);
    all
}

/// Everything else of a task. Models have settings of their own, which belong to the model.
fn beside(task: &Task, name: &str) -> String {
    let own = |key: &str| task.settings.get(key).cloned().unwrap_or_default();
    let settings = task.settings.keys().filter(|key| *key != name);
    let settings = settings.map(|key| format!("{key}={}", own(key)));
    let settings: Vec<String> = settings.collect();
    let of = |other: &str| match other == name {
        true => String::new(),
        false => task.word(other).unwrap_or_default(),
    };
    format!(
        "{}|{}|{}|{}|{}",
        of("dataset"),
        of("model"),
        of("split"),
        of("seed"),
        settings.join(" ")
    )
}
