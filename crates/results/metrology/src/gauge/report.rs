//! Report of a gauge study, in the form of its files.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::table::TableRow;
use super::{Design, Method};

/// Schema of the JSON form.
pub const SCHEMA: &str = "taceva.gauge/1";

/// Component of variance.
///
/// ```
/// use taceva_metrology::gauge::ComponentName;
/// assert_eq!(ComponentName::Gauge.to_string(), "gauge (R&R)");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ComponentName {
    /// Variance between trials; AIAG's equipment variation.
    Repeatability,
    /// Variance between operators.
    Operator,
    /// Interaction between operators and parts.
    Interaction,
    /// Sum of the operator and interaction variances; AIAG's appraiser variation.
    Reproducibility,
    /// Sum of the repeatability and reproducibility variances.
    Gauge,
    /// Variance between parts.
    Part,
    /// Sum of the gauge and part variances.
    Total,
}

impl fmt::Display for ComponentName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            ComponentName::Repeatability => "repeatability",
            ComponentName::Operator => "operator",
            ComponentName::Interaction => "interaction",
            ComponentName::Reproducibility => "reproducibility",
            ComponentName::Gauge => "gauge (R&R)",
            ComponentName::Part => "part",
            ComponentName::Total => "total",
        })
    }
}

/// Method for computing an interval.
///
/// ```
/// use taceva_metrology::gauge::IntervalMethod;
/// assert_ne!(IntervalMethod::ChiSquare, IntervalMethod::Generalized);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum IntervalMethod {
    /// Chi-square distribution, for a single mean square.
    ChiSquare,
    /// Modified large-sample method of Graybill and Wang.
    ModifiedLargeSamples,
    /// Generalized pivotal quantities.
    Generalized,
}

/// One component of variance.
///
/// ```
/// use taceva_metrology::gauge::{Component, ComponentName};
/// let text = r#"{"name":"part","variance":4.0,"sd":2.0,"ci95":[1.0,9.0],"interval":"generalized"}"#;
/// let part: Component = serde_json::from_str(text)?;
/// assert_eq!((part.name, part.ci95), (ComponentName::Part, [1.0, 9.0]));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Component {
    /// Name of the component.
    pub name: ComponentName,
    /// Estimate before a negative value is replaced by 0; `None` for sums and for the range method.
    pub variance_raw: Option<f64>,
    /// Variance, in the square of the unit of the readings.
    pub variance: f64,
    /// Standard deviation, in the unit of the readings.
    pub sd: f64,
    /// 95 % confidence interval of the standard deviation.
    pub ci95: [f64; 2],
    /// Method of `ci95`.
    pub interval: IntervalMethod,
    /// Share of the total variance, in per cent; `None` without variation.
    pub percent_contribution: Option<f64>,
    /// Ratio of `sd` to the total standard deviation, in per cent; `None` without variation.
    pub percent_study: Option<f64>,
    /// 95 % confidence interval of `percent_study`, by generalized pivotal quantities; `None` without variation.
    pub percent_study_ci95: Option<[f64; 2]>,
    /// Six standard deviations divided by the tolerance, in per cent; `None` without a tolerance.
    pub percent_tolerance: Option<f64>,
    /// 95 % confidence interval of `percent_tolerance`; `None` without a tolerance.
    pub percent_tolerance_ci95: Option<[f64; 2]>,
}

/// Reason for an undefined number of distinct categories.
///
/// ```
/// use taceva_metrology::gauge::NdcReason;
/// assert_eq!(NdcReason::NoVariation.to_string(), "all readings are equal");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum NdcReason {
    /// All readings are equal.
    NoVariation,
    /// The gauge variation is 0.
    NoGaugeVariation,
    /// The readings are errors instead of values.
    Errors,
}

impl fmt::Display for NdcReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NdcReason::NoVariation => "all readings are equal",
            NdcReason::NoGaugeVariation => "the gauge adds no variation",
            NdcReason::Errors => {
                "the readings are errors, so parts differ by bias and not by measurand"
            }
        })
    }
}

/// Number of distinct categories: √2 times the ratio of part to gauge standard deviation.
///
/// ```
/// use taceva_metrology::gauge::Ndc;
/// let ndc: Ndc = serde_json::from_str(r#"{"value":4.875,"floor":4,"ci95":[1.0,9.2]}"#)?;
/// assert_eq!((ndc.floor, ndc.undefined), (Some(4), None));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Ndc {
    /// Unrounded value; `None` if undefined.
    pub value: Option<f64>,
    /// Value rounded down, as AIAG counts distinct categories; `None` if undefined.
    pub floor: Option<u64>,
    /// 95 % confidence interval, by generalized pivotal quantities; `None` if the value is undefined.
    pub ci95: Option<[f64; 2]>,
    /// Reason for a missing value; `None` if the value is defined.
    pub undefined: Option<NdcReason>,
}

