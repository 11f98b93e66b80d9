//! TAC007: test samples whose frame, contact point, cluster or neighbours are also in the training or validation part.

use std::collections::BTreeSet;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use taceva_dataset::TaskColumn;
use taceva_evaluate::{Division, Note};

pub(crate) static CHECK: Check = Check {
    code: "TAC007",
    name: "leakage",
    looks_for: "contact points, clusters of a task, neighbours or identical frames in both the training and the test part",
    hint: "divide with --split by-point (needs `point_id` in the map), by-block, or by-column with a session, an object or the cluster of a task; scores on samples similar to training \
        samples are optimistic",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(divided) = evidence.divided else {
        return Vec::new();
    };
    let split = &divided.split;
    let table = evidence.table;
    let seen: Vec<usize> = split
        .train
        .iter()
        .chain(&split.validation)
        .copied()
        .collect();
    let mut found = Vec::new();

    let digests: BTreeSet<_> = seen
        .iter()
        .filter_map(|&row| Some(table.frames()[row].as_ref()?.digest))
        .collect();
    let is_copy = |row: &usize| {
        table.frames()[*row]
            .as_ref()
            .is_some_and(|entry| digests.contains(&entry.digest))
    };
    let copies: Vec<usize> = split.test.iter().copied().filter(is_copy).collect();
    let mut report = |severity, rows: &[usize], what: &str| {
        if !rows.is_empty() {
            let message = format!("{} of {} test {what}", rows.len(), split.test.len());
            found.push(evidence.found(severity, message, rows));
        }
    };
    report(
        Severity::Error,
        &copies,
        "frames are also in the training or validation part",
    );

    let points: BTreeSet<&str> = seen
        .iter()
        .filter_map(|&row| table.point_id()[row].as_deref())
        .collect();
    let is_known = |row: &usize| {
        table.point_id()[*row]
            .as_deref()
            .is_some_and(|point| points.contains(point))
    };
    let known: Vec<usize> = split.test.iter().copied().filter(is_known).collect();
    let what = "samples share a contact point with the training or validation part";
    report(Severity::Warning, &known, what);
    for (own, clusters) in table.tasks().iter().zip(evidence.clusters) {
        found.extend(shared_clusters(evidence, &seen, own, clusters));
    }
    if let Some(note @ Note::Neighbours { division, .. }) = &divided.neighbours {
        let severity = match division {
            Division::Separated { .. } => Severity::Warning,
            Division::Blocks { .. } | Division::Column(_) => Severity::Note,
        };
        found.push(Found::overall(severity, note.to_string()));
    }
    found
}

/// Finding for labelled test samples whose cluster also has labelled samples among the rows `seen`. The default split ignores clusters, so
/// its shared clusters are no defect of the recording.
fn shared_clusters(
    evidence: &Evidence<'_>,
    seen: &[usize],
    own: &TaskColumn,
    clusters: &[Option<String>],
) -> Option<Found> {
    let labelled = |row: &usize| own.label(*row).is_some();
    let cluster = |row: &usize| clusters[*row].as_deref();
    let learnt: BTreeSet<&str> = { seen.iter() }
        .filter(|row| labelled(row))
        .filter_map(cluster)
        .collect();
    let tested = &evidence.divided?.split.test;
    let tested: Vec<usize> = tested.iter().copied().filter(labelled).collect();
    let all: BTreeSet<&str> = tested.iter().filter_map(cluster).collect();
    let shared = all.intersection(&learnt).count();
    let is_shared = |row: &usize| cluster(row).is_some_and(|cluster| learnt.contains(cluster));
    let rows: Vec<usize> = tested.into_iter().filter(is_shared).collect();
    let task = own.task();
    let message = format!(
        "task `{}`: {shared} of {} clusters (`{}`) of the test part are also in the training or validation part",
        task.name,
        all.len(),
        task.cluster
    );
    let severity = match evidence.is_split_named {
        true => Severity::Error,
        false => Severity::Warning,
    };
    (shared > 0).then(|| evidence.found(severity, message, &rows))
}
