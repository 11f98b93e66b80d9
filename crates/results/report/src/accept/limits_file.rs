//! Limits files, with the decision rules of their limits.

use serde::Deserialize;
use taceva_core::{Unit, shown};
use taceva_metrology::conformity::{ConformityError, DecisionRule, Limits, RuleSettings};

/// Version of limits files without decision rules: the value, or its whole interval, must meet the limit.
const BY_VALUE: u32 = 1;
/// Version of limits files with decision rules.
pub(super) const BY_RULES: u32 = 2;

/// Limits for the acceptance of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitsFile {
    /// Version of the file; defaults to 1.
    #[serde(default = "by_value")]
    limits_version: u32,
    /// Purpose of the limits, such as a production line; may be empty.
    #[serde(default)]
    pub name: String,
    /// Default rule settings for limits without their own, since version 2.
    decision: Option<RuleSettings>,
    /// Limits, in the order of the file.
    #[serde(default, rename = "limit")]
    pub limits: Vec<Limit>,
    /// True if a conditional pass counts as met.
    #[serde(skip)]
    counts_conditional: bool,
}

/// Limit of one score.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limit {
    /// Metric, with an optional variant: `mae`, `hysteresis.ratio`.
    pub metric: String,
    /// Channel or plane of the score, such as `Fz` or `Fxy`.
    pub channel: String,
    /// Unit of the limit; must equal the unit of the score.
    pub unit: String,
    /// Greatest accepted value; `None` for no upper limit.
    pub most: Option<f64>,
    /// Least accepted value; `None` for no lower limit.
    pub least: Option<f64>,
    /// True if the whole interval must meet the limit, not only the value. Only in files of version 1.
    #[serde(default)]
    pub whole_interval: bool,
    /// Name of the rule for this limit, since version 2.
    rule: Option<String>,
    /// Width of the guard band as a multiple of the expanded uncertainty, for the rule `guarded`.
    r: Option<f64>,
    /// Least probability of conformity, for the rule `probability`.
    p_conformity: Option<f64>,
    /// Greatest expanded uncertainty in the unit of the score, for the rule `shared`.
    most_uncertainty: Option<f64>,
    /// Coverage probability of the expanded uncertainty, 0 to 1.
    coverage: Option<f64>,
    /// Decision rule, from the settings of this limit and of the file.
    #[serde(skip, default = "simple")]
    pub(super) decided_by: DecisionRule,
}

/// Error while reading limits.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LimitsError {
    /// The file is not TOML, or has unknown keys.
    #[error("{0}")]
    Toml(#[from] toml::de::Error),
    /// The file as a whole is invalid: its version, its rule, or no limit.
    #[error("{0}")]
    File(String),
    /// A value is invalid.
    #[error("limit {number}: {problem}")]
    Limit {
        /// Number of the limit in the file, from 1.
        number: usize,
        /// The problem and the accepted values.
        problem: String,
    },
}

fn by_value() -> u32 {
    BY_VALUE
}

fn simple() -> DecisionRule {
    DecisionRule::Simple
}

