//! Adds the skill of a model to all scores of predictions, because verdicts need it.

use taceva_metrics::{Metric, catalogue};

/// Adds the skill score to the metrics `wanted` if one of them uses predictions.
pub fn with_skill(mut wanted: Vec<&'static Metric>) -> Vec<&'static Metric> {
    if wanted.iter().any(|metric| metric.reads_predictions()) {
        wanted.push(skill());
    }
    wanted
}

/// Definition of the skill score.
pub fn skill() -> &'static Metric {
    catalogue::find("skill").expect("`skill` is in the catalogue")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skill_comes_with_what_is_formed_from_predictions_and_with_nothing_else() {
        let asked = |names: &[&str]| {
            let metrics = catalogue::select(names.iter().copied()).expect("known");
            let metrics = with_skill(metrics).into_iter();
            metrics.map(|metric| metric.id).collect::<Vec<_>>()
        };
        assert_eq!(asked(&["r_light"]), ["r_light", "skill"]);
        assert_eq!(asked(&["sensitivity", "sr"]), ["sr", "sensitivity"]);
    }
}
