//! TAC030: classes of a task without a sample in one part of the split.

use std::collections::BTreeSet;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use taceva_dataset::TaskColumn;
use taceva_dataset::internal::{first_names, shown};

pub(crate) static CHECK: Check = Check {
    code: "TAC030",
    name: "unseen-classes",
    looks_for: "classes of a task without a sample in the training, the validation or the test part",
    hint: "divide so that each part has every class, or record more trajectories of it: a model cannot learn a class that it never sees, and \
        a score over classes omits a class that is never tested",
    reads: None,
    find,
};

/// Maximum number of classes named in a finding.
const NAMED: usize = 8;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let tasks = evidence.table.tasks().iter();
    tasks.flat_map(|own| of_task(evidence, own)).collect()
}

fn of_task(evidence: &Evidence<'_>, own: &TaskColumn) -> Vec<Found> {
    let task = own.task();
    let seen = |rows: &mut dyn Iterator<Item = usize>| -> BTreeSet<&str> {
        rows.filter_map(|row| own.class(row)).collect()
    };
    let all = seen(&mut (0..evidence.table.rows()));
    let lacking = |here: &BTreeSet<&str>, of: &dyn Fn(&str) -> bool| -> Vec<String> {
        let names = task.names.iter();
        let names = names.filter(|name| of(name) && !here.contains(name.as_str()));
        names.map(|name| shown(name)).collect()
    };
    let mut found = Vec::new();
    let mut report = |severity, place: &str, names: &[String]| {
        if !names.is_empty() {
            let message = format!(
                "task `{}`: {place} has no sample of {} of {} classes: {}",
                task.name,
                names.len(),
                task.names.len(),
                first_names(names, NAMED)
            );
            found.push(Found::overall(severity, message));
        }
    };
    let never = lacking(&all, &|_| true);
    report(Severity::Note, "the recording", &never);
    let Some(divided) = evidence.divided else {
        return found;
    };
    let split = &divided.split;
    for (severity, part, rows) in [
        (Severity::Warning, "the training part", &split.train),
        (Severity::Note, "the validation part", &split.validation),
        (Severity::Warning, "the test part", &split.test),
    ] {
        if !rows.is_empty() {
            let here = seen(&mut rows.iter().copied());
            let names = lacking(&here, &|name| all.contains(name));
            report(severity, part, &names);
        }
    }
    found
}
