//! TAC033: depth maps of a task without a valid pixel, of several sizes, or in a wrong unit.

use crate::depth_facts::{DepthFacts, OneMap};
use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

/// Greatest depth that a gel can have, mm.
const DEEPEST_MM: f64 = 50.0;

pub(crate) static CHECK: Check = Check {
    code: "TAC033",
    name: "depth-maps",
    looks_for: "depth maps of a task without a valid pixel, of several sizes, or deeper than 50 mm",
    hint: "state `invalid`, `unit` and `scale` of [task.NAME] as in the program that wrote the maps, and import maps of one size",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let of_task = |own: &DepthFacts| {
        let task = &own.task;
        let found = |severity, message: String, rows: &[usize]| {
            let message = format!("task `{task}`: {message}");
            evidence.found(severity, message, rows)
        };
        let rows = |is_wrong: &dyn Fn(&OneMap) -> bool| -> Vec<usize> {
            let wrong = own.maps.iter().filter(|map| is_wrong(map));
            wrong.map(|map| map.row).collect()
        };
        let mut all = Vec::new();
        if let Some(problem) = &own.unit_problem {
            all.push(found(Severity::Error, problem.clone(), &[]));
        }
        let count = own.maps.len();
        let invalid = rows(&|map| map.valid == 0);
        if !invalid.is_empty() {
            let message = format!(
                "{} of {count} depth maps have no valid pixel",
                invalid.len()
            );
            all.push(found(Severity::Warning, message, &invalid));
        }
        if let Some(first) = own.maps.first() {
            let other = rows(&|map| map.size != first.size);
            if !other.is_empty() {
                let [height, width] = first.size;
                let message = format!(
                    "{} of {count} depth maps have another size than the first, {height} x {width} pixels",
                    other.len()
                );
                all.push(found(Severity::Error, message, &other));
            }
        }
        let deep = rows(&|map| map.greatest > DEEPEST_MM);
        if !deep.is_empty() {
            let depths = own.maps.iter().map(|map| map.greatest);
            let message = format!(
                "{} of {count} depth maps have depths above {DEEPEST_MM} mm, up to {} mm: their unit or scale may be wrong",
                deep.len(),
                depths.fold(0.0, f64::max)
            );
            all.push(found(Severity::Warning, message, &deep));
        }
        all
    };
    evidence.maps.iter().flat_map(of_task).collect()
}
