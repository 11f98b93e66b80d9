//! Restriction of a report to named channels.

use taceva_metrics::plane_axes;

use crate::report::EvaluationReport;
use crate::score::Score;

impl EvaluationReport {
    /// Keeps only the scores and samples of the channels and planes called `names`. A plane, such as `Pxy`, keeps the samples of its two axes.
    #[must_use]
    pub fn of_channels(mut self, names: &[String]) -> EvaluationReport {
        let is_named = |score: &Score| names.contains(&score.channel);
        self.scores.retain(is_named);
        for own in &mut self.by_recording {
            own.scores.retain(is_named);
        }
        for own in &mut self.by_group {
            own.errors.retain(|error| names.contains(&error.channel));
        }
        self.by_group.retain(|own| !own.errors.is_empty());
        if let Some(over) = &mut self.over_seeds {
            over.scores.retain(|own| names.contains(&own.channel));
        }
        let axes = names.iter().filter_map(|name| plane_axes(name)).flatten();
        let names: Vec<&str> = names.iter().map(String::as_str).chain(axes).collect();
        let samples = self.samples.take();
        EvaluationReport {
            samples: samples.map(|samples| samples.of_channels(&names)),
            ..self
        }
    }
}
