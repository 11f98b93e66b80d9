//! TAC032: poses of a task whose quaternion does not have norm 1.

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use taceva_dataset::TaskLabel;

pub(super) static CHECK: Check = Check {
    code: "TAC032",
    name: "quaternion-norms",
    looks_for: "poses of a task whose quaternion has a norm other than 1 ± 0.000001",
    hint: "write quaternions in full precision and in the order x, y, z, w, then import again; a quaternion of another norm is not a rotation",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let rows = 0..evidence.table.rows();
    let tasks = evidence.table.tasks().iter();
    let found = tasks.filter_map(|own| {
        let norm = |row: usize| own.label(row).and_then(|label| label.quaternion_norm());
        let is_wrong = |row: &usize| {
            norm(*row).is_some_and(|norm| (norm - 1.0).abs() > TaskLabel::NORM_TOLERANCE)
        };
        let wrong: Vec<usize> = rows.clone().filter(is_wrong).collect();
        let first = norm(*wrong.first()?)?;
        let message = format!(
            "task `{}`: {} of {} poses have a quaternion that is not a rotation, the first with norm {first}",
            own.task().name,
            wrong.len(),
            rows.clone().filter(|row| norm(*row).is_some()).count()
        );
        Some(evidence.found(Severity::Error, message, &wrong))
    });
    found.collect()
}
