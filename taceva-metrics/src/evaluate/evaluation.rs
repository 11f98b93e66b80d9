//! Finished scores, printed as a table, serialized as a report, or iterated.

mod handles;
#[cfg(feature = "serde")]
mod json;
mod summary;
mod table;

use std::collections::BTreeMap;

use taceva_core::Skipped;

use crate::evaluate::entry::Entry;
use crate::evaluate::metric::Metric;
use crate::evaluate::verdicts;
use crate::score::Score;
use crate::score::verdict_standing::Standing;

/// Scores of an evaluation, in the order of reports, and the skipped metrics. `{}` prints one line per channel, `{:#}` every score.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
/// evaluator.update_pairs(Channel::FZ, &[0.25, 0.5], &[0.5, 0.5])?;
/// let evaluation = evaluator.finish()?;
/// assert!(evaluation.scores().any(|(metric, channel, _)| metric.id == "rmse" && channel == "Fz"));
/// assert!(evaluation.to_string().starts_with("channel"));
/// assert!(format!("{evaluation:#}").starts_with("metric"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Evaluation {
    entries: Vec<Entry>,
    skipped: Vec<Skipped>,
}

impl Evaluation {
    pub(crate) fn new(mut entries: Vec<Entry>, skipped: Vec<Skipped>) -> Evaluation {
        verdicts::set_standings(&mut entries);
        Evaluation { entries, skipped }
    }

    /// Combines the scores of `parts` into one evaluation, in the order of `catalogue`.
    pub(crate) fn in_order(
        catalogue: &[&Metric],
        parts: impl IntoIterator<Item = Evaluation>,
        skipped: Vec<Skipped>,
    ) -> Evaluation {
        let mut entries: Vec<Entry> = parts.into_iter().flat_map(|part| part.entries).collect();
        entries.sort_by_key(|entry| {
            let mut order = catalogue.iter();
            order.position(|metric| metric.id == entry.metric.id)
        });
        Evaluation::new(entries, skipped)
    }

    /// Adds to each score of predictions the share of predictions beyond the bounds of the model, from `shares` by channel. A score of several
    /// channels gets the greatest share of its channels.
    #[must_use]
    pub fn with_bounded_shares(mut self, shares: &BTreeMap<String, f64>) -> Evaluation {
        for entry in &mut self.entries {
            if entry.metric.reads_predictions() {
                let channels = verdicts::channels(&entry.channel, &entry.score);
                let known = channels.iter().filter_map(|name| shares.get(name).copied());
                entry.score.bounded_share = known.reduce(f64::max);
            }
        }
        Evaluation::new(self.entries, self.skipped)
    }

    /// Marks the scores as scores of samples to which the model was fitted. Such scores prove no skill on other samples, so their skill is unknown.
    #[must_use]
    pub fn of_seen_samples(mut self) -> Evaluation {
        for entry in &mut self.entries {
            if entry.metric.reads_predictions() {
                entry.score.standing = entry.score.standing.max(Standing::SkillUnknown);
            }
        }
        self
    }

    /// Marks the scores of predictions as scores of samples with similar neighbours in the training part. Verdicts ignore these scores.
    #[must_use]
    pub fn of_neighbours_in_training(mut self) -> Evaluation {
        for entry in &mut self.entries {
            if entry.metric.reads_predictions() {
                entry.score.standing = entry.score.standing.max(Standing::Neighbours);
            }
        }
        self
    }

    /// Every score with its metric and the name of its channel or plane.
    pub fn scores(&self) -> impl Iterator<Item = (&'static Metric, &str, &Score)> {
        let entries = self.entries.iter();
        entries.map(|entry| (entry.metric, entry.channel.as_str(), &entry.score))
    }

    /// Score of `metric` on a channel or plane; `None` if the evaluation lacks the score.
    pub fn score(&self, metric: &str, channel: &str) -> Option<&Score> {
        let mut scores = self.scores();
        let found = scores.find(|(found, of, _)| found.id == metric && *of == channel);
        found.map(|(_, _, score)| score)
    }

    /// Skipped metrics with their reasons.
    pub fn skipped(&self) -> &[Skipped] {
        &self.skipped
    }
}
