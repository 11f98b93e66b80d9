//! TAC030: classes of a task without a sample in the recording, in a part of the named split, or in all folds but one.

use std::collections::BTreeSet;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use taceva_dataset::TaskColumn;
use taceva_dataset::internal::{first_names, shown};
use taceva_evaluate::Divided;

pub(crate) static CHECK: Check = Check {
    code: "TAC030",
    name: "unseen-classes",
    looks_for: "classes of a task without a sample in the training, the validation or the test part",
    hint: "divide so that each part has every class, or record more trajectories of the missing class: a model cannot learn an unseen class, and scores omit an untested class",
    reads: None,
    find,
};

/// Maximum number of classes named in a finding.
const NAMED: usize = 8;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let tasks = evidence.table.tasks().iter().zip(evidence.of_tasks);
    let found = tasks.flat_map(|(own, scored)| of_task(evidence, own, scored.as_ref()));
    found.collect()
}

fn of_task(evidence: &Evidence<'_>, own: &TaskColumn, scored: Option<&Divided>) -> Vec<Found> {
    let task = own.task();
    let seen = |rows: &mut dyn Iterator<Item = usize>| -> BTreeSet<&str> {
        rows.filter_map(|row| own.class(row)).collect()
    };
    let all = seen(&mut (0..evidence.table.rows()));
    let lacking = |is_lacking: &dyn Fn(&str) -> bool| -> Vec<String> {
        let names = task.names.iter().filter(|name| is_lacking(name));
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
    let never = lacking(&|name| !all.contains(name));
    report(Severity::Note, "the recording", &never);
    let Some(scored) = scored else {
        return found;
    };
    if !scored.folds.is_empty() {
        // A model never sees a class that only the tested fold has.
        let folds = scored.folds.iter();
        let folds: Vec<BTreeSet<&str>> =
            folds.map(|rows| seen(&mut rows.iter().copied())).collect();
        let is_in_one = |name: &str| folds.iter().filter(|fold| fold.contains(name)).count() == 1;
        let names = lacking(&is_in_one);
        report(Severity::Warning, "every fold but one", &names);
        return found;
    }
    let split = &scored.split;
    for (severity, part, rows) in [
        (Severity::Warning, "the training part", &split.train),
        (Severity::Note, "the validation part", &split.validation),
        (Severity::Warning, "the test part", &split.test),
    ] {
        if !rows.is_empty() {
            let here = seen(&mut rows.iter().copied());
            let names = lacking(&|name| all.contains(name) && !here.contains(name));
            report(severity, part, &names);
        }
    }
    found
}
