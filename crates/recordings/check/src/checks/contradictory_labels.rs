//! TAC031: identical frames with different labels of a task.

use std::collections::BTreeMap;

use taceva_core::shown;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use taceva_dataset::{TaskColumn, TaskKind, TaskLabel};

pub(super) static CHECK: Check = Check {
    code: "TAC031",
    name: "contradictory-labels",
    looks_for: "byte-identical frames with different labels of a task",
    hint: "one of the labels is wrong, or the frame does not show what the label names, such as a frame without contact: correct the labels, or drop \
        the rows in the map",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let tasks = evidence.table.tasks().iter();
    tasks.filter_map(|own| of_task(evidence, own)).collect()
}

fn of_task(evidence: &Evidence<'_>, own: &TaskColumn) -> Option<Found> {
    let table = evidence.table;
    let mut first: BTreeMap<_, (usize, TaskLabel)> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (row, entry) in table.frames().iter().enumerate() {
        let (Some(entry), Some(label)) = (entry, own.label(row)) else {
            continue;
        };
        let (before, known) = *first.entry(entry.digest).or_insert((row, label));
        if known != label {
            pairs.push([before, row]);
        }
    }
    let [before, row] = *pairs.first()?;
    let labelled = |row: usize| {
        let sample = shown(&table.samples()[row]);
        match own.class(row) {
            Some(class) => format!("`{sample}` as {}", shown(class)),
            None => format!("`{sample}`"),
        }
    };
    let message = format!(
        "task `{}`: {} of {} samples repeat the frame of an earlier sample with another label, the first {} and {}",
        own.task().name,
        pairs.len(),
        table.rows(),
        labelled(before),
        labelled(row)
    );
    let rows: Vec<usize> = pairs.iter().map(|[_, row]| *row).collect();
    // Untouched frames of a simulation are equal, whatever the outcome of a grasp or the pose of an object.
    let severity = match own.task().kind {
        TaskKind::Outcome | TaskKind::Pose | TaskKind::Place | TaskKind::Depth => Severity::Note,
        _ => Severity::Warning,
    };
    Some(evidence.found(severity, message, &rows))
}
