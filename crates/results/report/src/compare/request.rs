//! Names in a request: metrics, groups of metrics, and margins of scores.

use std::collections::BTreeSet;

use taceva_core::shown;
use taceva_metrics::{Better, UnknownMetric, catalogue};

use super::CompareRequest;
use crate::results::Study;

/// Error for a name in a request that matches no score.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// Neither the catalogue nor a result has the metric.
    #[error(transparent)]
    Metric(UnknownMetric),
    /// No result has the score of a margin. The text has the given name and the accepted names.
    #[error("{0}")]
    Margin(String),
}

impl CompareRequest {
    /// Replaces each group in the request by its metrics with scores and a better direction.
    ///
    /// Accepts names of the catalogue and of the scores in `studies`.
    ///
    /// ```
    /// use taceva_report::{CompareRequest, catalogue};
    /// let studies = ["GelSight", "MagicTac"].map(|name| catalogue::find(name).expect("there").as_study());
    /// let asked = |name: &str| CompareRequest {
    ///     metrics: vec![name.to_owned()],
    ///     ..CompareRequest::default()
    /// };
    /// let request = asked("accuracy").resolved(&studies)?;
    /// assert_eq!(request.metrics, ["mae", "r2", "smape"]);
    /// let error = asked("smap").resolved(&studies).unwrap_err();
    /// assert!(error.to_string().starts_with("`smap`: unknown metric, did you mean `smape`?"));
    /// # Ok::<(), taceva_report::RequestError>(())
    /// ```
    ///
    /// # Errors
    /// [`RequestError`] for the name of a metric or margin that matches no score.
    pub fn resolved(self, studies: &[Study]) -> Result<CompareRequest, RequestError> {
        let mut metrics: Vec<String> = Vec::new();
        for name in &self.metrics {
            for metric in meant(name, studies).map_err(RequestError::Metric)? {
                if !metrics.contains(&metric) {
                    metrics.push(metric);
                }
            }
        }
        for name in self.margins.keys() {
            check_margin(name, studies)?;
        }
        Ok(CompareRequest { metrics, ..self })
    }

    /// Notes on requested metrics that no result has.
    pub fn absent(&self, studies: &[Study]) -> Vec<String> {
        let absent = self.metrics.iter();
        let absent = absent.filter(|metric| !is_scored(metric, studies));
        absent.map(|metric| no_score(metric, studies)).collect()
    }
}

/// Metrics selected by `name`, which is a metric, a group or a score.
fn meant(name: &str, studies: &[Study]) -> Result<Vec<String>, UnknownMetric> {
    if is_scored(name, studies) {
        return Ok(vec![name.to_owned()]);
    }
    let found = catalogue::select([name])?;
    if let [metric] = found[..] {
        return Ok(vec![metric.id.to_owned()]);
    }
    let directed = found.iter().filter(|of| of.better != Better::Described);
    let directed: Vec<String> = directed.map(|metric| metric.id.to_owned()).collect();
    let scored = directed.iter().filter(|metric| is_scored(metric, studies));
    let scored: Vec<String> = scored.cloned().collect();
    // An empty list of metrics would select all.
    Ok(if scored.is_empty() { directed } else { scored })
}

/// True if a result has a score of `metric`.
fn is_scored(metric: &str, studies: &[Study]) -> bool {
    let mut studies = studies.iter();
    studies.any(|study| study.of_metric(metric).next().is_some())
}

/// Message for a missing score: `drift: no result has this score, expected one of mae, r2`.
fn no_score(metric: &str, studies: &[Study]) -> String {
    let scores = studies.iter().flat_map(|study| &study.scores);
    let metrics: BTreeSet<&str> = scores.map(|score| score.metric.as_str()).collect();
    format!(
        "{}: no result has this score, expected one of {}",
        shown(metric),
        listed(metrics.into_iter())
    )
}

/// Names separated by commas, or `none`.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| shown(name).to_string()).collect();
    match names.is_empty() {
        true => "none".to_owned(),
        false => names.join(", "),
    }
}

/// Rejects the margin of a score that no result has. A margin without a score would have no effect.
fn check_margin(name: &str, studies: &[Study]) -> Result<(), RequestError> {
    let metric = name.split('.').next().unwrap_or_default();
    if !is_scored(metric, studies) {
        catalogue::select([metric]).map_err(|error| RequestError::Margin(error.to_string()))?;
        return Err(RequestError::Margin(no_score(metric, studies)));
    }
    let scores = studies.iter().flat_map(|study| study.of_metric(metric));
    let names: BTreeSet<String> = scores
        .map(|score| format!("{metric}.{}", score.channel))
        .collect();
    if name == metric || names.contains(name) {
        return Ok(());
    }
    Err(RequestError::Margin(format!(
        "{}: no result has this score, expected {} or one of {}",
        shown(name),
        shown(metric),
        listed(names.iter().map(String::as_str))
    )))
}
