//! Settings of an analysis.

use serde::{Deserialize, Serialize};

use super::GaugeError;

/// Relation of parts and operators.
///
/// ```
/// use taceva_metrology::gauge::Design;
/// assert_eq!(Design::default(), Design::Crossed);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Design {
    /// Every operator measures every part.
    #[default]
    Crossed,
    /// Each part is measured by one operator only. Equal labels under two operators are different parts.
    Nested,
}

/// Estimator of the components.
///
/// ```
/// use taceva_metrology::gauge::Method;
/// assert_eq!(Method::default(), Method::Anova);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Method {
    /// Analysis-of-variance method.
    #[default]
    Anova,
    /// Average-and-range method.
    Range,
}

/// Settings of an analysis.
///
/// ```
/// use taceva_metrology::gauge::GaugeSettings;
/// let mut settings = GaugeSettings::default();
/// settings.tolerance = Some(0.1);
/// assert_eq!((settings.pool, settings.draws), (0.25, 200_000));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct GaugeSettings {
    /// Relation of parts and operators.
    pub design: Design,
    /// Estimator of the components.
    pub method: Method,
    /// Threshold of the p value above which the interaction is pooled with repeatability; AIAG uses 0.25.
    pub pool: f64,
    /// Width of the tolerance, in the unit of the readings; `None` without a tolerance.
    pub tolerance: Option<f64>,
    /// True if the readings are errors. Parts then differ only by bias, so distinct categories and the AIAG class are undefined.
    pub are_errors: bool,
    /// Drops parts with incomplete cells instead of rejecting the study.
    pub drop_incomplete: bool,
    /// Number of draws of generalized pivotal quantities.
    pub draws: u32,
    /// Seed of the draws.
    pub seed: u64,
    /// Unit of the readings, for printing.
    pub unit: String,
}

impl Default for GaugeSettings {
    fn default() -> GaugeSettings {
        GaugeSettings {
            design: Design::Crossed,
            method: Method::Anova,
            pool: 0.25,
            tolerance: None,
            are_errors: false,
            drop_incomplete: false,
            draws: 200_000,
            seed: 1,
            unit: String::new(),
        }
    }
}

impl GaugeSettings {
    /// Rejects settings outside their range.
    pub(super) fn check(&self) -> Result<(), GaugeError> {
        /// Least number of draws, which leaves ten values beyond each end of the interval.
        const LEAST_DRAWS: u32 = 400;
        let refuse = |name, value, expected| {
            Err(GaugeError::Setting {
                name,
                value,
                expected,
            })
        };
        if !(0.0..=1.0).contains(&self.pool) {
            return refuse("pool", self.pool, "a p value from 0 to 1");
        }
        let tolerance = self.tolerance.unwrap_or(1.0);
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return refuse("tolerance", tolerance, "a width above 0");
        }
        if self.draws < LEAST_DRAWS {
            return refuse("draws", f64::from(self.draws), "at least 400");
        }
        if self.design == Design::Nested && self.method == Method::Range {
            return Err(GaugeError::RangeOfNested);
        }
        Ok(())
    }
}
