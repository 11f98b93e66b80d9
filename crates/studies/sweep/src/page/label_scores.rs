//! Table of the scores of labels, task by task.

use taceva_report::{Cell, Column, Table};
use taceva_results::{Interval, Score};

use crate::analysis::Loaded;
use crate::choices::{ends, number};
use crate::result::OF_CONSTANT;
use crate::task::Task;

/// One row for each score of each task.
pub(super) fn table(loaded: &[Loaded<'_>]) -> Table {
    let columns = [
        "recording",
        "task",
        "split",
        "seed",
        "model",
        "score",
        "value",
        "95 % over clusters",
        "best constant",
        "n",
        "unit",
        "remark",
    ];
    let mut table = Table::new("Scores", columns.map(Column::new));
    for one in loaded {
        for score in one.result().into_iter().flat_map(|result| &result.scores) {
            table.push(row(one.task, score));
        }
    }
    table.note("Every sample is predicted by a model that has learnt from other clusters. A sweep chooses no model by these scores, because \
        they are of test parts. `taceva compare` tests pairs of models on the files of the folder `evaluations`.");
    table
}

fn row(task: &Task, score: &Score) -> [Cell; 12] {
    let value = score.value.number();
    let interval = score.interval.as_ref().and_then(Interval::ends);
    let constant = score.variant(OF_CONSTANT);
    let constant = constant.and_then(|constant| constant.value.number());
    let reason = score.value.reason();
    let standing = score.standing.words().map(str::to_owned);
    [
        Cell::text(task.dataset.as_str()),
        Cell::text(score.channel.as_str()),
        Cell::text(task.division()),
        Cell::Number(task.seed.to_string()),
        Cell::text(task.configuration()),
        Cell::text(task.better(score).beside(&score.metric)),
        value.map_or_else(|| Cell::text("none"), number),
        Cell::text(
            value
                .zip(interval)
                .map_or_else(String::new, |(value, interval)| ends(value, interval)),
        ),
        constant.map_or_else(|| Cell::text(""), number),
        Cell::Number(score.n.to_string()),
        Cell::text(score.unit.symbol()),
        Cell::text(reason.or(standing).unwrap_or_default()),
    ]
}
