//! Numbers of labelled and of scored rows of a task.

use taceva_dataset::Dataset;

/// Number of rows with a label of the task called `name`.
pub(super) fn own_labels(dataset: &Dataset, name: &str) -> usize {
    let own = dataset.table().task(name);
    let rows = 0..dataset.table().rows();
    own.map_or(0, |own| {
        rows.filter(|row| own.label(*row).is_some()).count()
    })
}

/// Remark on labelled rows without a score, if there are any.
pub(super) fn unscored(scored: u64, labelled: usize) -> Option<String> {
    (scored != labelled as u64).then(|| {
        format!(
            "{scored} of {labelled} labelled rows are scored; other rows were for training, or lack a picture or signals"
        )
    })
}
