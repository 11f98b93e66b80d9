//! Scores of one dataset whose splits left out different groups, which give no verdict.

use taceva_metrics::{Sides, catalogue};

use crate::results::Study;
use taceva_results::kept_together;

/// Reason why two results of one dataset give no verdict on `metric`: their splits keep different samples together. A metric without predictions
/// depends on no split.
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
