//! Scores of tasks with intervals over clusters.

use serde::ser::{Serialize, SerializeStruct, Serializer};
use taceva_metrics::{ClusteredBy, Interval, LeftOut, Range, UndefinedReason};

use crate::undefined::Undefined;

/// Score of a task with its interval.
///
/// ```
/// use taceva_tasks::Classes;
/// let mut slip = Classes::new(["no_slip", "slip"], Some("slip"))?;
/// for stroke in ["a", "b", "c", "d", "e"] {
///     slip.push(stroke, "slip", "slip")?;
///     slip.push(stroke, "no_slip", if stroke == "a" { "slip" } else { "no_slip" })?;
/// }
/// let scores = slip.scores();
/// let f1 = scores.iter().find(|score| score.metric == "f1").ok_or("two classes")?;
/// assert_eq!((f1.estimate.value, f1.estimate.n, f1.estimate.clusters), (Ok(10.0 / 11.0), 10, 5));
/// // All positive.
/// assert_eq!(f1.estimate.of_constant, Some(2.0 / 3.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// The score, rounded once, or the reason why it is missing.
    pub value: Result<f64, Undefined>,
    /// 95 % interval over clusters.
    pub interval: Interval,
    /// Number of samples.
    pub n: u64,
    /// Number of clusters with samples.
    pub clusters: u64,
    /// Score of the best constant prediction; `None` if no constant has a score.
    pub of_constant: Option<f64>,
    /// Scores with one cluster left out, in the order of cluster names, for paired comparisons. Reports omit these scores. Empty for the
    /// scores of single classes.
    pub left_out: Vec<LeftOut>,
}

impl Estimate {
    /// The same estimate, with a lower interval end of at least `least`, the least possible score.
    pub(crate) fn at_least(mut self, least: f64) -> Estimate {
        if let Interval::Jackknife { low, .. } = &mut self.interval {
            *low = low.max(least);
        }
        self
    }
}

/// JSON form `{value, undefined, ci95, method, standard_error, degrees_of_freedom, n, clusters, of_constant}`.
///
/// The key `undefined` is the reason for a missing value.
impl Serialize for Estimate {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut into = serializer.serialize_struct("Estimate", 9)?;
        into.serialize_field("value", &self.value.ok())?;
        let reason = self.value.err().map(|reason| reason.to_string());
        into.serialize_field("undefined", &reason)?;
        into.serialize_field("ci95", &self.interval)?;
        into.serialize_field("method", &self.interval.method())?;
        into.serialize_field("standard_error", &self.interval.standard_error())?;
        into.serialize_field("degrees_of_freedom", &self.interval.freedom())?;
        into.serialize_field("n", &self.n)?;
        into.serialize_field("clusters", &self.clusters)?;
        into.serialize_field("of_constant", &self.of_constant)?;
        into.end()
    }
}

/// Score with one cluster left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    /// Number of samples of the cluster.
    pub(crate) n: u64,
    /// Score of all other clusters.
    pub(crate) value: Result<f64, Undefined>,
}

/// Estimate from the score of all clusters, and the scores with one cluster left out each. Clusters without a sample are skipped.
pub(crate) fn estimate(
    value: Result<f64, Undefined>,
    range: Range,
    left_out: &[Part],
    of_constant: Option<f64>,
) -> Estimate {
    let parts = left_out.iter().filter(|part| part.n > 0);
    let left_out: Vec<LeftOut> = parts
        .map(|part| {
            let value = part.value.map_err(|_| UndefinedReason::HangsOnOneCluster);
            LeftOut::new(part.n, value)
        })
        .collect();
    let interval = match value {
        Ok(value) => Interval::jackknife(value, range, &left_out, ClusteredBy::Group),
        Err(reason) => Interval::Undefined(reason.of_interval()),
    };
    Estimate {
        value,
        interval,
        n: left_out.iter().map(|part| part.count).sum(),
        clusters: left_out.len() as u64,
        of_constant,
        left_out,
    }
}

/// Range of a share. Values strictly between 0 and 1 use log odds. 0 and 1 use Wilson's interval with the number of clusters as samples.
pub(crate) fn share(value: Result<f64, Undefined>) -> Range {
    match value {
        Ok(value) if 0.0 < value && value < 1.0 => Range::Ratio,
        _ => Range::Share,
    }
}
