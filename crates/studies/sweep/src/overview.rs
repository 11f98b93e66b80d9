//! Results of a sweep as a text table, with one mean for each combination of chosen names.

use std::collections::{BTreeMap, BTreeSet};

use taceva_metrics::{Better, Repeats, catalogue};
use taceva_models::Suggestion;
use taceva_report::{Cell, Column, Table};
use taceva_tasks::TaskScore;

use crate::analysis::{self, Loaded};
use crate::choices::{ends, number};
use crate::condition::Condition;
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::task_list::TaskList;

/// Mean of `metric` over the tasks with equal values of the names in `by`, channel by channel.
///
/// # Errors
/// [`SweepError::Condition`] for a name that no task has; [`SweepError`] if results cannot be read.
pub fn show(
    folder: &SweepFolder,
    list: &TaskList,
    by: &[String],
    metric: &str,
) -> Result<Table, SweepError> {
    if list.is_of_tables() {
        return Err(SweepError::Condition {
            text: "show".to_owned(),
            problem: "the tasks are shards of two tables and have no separate scores: scores of all rows are in score.json".to_owned(),
        });
    }
    let settings: BTreeSet<&str> = list
        .tasks
        .iter()
        .flat_map(|task| task.settings.keys().map(String::as_str))
        .collect();
    let known = || {
        Condition::NAMES
            .into_iter()
            .skip(1)
            .chain(settings.iter().copied())
    };
    for name in by {
        if !known().any(|known| known == name) {
            return Err(SweepError::Condition {
                text: by.join(","),
                problem: format!("no task has `{name}`: {}", Suggestion::of(name, known())),
            });
        }
    }
    check_metric(list, metric)?;
    let loaded = analysis::load(folder, list)?;
    Ok(table(&loaded, by, metric))
}

/// Rejects an unknown metric, and a metric of channels for tasks.
fn check_metric(list: &TaskList, metric: &str) -> Result<(), SweepError> {
    let names: Vec<&str> = match list.is_of_labels() {
        true => TaskScore::METRICS.to_vec(),
        false => catalogue::ALL.iter().map(|metric| metric.id).collect(),
    };
    if names.contains(&metric) {
        return Ok(());
    }
    let suggestion = Suggestion::of(metric, names);
    Err(SweepError::Condition {
        text: metric.to_owned(),
        problem: match list.is_of_labels() {
            true => format!(
                "the sweep scores tasks, so name a score of tasks, such as --metric f1_macro: {suggestion}"
            ),
            false => format!("unknown metric: {suggestion}"),
        },
    })
}

/// Values of one metric and channel to average.
#[derive(Default)]
struct Averaged {
    values: Vec<f64>,
    /// Origins of the samples: `recorded`, `simulated`, `synthetic`.
    sources: BTreeSet<String>,
}

fn table(loaded: &[Loaded<'_>], by: &[String], metric: &str) -> Table {
    let mut order: Vec<Vec<String>> = Vec::new();
    // Values in different units are never averaged.
    let mut values: BTreeMap<(Vec<String>, [String; 2]), Averaged> = BTreeMap::new();
    let mut channels: Vec<[String; 2]> = Vec::new();
    let mut title = Better::named(metric);
    for one in loaded {
        let words = by
            .iter()
            .map(|name| one.task.word(name).unwrap_or_default());
        let words: Vec<String> = words.collect();
        if !order.contains(&words) {
            order.push(words.clone());
        }
        let Some(result) = one.result() else {
            continue;
        };
        for score in result.scores.iter().filter(|score| score.metric == metric) {
            let channel = [score.channel.clone(), score.unit.symbol().to_owned()];
            if !channels.contains(&channel) {
                channels.push(channel.clone());
            }
            let entry = values.entry((words.clone(), channel)).or_default();
            entry.values.extend(score.value.number());
            entry.sources.insert(result.source.clone());
            title = one.task.better(score).beside(metric);
        }
    }
    let head = by.iter().map(|name| Column::new(name.as_str()));
    let head = head.chain(
        [
            "channel",
            "mean",
            "95 % over tasks",
            "tasks",
            "unit",
            "source",
        ]
        .map(Column::new),
    );
    let mut table = Table::new(title, head);
    for words in &order {
        for channel in &channels {
            let Some(Averaged {
                values: of,
                sources,
            }) = values.get(&(words.clone(), channel.clone()))
            else {
                continue;
            };
            let [channel, unit] = channel;
            let mut cells: Vec<Cell> = words.iter().map(|word| Cell::text(word.as_str())).collect();
            cells.push(Cell::text(channel.as_str()));
            if of.is_empty() {
                cells.extend(["none", ""].map(Cell::text));
            } else {
                let mean = of.iter().sum::<f64>() / of.len() as f64;
                let interval = Repeats::of(of).map(|repeats| ends(mean, repeats.interval));
                cells.push(number(mean));
                cells.push(Cell::text(interval.unwrap_or_default()));
            }
            cells.push(Cell::Number(of.len().to_string()));
            cells.push(Cell::text(unit.as_str()));
            let sources: Vec<&str> = sources.iter().map(String::as_str).collect();
            cells.push(Cell::text(sources.join(", ")));
            table.push(cells);
        }
    }
    table.note("Means over all tasks with equal values in these columns, on test parts; the interval describes their spread over all \
        other settings.");
    table
}
