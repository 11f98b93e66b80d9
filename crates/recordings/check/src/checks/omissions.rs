//! TAC021: data of an imported folder that the recording lacks.

use std::collections::BTreeMap;

use taceva_core::{by_count, counted, shown};
use taceva_dataset::internal::first_names;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC021",
    name: "left-out",
    looks_for: "data that the import left out: rows, images, frames that no row uses, chunks that were never written, and unused rows of joined tables",
    hint: "compare the counts with those that you expect; `taceva import --explain` shows them again, and the distances in time of \
        matches",
    reads: None,
    find,
};

/// Maximum number of files or columns named in a message.
const NAMED: usize = 5;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let left_out = &evidence.header.left_out;
    let (unmatched, by_rule): (BTreeMap<String, u64>, BTreeMap<String, u64>) = left_out
        .rows
        .clone()
        .into_iter()
        .partition(|(rule, _)| rule.starts_with("join "));
    let kept = evidence.table.rows();
    let mut joined_rows = left_out.joined_rows.clone();
    let read = kept as u64 + left_out.rows.values().sum::<u64>();
    joined_rows.retain(|name, unused| !(*unused > read && is_by_time(evidence, name)));
    let one = |count: u64, what: &str| match count {
        0 => BTreeMap::new(),
        count => BTreeMap::from([(what.to_owned(), count)]),
    };
    let images = one(left_out.images, "images");
    let columns = one(left_out.columns, "columns");
    let counts = [
        (
            Severity::Warning,
            &left_out.absent_chunks,
            "chunk",
            [
                "was never written; it reads as the fill value of the array",
                "were never written; they read as the fill value of the array",
            ],
        ),
        (
            Severity::Warning,
            &unmatched,
            "row",
            [
                "is not in the recording, because no row of a joined table matches it",
                "are not in the recording, because no row of a joined table matches them",
            ],
        ),
        (
            Severity::Note,
            &by_rule,
            "time",
            ["a rule of the map left a row out (several rules may leave out the same row)"; 2],
        ),
        (
            Severity::Note,
            &joined_rows,
            "row",
            [
                "of joined tables matches no row of the tables",
                "of joined tables match no row of the tables",
            ],
        ),
        (
            Severity::Note,
            &left_out.skipped_rows,
            "row",
            [
                "of joined tables was skipped by the map",
                "of joined tables were skipped by the map",
            ],
        ),
        (
            Severity::Note,
            &left_out.frames,
            "frame",
            [
                "of arrays and clips is used by no row",
                "of arrays and clips are used by no row",
            ],
        ),
        (
            Severity::Note,
            &images,
            "image",
            ["is named by no row", "are named by no row"],
        ),
        (
            Severity::Note,
            &columns,
            "more column",
            [
                "than those listed is named by no key of the map",
                "than those listed are named by no key of the map",
            ],
        ),
    ];
    let counts = counts
        .into_iter()
        .filter(|(_, counts, ..)| !counts.is_empty());
    counts
        .map(|(severity, counts, noun, [one, many])| {
            let sum: u64 = counts.values().sum();
            let message = format!(
                "{} {} ({}; {} {} kept)",
                counted(sum, noun),
                by_count(sum, one, many),
                named(counts),
                counted(kept, "row"),
                by_count(kept, "is", "are")
            );
            Found::overall(severity, message)
        })
        .collect()
}

/// True if the table `name` is joined by time. Such a log may be faster than the main table, so unused rows are normal.
fn is_by_time(evidence: &Evidence<'_>, name: &str) -> bool {
    let mut joins = evidence.header.joins.iter();
    joins.any(|join| join.name == name && join.by == "time")
}

/// Names with their counts, at most [`NAMED`] of them.
fn named(counts: &BTreeMap<String, u64>) -> String {
    let words = counts.iter();
    let words = words.map(|(name, count)| format!("{} {count}", shown(name)));
    first_names(&words.collect::<Vec<_>>(), NAMED)
}
