//! Scores of one dataset whose splits left out different groups, which give no verdict.

use taceva_metrics::Sides;

use crate::results::Study;
use taceva_results::kept_together;

/// Reason why two results of one dataset give no verdict: their splits keep different samples together.
pub(super) fn barred(studies: Sides<&Study>, names: Sides<&str>) -> Option<String> {
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
