//! Scores of one dataset that cannot be compared, because their splits leave out different groups or their test parts differ.

use taceva_metrics::{Sides, catalogue};

use crate::results::Study;
use taceva_results::kept_together;

/// Reason why `metric` gives no verdict: the results of one dataset have splits that group samples differently, or were tested on different samples. Metrics
/// without predictions do not depend on a split.
pub(crate) fn barred(metric: &str, studies: Sides<&Study>, names: Sides<&str>) -> Option<String> {
    if catalogue::find(metric).is_some_and(|metric| !metric.reads_predictions()) {
        return None;
    }
    if studies.a.stated("dataset")? != studies.b.stated("dataset")? {
        return None;
    }
    let both = [studies.a, studies.b];
    if let [Some(a), Some(b)] = both.map(|study| study.stated("split"))
        && kept_together(a) != kept_together(b)
    {
        return Some(format!(
            "the splits differ: {} has `{a}`, and {} has `{b}`; evaluate both with one --split",
            names.a, names.b
        ));
    }
    let [a, b] = both.map(Study::tested_part);
    let (a, b) = (a?, b?);
    (a != b).then(|| {
        format!(
            "the test parts differ: {} was tested on {a}, and {} on {b}; evaluate both with one --split, --seed and --part",
            names.a, names.b
        )
    })
}
