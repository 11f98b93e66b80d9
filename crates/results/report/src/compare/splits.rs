//! Scores of one dataset that cannot be compared, because their splits leave out different groups.

use taceva_metrics::{Sides, catalogue};

use crate::results::Study;
use taceva_results::kept_together;

/// Reason why `metric` gives no verdict: the results of one dataset have splits that group samples differently. Metrics without predictions do not depend on a
/// split.
pub(super) fn barred(metric: &str, studies: Sides<&Study>, names: Sides<&str>) -> Option<String> {
    if catalogue::find(metric).is_some_and(|metric| !metric.reads_predictions()) {
        return None;
    }
    let is_one_dataset = studies.a.stated("dataset")? == studies.b.stated("dataset")?;
    let [a, b] = [studies.a.stated("split")?, studies.b.stated("split")?];
    (is_one_dataset && kept_together(a) != kept_together(b)).then(|| {
        format!(
            "the splits differ: {} has `{a}`, and {} has `{b}`; evaluate both with one --split",
            names.a, names.b
        )
    })
}
