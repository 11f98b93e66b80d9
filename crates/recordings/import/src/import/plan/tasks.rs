//! Describes the tasks of an import for its summary.

use taceva_core::counted;

use super::reading::Reading;
use taceva_dataset::internal::{first_names, shown};
use taceva_dataset::{TaskColumn, TaskLabel};

/// Maximum number of classes with a count in the summary.
const COUNTED: usize = 12;

impl Reading<'_> {
    /// Adds each task, with the number of labels, to the summary.
    pub(super) fn describe_tasks(&mut self) {
        let rows = self.table.rows();
        let tasks = self.table.tasks().iter();
        self.summary.tasks = tasks.map(|own| described(own, rows)).collect();
    }
}

/// Kind, source, number of labels and cluster of a task, in words.
fn described(own: &TaskColumn, rows: usize) -> String {
    let task = own.task();
    let (mut labelled, mut counts) = (0_usize, vec![0_usize; task.names.len()]);
    for label in (0..rows).filter_map(|row| own.label(row)) {
        labelled += 1;
        if let TaskLabel::Class(class) = label {
            counts[class as usize] += 1;
        }
    }
    let counts: Vec<String> = task
        .names
        .iter()
        .zip(counts)
        .map(|(name, count)| format!("{} {count}", shown(name)))
        .collect();
    let counts = match counts.is_empty() {
        true => String::new(),
        false => format!(" ({})", first_names(&counts, COUNTED)),
    };
    let from: Vec<String> = task
        .from
        .iter()
        .map(|name| format!("`{}`", shown(name)))
        .collect();
    format!(
        "{} = {} of {}, {labelled} of {} labelled{counts}, cluster `{}`",
        task.name,
        task.kind.name(),
        first_names(&from, 1),
        counted(rows, "sample"),
        task.cluster
    )
}