/// AIAG's class for the ratio of gauge to total standard deviation.
///
/// ```
/// use taceva_metrology::gauge::Band;
/// assert_eq!(Band::of(27.9), Band::Conditional);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Band {
    /// Ratio below 10 %.
    Acceptable,
    /// Ratio from 10 to 30 %.
    Conditional,
    /// Ratio above 30 %.
    Unacceptable,
}

impl Band {
    /// Class of a ratio in per cent.
    #[must_use]
    pub fn of(percent: f64) -> Band {
        if percent < 10.0 {
            Band::Acceptable
        } else if percent <= 30.0 {
            Band::Conditional
        } else {
            Band::Unacceptable
        }
    }
}

/// Remark about a study.
///
/// ```
/// use taceva_metrology::gauge::Flag;
/// let flag = Flag::FewOperators { operators: 3 };
/// assert_eq!(flag.to_string(), "reproducibility has only 2 degrees of freedom, from 3 operators");
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "flag", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Flag {
    /// Fewer than five operators.
    FewOperators {
        /// Number of operators.
        operators: usize,
    },
    /// A negative variance estimate, replaced by 0.
    NegativeComponent {
        /// Name of the component.
        component: ComponentName,
        /// Estimate of the variance.
        variance: f64,
    },
    /// The interaction was pooled with repeatability.
    Pooled {
        /// p value of the interaction.
        p: f64,
        /// Threshold of the p value above which the interaction is pooled.
        above: f64,
    },
    /// Incomplete parts were dropped.
    Dropped {
        /// Number of dropped parts.
        parts: usize,
    },
    /// All readings are equal.
    NoVariation,
}

impl fmt::Display for Flag {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Flag::FewOperators { operators } => {
                let freedom = operators.saturating_sub(1);
                let degrees = if freedom == 1 { "degree" } else { "degrees" };
                write!(
                    f,
                    "reproducibility has only {freedom} {degrees} of freedom, from {operators} operators"
                )
            }
            Flag::NegativeComponent {
                component,
                variance,
            } => {
                write!(
                    f,
                    "{component}: the estimated variance is {variance:.4e}, counted as 0"
                )
            }
            Flag::Pooled { p, above } => {
                write!(
                    f,
                    "interaction pooled with repeatability: p = {p:.3} is above {above}"
                )
            }
            Flag::Dropped { parts } => write!(f, "parts left out as incomplete: {parts}"),
            Flag::NoVariation => f.write_str("all readings are equal"),
        }
    }
}

/// Report of a gauge study, with the JSON schema `taceva.gauge/1`.
///
/// ```
/// use taceva_metrology::gauge::{GaugeReport, GaugeSettings, GaugeStudy};
/// let mut study = GaugeStudy::default();
/// for (at, value) in [1.0, 1.1, 1.2, 1.4, 2.0, 2.2, 2.1, 2.3].into_iter().enumerate() {
///     study.add(["p", "q"][at / 4], ["A", "B"][at / 2 % 2], ["1", "2"][at % 2], value)?;
/// }
/// let report = study.analyse(&GaugeSettings::default())?;
/// let text = serde_json::to_string(&report)?;
/// assert!(text.starts_with(r#"{"schema":"taceva.gauge/1","design":"crossed""#));
/// assert_eq!(serde_json::from_str::<GaugeReport>(&text)?.parts, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct GaugeReport {
    /// Name and version of the JSON schema.
    pub schema: String,
    /// Relation of parts and operators.
    pub design: Design,
    /// Estimator of the components.
    pub method: Method,
    /// Unit of the readings.
    pub unit: String,
    /// Number of parts: of the study if crossed, of each operator if nested.
    pub parts: usize,
    /// Number of operators.
    pub operators: usize,
    /// Number of readings of each part by each operator.
    pub trials: usize,
    /// Number of dropped incomplete parts.
    pub dropped: usize,
    /// Table of the analysis of variance.
    pub table: Vec<TableRow>,
    /// True if the interaction was pooled with repeatability.
    pub pooled: bool,
    /// Components of variance.
    pub components: Vec<Component>,
    /// Width of the tolerance, in the unit of the readings; `None` if not given.
    pub tolerance: Option<f64>,
    /// Number of distinct categories.
    pub ndc: Ndc,
    /// AIAG class of the gauge. `None` if the readings are errors, or do not vary.
    pub band: Option<Band>,
    /// AIAG classes of both ends of the gauge's confidence interval; `None` if `band` is `None`.
    pub band_ci95: Option<[Band; 2]>,
    /// Number of draws of generalized pivotal quantities.
    pub draws: u32,
    /// Seed of the draws.
    pub seed: u64,
    /// Remarks on the study.
    pub flags: Vec<Flag>,
}

impl GaugeReport {
    /// Component called `name`; `None` if the design lacks the component.
    pub fn component(&self, name: ComponentName) -> Option<&Component> {
        self.components.iter().find(|one| one.name == name)
    }
}
