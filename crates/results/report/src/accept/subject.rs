//! Scores to which limits apply.

use taceva_results::Score;

use super::limits_file::Limit;
use crate::results::Study;

/// Score of a study to which a limit applies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Subject<'a> {
    /// The score with all of its variants.
    pub(super) whole: &'a Score,
    /// Name of the variant; `None` for the value of the score itself.
    pub(super) variant: Option<&'a str>,
}

impl<'a> Subject<'a> {
    /// Score of `study` to which `limit` applies. A limit without a variant applies to the variant that verdicts use.
    pub(super) fn find(study: &'a Study, limit: &'a Limit) -> Option<Subject<'a>> {
        let (metric, variant) = match limit.metric.split_once('.') {
            Some((metric, variant)) => (metric, Some(variant)),
            None => (limit.metric.as_str(), None),
        };
        let whole = study.score(metric, &limit.channel)?;
        let decided_by = whole.decided_by().map(|decides| decides.name.as_str());
        Some(Subject {
            whole,
            variant: variant.or(decided_by),
        })
    }

    /// The score with value, unit and interval of the variant; `None` if there is no such variant.
    pub(super) fn score(&self) -> Option<Score> {
        let Some(name) = self.variant else {
            return Some(self.whole.clone());
        };
        let variant = self.whole.variant(name)?;
        Some(Score {
            value: variant.value.clone(),
            unit: variant.unit,
            interval: variant.interval.clone(),
            ..self.whole.clone()
        })
    }
}
