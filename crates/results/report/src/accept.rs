//! Checks results against limits.

mod interval;
mod sheet;
mod template;

pub use sheet::{ACCEPTANCE_SCHEMA, Acceptance};
pub use template::limits_template;

use serde::Deserialize;
use taceva_core::Unit;
use taceva_core::shown;
use taceva_metrics::Standing;

use self::interval::LimitInterval;
use crate::number::numeral;
use crate::results::Study;
use taceva_results::Score;

/// Only accepted version of limit files.
const LIMITS_VERSION: u32 = 1;

/// Limits for the acceptance of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitsFile {
    /// Version of the file; 1 by default.
    #[serde(default = "limits_version")]
    limits_version: u32,
    /// Purpose of the limits, such as a production line; may be empty.
    #[serde(default)]
    pub name: String,
    /// Limits, in order.
    #[serde(default, rename = "limit")]
    pub limits: Vec<Limit>,
}

/// Limit of one score.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limit {
    /// Metric, with an optional variant: `mae`, `hysteresis.ratio`.
    pub metric: String,
    /// Channel or plane.
    pub channel: String,
    /// Unit of the limit; must be that of the score.
    pub unit: String,
    /// Greatest accepted value.
    pub most: Option<f64>,
    /// Least accepted value.
    pub least: Option<f64>,
    /// True if the whole interval must meet the limit, not only the value.
    #[serde(default)]
    pub whole_interval: bool,
}

/// Error while reading limits.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LimitsError {
    /// The file is not TOML, or has unknown keys.
    #[error("{0}")]
    Toml(#[from] toml::de::Error),
    /// A value is invalid.
    #[error("limit {number}: {problem}")]
    Limit {
        /// Number of the limit in the file, from 1; 0 for an error of the whole file.
        number: usize,
        /// The problem and the accepted values.
        problem: String,
    },
}

/// Result of checking one limit.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitCheck {
    /// Checked limit.
    pub limit: Limit,
    /// Value of the score, if there is one.
    pub value: Option<f64>,
    /// Both ends of its interval.
    pub ends: Option<[f64; 2]>,
    /// Number of trainings of the model whose variance the interval contains; 0 without any.
    pub trainings: usize,
    /// Number of samples behind the score.
    pub n: u64,
    /// True if the limit is met.
    pub is_kept: bool,
    /// Reason why the limit is not met, or a remark that it is met without an interval.
    pub reason: Option<String>,
    /// Standing of the score. A limit on a score that is excluded from verdicts counts as not met.
    pub standing: Standing,
}

fn limits_version() -> u32 {
    LIMITS_VERSION
}

impl LimitsFile {
    /// Parses the limits in `text`.
    ///
    /// ```
    /// use taceva_report::LimitsFile;
    /// let limits = LimitsFile::read(r#"
    ///     [[limit]]
    ///     metric = "mae"
    ///     channel = "Fz"
    ///     most = 0.05
    ///     unit = "N"
    /// "#)?;
    /// assert_eq!(limits.limits[0].most, Some(0.05));
    /// # Ok::<(), taceva_report::LimitsError>(())
    /// ```
    ///
    /// # Errors
    /// [`LimitsError`] with the line, or the number of the limit.
    pub fn read(text: &str) -> Result<LimitsFile, LimitsError> {
        let file: LimitsFile = toml::from_str(text)?;
        let refuse = |number: usize, problem: String| Err(LimitsError::Limit { number, problem });
        if file.limits_version != LIMITS_VERSION {
            return refuse(
                0,
                format!(
                    "limits_version {}: expected {LIMITS_VERSION}",
                    file.limits_version
                ),
            );
        }
        if file.limits.is_empty() {
            return refuse(0, "no [[limit]]: expected at least one".to_owned());
        }
        for (at, limit) in file.limits.iter().enumerate() {
            if Unit::from_symbol(&limit.unit).is_none() {
                return refuse(
                    at + 1,
                    format!(
                        "unit `{}`: expected a unit such as mm, N or 1",
                        shown(&limit.unit)
                    ),
                );
            }
            let ends = [limit.most, limit.least];
            let is_number = ends.iter().flatten().all(|end| end.is_finite());
            if !is_number || ends.iter().all(Option::is_none) {
                return refuse(
                    at + 1,
                    "expected `most`, `least` or both, as numbers".to_owned(),
                );
            }
        }
        Ok(file)
    }
}

/// Checks each limit on the scores of `study`, in the order of the limits. A limit on a missing score or value counts as not met.
///
/// If the model was trained several times, an interval contains the variance between trainings beside that between clusters.
pub fn accept(study: &Study, limits: &LimitsFile) -> Vec<LimitCheck> {
    limits
        .limits
        .iter()
        .map(|limit| hold(study, limit))
        .collect()
}