impl LimitsFile {
    /// Parses the limits in `text`.
    ///
    /// ```
    /// use taceva_report::LimitsFile;
    /// let limits = LimitsFile::read(r#"
    ///     limits_version = 2
    ///     [decision]
    ///     rule = "guarded"
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
        let mut file: LimitsFile = toml::from_str(text)?;
        if ![BY_VALUE, BY_RULES].contains(&file.limits_version) {
            return Err(LimitsError::File(format!(
                "limits_version {}: expected {BY_VALUE} or {BY_RULES}",
                file.limits_version
            )));
        }
        if file.limits.is_empty() {
            let problem = "no [[limit]], expected at least one";
            return Err(LimitsError::File(problem.to_owned()));
        }
        let is_by_rules = file.is_by_rules();
        if !is_by_rules && file.decision.is_some() {
            return Err(LimitsError::File(format!(
                "[decision] in limits_version {BY_VALUE}: expected it with limits_version = {BY_RULES}"
            )));
        }
        let common = file.decision.clone().unwrap_or_default();
        match common.decision_rule() {
            // Each limit may state the missing setting in its own unit.
            Ok(_) | Err(ConformityError::MissingSetting { .. }) => {}
            Err(error) => return Err(LimitsError::File(format!("[decision]: {error}"))),
        }
        for (limit, number) in file.limits.iter_mut().zip(1..) {
            let refuse = |problem: String| LimitsError::Limit { number, problem };
            limit.check_unit_and_ends().map_err(refuse)?;
            match is_by_rules {
                true => limit.decide_by(&common).map_err(refuse)?,
                false => limit.check_no_rule().map_err(refuse)?,
            }
        }
        Ok(file)
    }

    /// Returns these limits with conditional passes counted as met.
    ///
    /// ```
    /// use taceva_report::LimitsFile;
    /// let limit = "[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 1.0\n";
    /// let limits = LimitsFile::read(&format!("limits_version = 2\n{limit}"))?;
    /// assert!(limits.counting_conditional_passes().counts_conditional_passes());
    /// # Ok::<(), taceva_report::LimitsError>(())
    /// ```
    #[must_use]
    pub fn counting_conditional_passes(self) -> LimitsFile {
        LimitsFile {
            counts_conditional: true,
            ..self
        }
    }

    /// True if a conditional pass counts as met.
    pub fn counts_conditional_passes(&self) -> bool {
        self.counts_conditional
    }

    /// True for version 2, where rules decide on the limits.
    pub fn is_by_rules(&self) -> bool {
        self.limits_version == BY_RULES
    }
}

impl Limit {
    fn check_unit_and_ends(&self) -> Result<(), String> {
        if Unit::from_symbol(&self.unit).is_none() {
            return Err(format!(
                "unit `{}`: expected a unit such as mm, N or 1",
                shown(&self.unit)
            ));
        }
        let ends = [self.most, self.least];
        let is_number = ends.iter().flatten().all(|end| end.is_finite());
        match is_number && ends.iter().any(Option::is_some) {
            true => Ok(()),
            false => Err("expected `most`, `least` or both, as numbers".to_owned()),
        }
    }

    /// Rejects rule settings in a file of version 1.
    fn check_no_rule(&self) -> Result<(), String> {
        let settings = [
            ("rule", self.rule.is_some()),
            ("r", self.r.is_some()),
            ("p_conformity", self.p_conformity.is_some()),
            ("most_uncertainty", self.most_uncertainty.is_some()),
            ("coverage", self.coverage.is_some()),
        ];
        match settings.iter().find(|(_, is_set)| *is_set) {
            None => Ok(()),
            Some((name, _)) => Err(format!(
                "`{name}` in limits_version {BY_VALUE}: expected it with limits_version = {BY_RULES}"
            )),
        }
    }

    /// Sets the rule from the settings of the limit and the defaults of the file. A limit whose rule differs from the rule of the file inherits only
    /// the coverage probability.
    fn decide_by(&mut self, common: &RuleSettings) -> Result<(), String> {
        if self.whole_interval {
            return Err(format!(
                "`whole_interval` in limits_version {BY_RULES}: expected rule = \"guarded\" with r = 1"
            ));
        }
        Limits::of(self.least, self.most).map_err(|error| error.to_string())?;
        let mut settings = common.clone();
        if self.rule.is_some() && self.rule != common.rule {
            settings = RuleSettings::default();
            settings.rule.clone_from(&self.rule);
            settings.coverage = common.coverage;
        }
        settings.r = self.r.or(settings.r);
        settings.p_conformity = self.p_conformity.or(settings.p_conformity);
        settings.most_uncertainty = self.most_uncertainty.or(settings.most_uncertainty);
        settings.coverage = self.coverage.or(settings.coverage);
        self.decided_by = settings
            .decision_rule()
            .map_err(|error| error.to_string())?;
        Ok(())
    }
}
