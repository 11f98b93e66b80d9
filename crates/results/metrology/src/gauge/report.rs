//! Report of a gauge study, as it is written to a file.

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
    /// Between trials; AIAG's equipment variation.
    Repeatability,
    /// Between operators.
    Operator,
    /// Between operators from part to part.
    Interaction,
    /// Operators and interaction; AIAG's appraiser variation.
    Reproducibility,
    /// Repeatability and reproducibility.
    Gauge,
    /// Between parts.
    Part,
    /// Gauge and parts.
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

/// Method of an interval.
///
/// ```
/// use taceva_metrology::gauge::IntervalMethod;
/// assert_ne!(IntervalMethod::ChiSquare, IntervalMethod::Generalized);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum IntervalMethod {
    /// The chi-square distribution of one mean square.
    ChiSquare,
    /// Modified large samples of Graybill and Wang.
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
    /// Estimate before a negative one is counted as 0; none for a sum and for the range method.
    pub variance_raw: Option<f64>,
    /// Variance, in the square of the unit of the readings.
    pub variance: f64,
    /// Standard deviation, in the unit of the readings.
    pub sd: f64,
    /// Interval of 95 % of the standard deviation.
    pub ci95: [f64; 2],
    /// Method of this interval.
    pub interval: IntervalMethod,
    /// Variance over that of the total, in per cent; none without variation.
    pub percent_contribution: Option<f64>,
    /// Standard deviation over that of the total, in per cent; none without variation.
    pub percent_study: Option<f64>,
    /// Interval of 95 % of `percent_study`, by generalized pivotal quantities.
    pub percent_study_ci95: Option<[f64; 2]>,
    /// Six standard deviations over the tolerance, in per cent.
    pub percent_tolerance: Option<f64>,
    /// Interval of 95 % of `percent_tolerance`.
    pub percent_tolerance_ci95: Option<[f64; 2]>,
}

/// Reason that the number of distinct categories is undefined.
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
    /// The gauge adds no variation to that of the parts.
    NoGaugeVariation,
    /// The readings are errors.
    Errors,
}

impl fmt::Display for NdcReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NdcReason::NoVariation => "all readings are equal",
            NdcReason::NoGaugeVariation => "the gauge adds no variation",
            NdcReason::Errors => "parts of errors differ by bias, not by what is measured",
        })
    }
}

/// Number of distinct categories: √2 times the deviation of the parts over that of the gauge.
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
    /// Value without rounding.
    pub value: Option<f64>,
    /// Whole categories, as AIAG counts them.
    pub floor: Option<u64>,
    /// Interval of 95 %, by generalized pivotal quantities.
    pub ci95: Option<[f64; 2]>,
    /// Reason for a missing value.
    pub undefined: Option<NdcReason>,
}

/// AIAG's bands of the share of the gauge in the study.
///
/// ```
/// use taceva_metrology::gauge::Band;
/// assert_eq!(Band::of(27.9), Band::Conditional);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Band {
    /// Below 10 %.
    Acceptable,
    /// From 10 to 30 %.
    Conditional,
    /// Above 30 %.
    Unacceptable,
}

impl Band {
    /// Band of a share in per cent.
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

/// Remark on a study.
///
/// ```
/// use taceva_metrology::gauge::Flag;
/// let flag = Flag::FewOperators { operators: 3 };
/// assert_eq!(flag.to_string(), "reproducibility rests on 2 degrees of freedom, of 3 operators");
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
    /// A component below 0, counted as 0.
    NegativeComponent {
        /// Name of the component.
        component: ComponentName,
        /// Estimate of the component, a variance.
        variance: f64,
    },
    /// The interaction was pooled with repeatability.
    Pooled {
        /// The p value of the interaction.
        p: f64,
        /// The p value above which it is pooled.
        above: f64,
    },
    /// Parts left out.
    Dropped {
        /// Number of parts.
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
                    "reproducibility rests on {freedom} {degrees} of freedom, of {operators} operators"
                )
            }
            Flag::NegativeComponent {
                component,
                variance,
            } => {
                write!(
                    f,
                    "{component}: the estimate of the variance is {variance:.4e}, counted as 0"
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

/// Report of a gauge study; its JSON form has the schema `taceva.gauge/1`.
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
    /// Name and version of the form.
    pub schema: String,
    /// Relation of parts and operators.
    pub design: Design,
    /// Estimator of the components.
    pub method: Method,
    /// Unit of the readings.
    pub unit: String,
    /// Parts of the study if crossed, of each operator if nested.
    pub parts: usize,
    /// Number of operators.
    pub operators: usize,
    /// Readings of each part by each operator.
    pub trials: usize,
    /// Parts left out as incomplete.
    pub dropped: usize,
    /// Analysis of variance.
    pub table: Vec<TableRow>,
    /// True if the interaction was pooled with repeatability.
    pub pooled: bool,
    /// Components of variance.
    pub components: Vec<Component>,
    /// Width of the tolerance, in the unit of the readings.
    pub tolerance: Option<f64>,
    /// Number of distinct categories.
    pub ndc: Ndc,
    /// Band of the share of the gauge in the study.
    pub band: Option<Band>,
    /// Bands of both ends of the interval of this share.
    pub band_ci95: Option<[Band; 2]>,
    /// Draws of generalized pivotal quantities.
    pub draws: u32,
    /// Seed of the draws.
    pub seed: u64,
    /// Remarks.
    pub flags: Vec<Flag>,
}

impl GaugeReport {
    /// The component `name`, if the design has it.
    pub fn component(&self, name: ComponentName) -> Option<&Component> {
        self.components.iter().find(|one| one.name == name)
    }
}
