//! Errors with faults: results of `taceva stress`, and of `[stress]` in a scene.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::shown;
use taceva_metrics::{Standing, plane_of};
use taceva_results::{ResultsError, Subject};

/// Severity that a result states if a fault ends the skill at no severity.
pub(crate) const NEVER: u8 = 6;
/// Schema of the results; a minor version may follow: `taceva.stress/1.3`.
const SCHEMA: &str = "taceva.stress/1";

/// Errors of a model on pictures or signals with faults, as read from JSON of the schema `taceva.stress/1`.
///
/// ```
/// use taceva_report::FaultResult;
/// assert!(!FaultResult::is_in("{\"schema\": \"taceva.run/1.0\"}"));
/// assert!(FaultResult::read("{}").is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct FaultResult {
    pub(crate) schema: String,
    pub(crate) subject: Subject,
    pub(crate) not_measured: Option<String>,
    pub(crate) by: String,
    pub(crate) list: FaultList,
    pub(crate) seed: u64,
    pub(crate) samples: u64,
    /// Input of the model: `frame` or `signals`; empty before version 1.2.
    #[serde(default)]
    pub(crate) input: String,
    pub(crate) clean: BTreeMap<String, CleanScore>,
    pub(crate) faults: Vec<FaultScores>,
    #[serde(rename = "mD")]
    pub(crate) mean: BTreeMap<String, Estimate>,
    pub(crate) unnoticed: Option<Vec<Unnoticed>>,
    pub(crate) skipped: Vec<Skipped>,
    #[serde(default)]
    pub(crate) failed: Vec<Skipped>,
    pub(crate) notes: Vec<String>,
}