fn hold(study: &Study, limit: &Limit) -> LimitCheck {
    let mut finding = LimitCheck {
        limit: limit.clone(),
        value: None,
        ends: None,
        trainings: 0,
        n: 0,
        is_kept: false,
        reason: None,
        standing: Standing::Counts,
    };
    let (metric, variant) = match limit.metric.split_once('.') {
        Some((metric, variant)) => (metric, Some(variant)),
        None => (limit.metric.as_str(), None),
    };
    let Some(score) = study.score(metric, &limit.channel) else {
        finding.reason = Some("there is no such score".to_owned());
        return finding;
    };
    // A limit without a variant applies to the variant that verdicts use.
    let decided_by = score.decided_by().map(|decides| decides.name.as_str());
    let variant = variant.or(decided_by);
    finding.n = score.n;
    finding.standing = score.standing_of(variant);
    let asked = match variant.map(|name| score.variant(name)) {
        None => score.clone(),
        Some(Some(variant)) => Score {
            value: variant.value.clone(),
            unit: variant.unit,
            interval: variant.interval.clone(),
            ..score.clone()
        },
        Some(None) => {
            finding.reason = Some("there is no such variant".to_owned());
            return finding;
        }
    };
    let Some(number) = asked.value.number() else {
        finding.reason = asked
            .value
            .reason()
            .or_else(|| Some("not a single number".to_owned()));
        return finding;
    };
    finding.value = Some(number);
    let interval = LimitInterval::of(study, &asked, variant);
    finding.ends = interval.ends;
    finding.trainings = interval.trainings;
    let barred = finding.standing.reason().map(str::to_owned);
    finding.reason = barred.or_else(|| broken(limit, asked.unit, number, finding.ends));
    finding.is_kept = finding.reason.is_none();
    if finding.is_kept && finding.ends.is_none() {
        finding.reason = Some("met by the value only: there is no interval".to_owned());
    } else if finding.is_kept && is_crossed(limit, finding.ends) {
        let crossed = "met by the value only: its interval crosses the limit";
        finding.reason = Some(crossed.to_owned());
    }
    finding
}

/// True if an interval crosses the limit.
fn is_crossed(limit: &Limit, ends: Option<[f64; 2]>) -> bool {
    ends.is_some_and(|[low, high]| {
        let is_above = limit.most.is_some_and(|most| high > most);
        let is_below = limit.least.is_some_and(|least| low < least);
        is_above || is_below
    })
}

/// Describes why a limit is not met; `None` if the value meets it.
fn broken(limit: &Limit, unit: Unit, value: f64, ends: Option<[f64; 2]>) -> Option<String> {
    if unit.symbol() != limit.unit {
        return Some(format!(
            "the score is in {unit}, the limit in {}",
            limit.unit
        ));
    }
    let [low, high] = match (limit.whole_interval, ends) {
        (false, _) => [value; 2],
        (true, Some(ends)) => ends,
        (true, None) => return Some("there is no interval to compare with the limit".to_owned()),
    };
    let what = if limit.whole_interval {
        "interval reaches"
    } else {
        "value is"
    };
    if let Some(most) = limit.most.filter(|most| high > *most) {
        return Some(format!("{what} {}, above {most}", numeral(high)));
    }
    let least = limit.least.filter(|least| low < *least)?;
    Some(format!("{what} {}, below {least}", numeral(low)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    fn limits(lines: &str) -> LimitsFile {
        LimitsFile::read(&format!("limits_version = 1\n[[limit]]\n{lines}\n")).expect("limits")
    }

    #[test]
    fn what_a_constant_reaches_is_judged_by_its_value_alone() {
        let study = crate::results::unsealed(
            r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "x"}, "metrics": {
                "tolerance": {"Px": {"value": 0.04, "unit": "1", "standing": "not above the constant",
                    "of_constant": {"value": 0.05, "unit": "1"}}},
                "r2": {"Px": {"value": 0.1, "unit": "1", "ci95": [-0.25, 0.75]}}}}"#,
        );
        let study = study.expect("a result").remove(0);
        let of = |metric: &str| {
            let limit = format!("metric=\"{metric}\"\nchannel=\"Px\"\nunit=\"1\"\nleast=0.01");
            accept(&study, &limits(&limit)).remove(0)
        };
        let of_constant = of("tolerance.of_constant");
        assert!(of_constant.is_kept, "{:?}", of_constant.reason);
        assert!(!of("tolerance").is_kept);
    }

    #[test]
    fn a_value_on_the_limit_keeps_to_it_and_one_beyond_does_not() {
        let study = catalogue::find("GelSight").expect("there").as_study();
        let kept = limits("metric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\"\nmost=0.0361");
        assert!(accept(&study, &kept)[0].is_kept);
        let broken = limits("metric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\"\nmost=0.0360");
        let finding = &accept(&study, &broken)[0];
        assert_eq!(
            finding.reason.as_deref(),
            Some("value is 0.0361, above 0.036")
        );
    }

    #[test]
    fn a_value_is_kept_alone_where_its_interval_reaches_across_the_limit() {
        let crossed = |lines: &str, ends| is_crossed(&limits(lines).limits[0], Some(ends));
        let most = "metric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 0.5\n";
        assert!(crossed(most, [0.3, 0.51]) && !crossed(most, [0.3, 0.5]));
        let least = "metric = \"r2\"\nchannel = \"Fz\"\nunit = \"1\"\nleast = 0.5\n";
        assert!(crossed(least, [0.49, 0.8]) && !crossed(least, [0.5, 0.8]));
    }

    #[test]
    fn what_is_unknown_meets_no_limit() {
        let study = catalogue::find("GelSight").expect("there").as_study();
        for (lines, expected) in [
            (
                "metric=\"drift\"\nchannel=\"Fz\"\nunit=\"N/h\"\nmost=1",
                "there is no such score",
            ),
            (
                "metric=\"mae\"\nchannel=\"Fz\"\nunit=\"mm\"\nmost=1",
                "the score is in N, the limit in mm",
            ),
            (
                "metric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\"\nmost=1\nwhole_interval=true",
                "there is no interval to compare with the limit",
            ),
        ] {
            let finding = &accept(&study, &limits(lines))[0];
            assert_eq!(
                (finding.is_kept, finding.reason.as_deref()),
                (false, Some(expected))
            );
        }
        assert!(LimitsFile::read("limits_version = 1").is_err());
        assert!(
            LimitsFile::read(
                "limits_version = 1\n[[limit]]\nmetric=\"mae\"\nchannel=\"Fz\"\nunit=\"N\""
            )
            .is_err()
        );
    }
}
