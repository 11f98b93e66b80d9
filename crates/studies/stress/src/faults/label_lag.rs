//! Fault of labels: the clock of the labels is late.

use taceva_core::Column;
use taceva_dataset::Dataset;
use taceva_models::Model;

use crate::fault::{Effect, Fault, NO_STIMULUS, Scope};
use crate::labels::{LabelChange, Labels, followers};

pub(super) static FAULT: Fault = Fault {
    id: "label_lag",
    title: "labels are those of a later time: two clocks with an offset",
    parameter: "lag, ms",
    scope: Scope::Fixed,
    table: [5.0, 10.0, 20.0, 50.0, 100.0],
    most: 1000.0,
    note: Some(NO_STIMULUS),
    effect: Effect::Labels(LabelChange { lacks, change }),
};

fn lacks(dataset: &Dataset, _: &Model, rows: &[usize]) -> Option<&'static str> {
    let followers = followers(dataset.table());
    let has_next = rows.iter().any(|row| followers[*row].is_some());
    (!has_next).then_some(
        "no sample is followed by another of its contact within 1 s, so labels have no lag: expected the times `t_s` of a stream",
    )
}

fn change(labels: &Labels<'_>, milliseconds: f64) -> Column {
    let followers = followers(labels.table);
    let rows = labels.rows.iter();
    rows.map(|row| after(labels, &followers, *row, milliseconds / 1e3))
        .collect()
}

/// Label `seconds` after the time of `row`, interpolated linearly; `None` without a label. After the last row of a contact, the label of that row.
fn after(
    labels: &Labels<'_>,
    followers: &[Option<usize>],
    row: usize,
    seconds: f64,
) -> Option<f64> {
    let channels = labels.table.channels();
    let known = labels
        .table
        .truth(channels.position(labels.channel.name())?);
    let times = labels.table.t_s();
    let mut label = known.get(row)?;
    let Some(start) = times[row] else {
        return Some(label);
    };
    let wanted = start + seconds;
    let (mut row, mut time) = (row, start);
    while let Some(next) = followers[row] {
        let (Some(next_time), Some(next_label)) = (times[next], known.get(next)) else {
            break;
        };
        if next_time >= wanted {
            let share = (wanted - time) / (next_time - time);
            return Some(label + share * (next_label - label));
        }
        (row, time, label) = (next, next_time, next_label);
    }
    Some(label)
}