/// List of faults and severities. Results of different lists are not compared.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct FaultList {
    pub(crate) name: String,
    pub(crate) digest: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub(crate) struct Estimate {
    pub(crate) value: Option<f64>,
    pub(crate) ci95: Option<[f64; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub(crate) struct CleanScore {
    pub(crate) skill: Estimate,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct FaultScores {
    pub(crate) id: String,
    pub(crate) note: Option<String>,
    pub(crate) severities: Vec<SeverityScores>,
    pub(crate) unreached: Vec<Unreached>,
    pub(crate) breaks_at: BTreeMap<String, Option<u8>>,
    /// Error that the fault adds, minus the error that it adds to the reference model, by channel. Empty without a reference model.
    #[serde(default)]
    pub(crate) difference: BTreeMap<String, ErrorDifference>,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub(crate) struct ErrorDifference {
    pub(crate) value: Option<f64>,
    pub(crate) is_shown: bool,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct SeverityScores {
    pub(crate) severity: u8,
    pub(crate) stale: BTreeMap<String, CellScore>,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub(crate) struct CellScore {
    pub(crate) degradation: Estimate,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct Unreached {
    pub(crate) severity: u8,
}

#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct Unnoticed {
    pub(crate) fault: String,
    pub(crate) severity: u8,
    pub(crate) channel: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct Skipped {
    pub(crate) fault: String,
    pub(crate) reason: String,
}

impl FaultResult {
    /// True if `text` states the schema of these results.
    pub fn is_in(text: &str) -> bool {
        #[derive(Deserialize)]
        struct Named {
            schema: String,
        }
        serde_json::from_str(text).is_ok_and(|named: Named| is_schema(&named.schema))
    }

    /// Parses the result in `text`.
    ///
    /// # Errors
    /// [`ResultsError`] for invalid JSON or another schema.
    pub fn read(text: &str) -> Result<FaultResult, ResultsError> {
        let result: FaultResult = serde_json::from_str(text)?;
        if !is_schema(&result.schema) {
            return Err(ResultsError::Place {
                place: "schema".to_owned(),
                problem: format!("expected `{SCHEMA}`, found `{}`", shown(&result.schema)),
            });
        }
        Ok(result)
    }

    /// Noun for the inputs of the model.
    pub(crate) fn inputs(&self) -> &'static str {
        match self.input.as_str() {
            "signals" => "signals",
            _ => "pictures",
        }
    }

    /// Mean degradation of a channel or plane over all faults, with its 95 % interval; `None` if unknown.
    pub(crate) fn degradation(&self, channel: &str) -> Option<(f64, Option<[f64; 2]>)> {
        let of = self.mean.get(channel)?;
        Some((of.value?, of.ci95))
    }

    /// Faults with errors. A fault that leaves rows out has no errors, because it changes only times.
    pub(crate) fn scored(&self) -> impl Iterator<Item = &FaultScores> {
        let faults = self.faults.iter();
        faults.filter(|fault| !fault.breaks_at.is_empty())
    }

    /// Least severity at which no skill is shown, as the mean over the faults; `None` if it is unknown for a fault.
    pub(crate) fn skill_end(&self, channel: &str) -> Option<f64> {
        let ends = self.scored().map(|fault| {
            let end = fault.breaks_at.get(channel).copied().flatten();
            end.map(f64::from)
        });
        let ends: Vec<f64> = ends.collect::<Option<_>>()?;
        let count = ends.iter().fold(0.0, |count, _| count + 1.0);
        (count > 0.0).then(|| ends.iter().sum::<f64>() / count)
    }

    /// Standing of the values of a channel in verdicts. Without skill, faults cannot add to the error of the channel, so the values have no meaning.
    pub(crate) fn standing(&self, channel: &str) -> Standing {
        let skill = self.clean.get(channel).map(|of| of.skill);
        match skill.map(|skill| (skill.value, skill.ci95)) {
            Some((Some(_), Some([low, _]))) if low > 0.0 => Standing::Counts,
            Some((Some(value), None)) if value > 0.0 => Standing::SkillUnknown,
            Some((Some(_), _)) => Standing::NoSkill,
            _ => Standing::SkillUnknown,
        }
    }

    /// Digest of the list with the tested severities. Means over other faults or severities are not compared.
    pub(crate) fn basis(&self) -> String {
        let tested = self.faults.iter().flat_map(|fault| {
            let severities = fault.severities.iter();
            severities.map(move |of| format!(",{} {}", fault.id, of.severity))
        });
        self.list.digest.clone() + &tested.collect::<String>()
    }

    /// Requested faults without scores, with the severity if it is known: `tear 5`.
    pub(crate) fn untested(&self) -> Vec<String> {
        let unreached = self.faults.iter().flat_map(|fault| {
            let unreached = fault.unreached.iter();
            unreached.map(move |of| format!("{} {}", fault.id, of.severity))
        });
        let others = self.skipped.iter().chain(&self.failed);
        unreached.chain(others.map(|of| of.fault.clone())).collect()
    }

    /// Names of planes, and of channels that are not an axis of a plane.
    pub(crate) fn main_channels(&self) -> Vec<&str> {
        main_channels(&self.clean)
    }
}

/// True for the schema of these results with any minor version.
fn is_schema(schema: &str) -> bool {
    let rest = schema.strip_prefix(SCHEMA);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Names of planes in `of`, and names of channels outside these planes.
///
/// ```
/// use std::collections::BTreeMap;
/// let errors = BTreeMap::from(["Fz", "Px", "Pxy", "Py"].map(|name| (name.to_owned(), 0.1)));
/// assert_eq!(taceva_report::main_channels(&errors), ["Fz", "Pxy"]);
/// ```
pub fn main_channels<T>(of: &BTreeMap<String, T>) -> Vec<&str> {
    let names = of.keys().map(String::as_str);
    let is_main = |name: &&str| {
        let plane = plane_of(name);
        plane.is_none_or(|plane| !of.contains_key(plane))
    };
    names.filter(is_main).collect()
}

#[cfg(test)]
pub(crate) mod tests;
