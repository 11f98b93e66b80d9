//! Scores to which limits apply.

use taceva_core::nearest;
use taceva_results::Score;

use super::limits_file::Limit;
use crate::results::Study;

/// Score of a study to which a limit applies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Subject<'a> {
    /// Score with all of its variants.
    pub(super) whole: &'a Score,
    /// Name of the variant; `None` for the value of the score itself.
    pub(super) variant: Option<&'a str>,
}

impl<'a> Subject<'a> {
    /// Score of `study` to which `limit` applies, or the reason why there is no score. A limit without a variant applies to the variant that verdicts
    /// use.
    pub(super) fn find(study: &'a Study, limit: &'a Limit) -> Result<Subject<'a>, String> {
        let (metric, variant) = match limit.metric.split_once('.') {
            Some((metric, variant)) => (metric, Some(variant)),
            None => (limit.metric.as_str(), None),
        };
        let whole = study.score(metric, &limit.channel);
        let whole = whole.ok_or_else(|| no_such_score(study, metric, &limit.channel))?;
        let decided_by = whole.decided_by().map(|decides| decides.name.as_str());
        Ok(Subject {
            whole,
            variant: variant.or(decided_by),
        })
    }

    /// Score with the value, unit and interval of the variant, or the reason why the variant is missing.
    pub(super) fn score(&self) -> Result<Score, String> {
        let Some(name) = self.variant else {
            return Ok(self.whole.clone());
        };
        let variant = self.whole.variant(name);
        let variant = variant.ok_or_else(|| "this variant is missing".to_owned())?;
        Ok(Score {
            value: variant.value.clone(),
            unit: variant.unit,
            interval: variant.interval.clone(),
            ..self.whole.clone()
        })
    }
}

/// Reason why `study` lacks the score, with the nearest channel that has the metric.
fn no_such_score(study: &Study, metric: &str, channel: &str) -> String {
    let scores = study.scores.iter().filter(|score| score.metric == metric);
    let channels = scores.map(|score| score.channel.as_str());
    match nearest(channel, channels) {
        Some(known) => format!("this score is missing; did you mean channel `{known}`?"),
        None => "this score is missing".to_owned(),
    }
}

/// Remark on a score in another unit than `limit`; `None` for the same unit.
pub(super) fn other_unit(score: &Score, limit: &Limit) -> Option<String> {
    let (unit, of_limit) = (score.unit, &limit.unit);
    (unit.symbol() != of_limit).then(|| format!("the score is in {unit}, the limit in {of_limit}"))
}
