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
    let stated = |study: &Study, key: &str| {
        let found = study.provenance.iter().find(|(name, _)| name == key);
        found.map(|(_, text)| text.clone())
    };
    let is_one_dataset = stated(studies.a, "dataset")? == stated(studies.b, "dataset")?;
    let [a, b] = [stated(studies.a, "split")?, stated(studies.b, "split")?];
    (is_one_dataset && kept_together(&a) != kept_together(&b)).then(|| {
        format!(
            "the splits differ: {} has `{a}`, and {} has `{b}`; evaluate both with one --split",
            names.a, names.b
        )
    })
}
