//! Describes the tasks of an import for its summary.

use taceva_core::counted;

use super::reading::Reading;
use crate::import::depth_maps::PlannedMaps;
use taceva_dataset::internal::{first_names, shown};
use taceva_dataset::{TaskColumn, TaskLabel};

/// Maximum number of classes with a count in the summary.
const COUNTED: usize = 12;

impl Reading<'_> {
    /// Adds a description of each task, with its number of labels, to the summary.
    pub(super) fn describe_tasks(&mut self) {
        let rows = self.table.rows();
        let maps_of = |name: &str| {
            let own = self.maps.iter().find(|maps| maps.name() == name);
            own.map_or(0, PlannedMaps::count)
        };
        let tasks = self.table.tasks().iter();
        let described = tasks.map(|own| described(own, rows, maps_of(&own.task().name)));
        self.summary.tasks = described.collect();
    }
}

/// Kind, source, number of labels and cluster of a task, in words. `maps` is the number of its depth maps.
fn described(own: &TaskColumn, rows: usize, maps: usize) -> String {
    let task = own.task();
    let (mut labelled, mut counts) = (maps, vec![0_usize; task.names.len()]);
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
    let from = match from.is_empty() {
        true => "an array".to_owned(),
        false => first_names(&from, 1),
    };
    format!(
        "{} = {} of {from}, {labelled} of {} labelled{counts}, cluster `{}`",
        task.name,
        task.kind.name(),
        counted(rows, "sample"),
        task.cluster
    )
}
