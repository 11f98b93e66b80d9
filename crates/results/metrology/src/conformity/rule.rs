//! Decision rules for measured values.

use serde::{Deserialize, Serialize};

use super::ConformityError;
use super::error::check;

/// Rule for decisions about a measured value.
///
/// ```
/// use taceva_metrology::conformity::DecisionRule;
/// assert_eq!(DecisionRule::Simple.to_string(), "simple acceptance, w = 0");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case")]
#[non_exhaustive]
pub enum DecisionRule {
    /// Accepts a value that meets the limit, without regard to uncertainty.
    Simple,
    /// Accepts a value inside the limit by at least a guard band of r times the expanded uncertainty.
    Guarded {
        /// Guard band as a multiple r of the expanded uncertainty, at least 0.
        r: f64,
        /// Coverage of the expanded uncertainty, in 0..1.
        coverage: f64,
    },
    /// Accepts a value whose probability of conformity reaches a threshold.
    Probability {
        /// Least probability of conformity, above 0.5 and below 1.
        p_conformity: f64,
    },
    /// Accepts a value that meets the limit, if the expanded uncertainty does not exceed the agreed maximum.
    Shared {
        /// Greatest expanded uncertainty, in the unit of the value.
        most_uncertainty: f64,
        /// Coverage of the expanded uncertainty, in 0..1.
        coverage: f64,
    },
}

/// Default coverage of the expanded uncertainty.
const COVERAGE: f64 = 0.95;

impl DecisionRule {
    /// Coverage of the expanded uncertainty: the setting of the rule, or else 0.95.
    #[must_use]
    pub fn coverage(&self) -> f64 {
        match *self {
            DecisionRule::Guarded { coverage, .. } | DecisionRule::Shared { coverage, .. } => {
                coverage
            }
            DecisionRule::Simple | DecisionRule::Probability { .. } => COVERAGE,
        }
    }

    /// Rejects settings outside their range.
    pub(super) fn check(&self) -> Result<(), ConformityError> {
        let covers = |coverage: f64| {
            let is_share = coverage > 0.0 && coverage < 1.0;
            check(
                "coverage",
                coverage,
                is_share,
                "a share above 0 and below 1",
            )
        };
        match *self {
            DecisionRule::Simple => Ok(()),
            DecisionRule::Guarded { r, coverage } => {
                check("r", r, r >= 0.0 && r.is_finite(), "a factor from 0 on")?;
                covers(coverage)
            }
            DecisionRule::Probability { p_conformity: p } => {
                let expected = "a probability above 0.5 and below 1";
                check("p_conformity", p, p > 0.5 && p < 1.0, expected)
            }
            DecisionRule::Shared {
                most_uncertainty: most,
                coverage,
            } => {
                check(
                    "most_uncertainty",
                    most,
                    most > 0.0,
                    "an uncertainty above 0",
                )?;
                covers(coverage)
            }
        }
    }
}

impl std::fmt::Display for DecisionRule {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            DecisionRule::Simple => f.write_str("simple acceptance, w = 0"),
            DecisionRule::Guarded { r, coverage } => {
                write!(f, "guard band w = {r} U, U at a coverage of {coverage}")
            }
            DecisionRule::Probability { p_conformity } => {
                write!(f, "probability of conformity at least {p_conformity}")
            }
            DecisionRule::Shared {
                most_uncertainty,
                coverage,
            } => write!(
                f,
                "shared risk, U at most {most_uncertainty} at a coverage of {coverage}"
            ),
        }
    }
}

/// Settings of a rule in a limits file. The default rule is `simple`, and the default coverage 0.95.
///
/// ```
/// use taceva_metrology::conformity::{DecisionRule, RuleSettings};
/// let settings: RuleSettings = toml::from_str("rule = \"guarded\"\nr = 1.0")?;
/// let expected = DecisionRule::Guarded { r: 1.0, coverage: 0.95 };
/// assert_eq!(settings.decision_rule()?, expected);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct RuleSettings {
    /// Name of the rule: simple, guarded, probability or shared.
    pub rule: Option<String>,
    /// Guard band as a multiple of the expanded uncertainty, for `guarded`.
    pub r: Option<f64>,
    /// Least probability of conformity, for `probability`.
    pub p_conformity: Option<f64>,
    /// Greatest expanded uncertainty, in the unit of the value, for `shared`.
    pub most_uncertainty: Option<f64>,
    /// Coverage of the expanded uncertainty.
    pub coverage: Option<f64>,
}

impl RuleSettings {
    /// Rule with these settings.
    ///
    /// # Errors
    /// [`ConformityError`] for an unknown rule, a setting of another rule or outside its range, or a missing setting.
    pub fn decision_rule(&self) -> Result<DecisionRule, ConformityError> {
        let rule = self.rule.as_deref().unwrap_or("simple");
        let settings = [
            ("r", self.r, "guarded"),
            ("p_conformity", self.p_conformity, "probability"),
            ("most_uncertainty", self.most_uncertainty, "shared"),
        ];
        for (setting, value, expected) in settings {
            if value.is_some() && rule != expected {
                return Err(ConformityError::BothRules {
                    setting,
                    rule: rule.to_owned(),
                    expected,
                });
            }
        }
        let coverage = self.coverage.unwrap_or(COVERAGE);
        let rule = match rule {
            "simple" => DecisionRule::Simple,
            "guarded" => DecisionRule::Guarded {
                r: self.r.unwrap_or(1.0),
                coverage,
            },
            "probability" => DecisionRule::Probability {
                p_conformity: self.p_conformity.unwrap_or(0.95),
            },
            "shared" => DecisionRule::Shared {
                most_uncertainty: self
                    .most_uncertainty
                    .ok_or(ConformityError::MissingSetting {
                        rule: "shared",
                        setting: "most_uncertainty",
                    })?,
                coverage,
            },
            _ => {
                return Err(ConformityError::UnknownRule {
                    rule: rule.to_owned(),
                });
            }
        };
        rule.check()?;
        Ok(rule)
    }
}
