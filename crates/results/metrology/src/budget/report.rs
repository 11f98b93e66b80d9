//! Results of a budget in the form `taceva.budget/1`.

use std::fmt;

use serde::{Deserialize, Serialize};
use taceva_core::{distinct, shown};

use super::digits::{beside, two_digits};
use super::freedom::Freedom;
use super::monte_carlo::MonteCarloResult;

/// Warning for a budget without a certificate of the reference.
pub(super) const NOT_TRACEABLE: &str =
    "not traceable: the budget has no certificate of the reference";

/// Name and version of the JSON form.
pub const BUDGET_SCHEMA: &str = "taceva.budget/1";

/// Uncertainty budget of one value. Numbers are unrounded and in `unit`. Printed text rounds U to two digits.
///
/// ```
/// # use taceva_metrology::budget::{BudgetText, Evidence, MonteCarlo};
/// # let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"lamp\"\nu = \"10 mN\"\n";
/// let budget = &BudgetText::parse(text)?.budgets(&Evidence::default(), None)?[0];
/// assert!(budget.to_string().contains("Fz = 1.000 N, U = 0.020 N (k = 1.960, p = 95 %, nu_eff infinite)"));
/// # Ok::<(), taceva_metrology::budget::BudgetError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Budget {
    /// Schema of the JSON form: [`BUDGET_SCHEMA`].
    pub schema: String,
    /// Name of the measurand.
    pub measurand: String,
    /// Reading of the instrument; `None` if an expression gives the value without a reading.
    pub at: Option<f64>,
    /// Unit of all values and uncertainties.
    pub unit: String,
    /// Corrected value.
    pub value: f64,
    /// First-order combined standard uncertainty.
    pub u: f64,
    /// Standard uncertainty including second-order terms.
    pub second_order_u: f64,
    /// Effective degrees of freedom.
    pub nu_eff: Freedom,
    /// Coverage factor for `nu_eff` rounded down; `None` if `nu_eff` is undefined.
    pub k: Option<f64>,
    /// Coverage probability.
    pub p: f64,
    /// First-order expanded uncertainty k u, unrounded, even if `interval` is from draws. `None` if `k` is undefined and `u` above 0.
    #[serde(rename = "U")]
    pub expanded: Option<f64>,
    /// Coverage interval, computed by `method`; `None` if undefined.
    pub interval: Option<[f64; 2]>,
    /// Method of the coverage interval.
    pub method: Method,
    /// Sources in the order of the budget file.
    pub sources: Vec<Source>,
    /// Nonzero correlations between sources.
    pub correlations: Vec<Correlation>,
    /// Monte Carlo result; `None` if not requested.
    pub mcm: Option<MonteCarloResult>,
    /// Effects that no source covers.
    pub missing: Vec<Missing>,
    /// Certificate of the reference; `None` if there is no certificate.
    pub traceability: Option<Traceability>,
    /// Warnings that every output repeats.
    pub warnings: Vec<String>,
}

/// Method of an interval. This type gets no further variant.
///
/// ```
/// use taceva_metrology::budget::Method;
/// assert_eq!(Method::FirstOrder.to_string(), "first order");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Law of propagation and a coverage factor.
    FirstOrder,
    /// Symmetric interval of the Monte Carlo draws.
    MonteCarlo,
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Method::FirstOrder => "first order",
            Method::MonteCarlo => "Monte Carlo",
        })
    }
}

/// A row of a budget.
///
/// ```
/// # use taceva_metrology::budget::{BudgetText, Evidence};
/// # let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"lamp\"\nhalf_width = \"1 %\"\nenters = \"relative\"\n";
/// let source = &BudgetText::parse(text)?.budgets(&Evidence::default(), None)?[0].sources[0];
/// assert_eq!((source.shape.as_str(), source.c, source.share), ("rectangular", 1.0, Some(1.0)));
/// # Ok::<(), taceva_metrology::budget::BudgetError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Source {
    /// Name of the source.
    pub name: String,
    /// `A`, from statistics, or `B`, from other knowledge.
    #[serde(rename = "type")]
    pub kind: char,
    /// Shape of the distribution.
    pub shape: String,
    /// Estimate, in the unit of the source.
    pub value: f64,
    /// Standard uncertainty, in the unit of the source.
    pub u: f64,
    /// Degrees of freedom of `u`.
    pub nu: Freedom,
    /// Sensitivity coefficient, in the unit of the measurand divided by the unit of the source.
    pub c: f64,
    /// Sensitivity coefficient `c` times `u`, with its sign, in the unit of the measurand.
    pub contribution: f64,
    /// Share (c u)² / u² of the combined variance; `None` if that variance is 0. Without correlation the shares sum to 1.
    pub share: Option<f64>,
    /// Measured figure that the source uses; `None` for stated numbers.
    pub from: Option<String>,
    /// Number of rows from which the figure was computed; `None` if unknown.
    pub n: Option<u64>,
    /// Number of clusters, such as contact points, among these rows; `None` if unknown.
    pub clusters: Option<u64>,
    /// Least and greatest true value of the channel in the figure's rows; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub labels: Option<[f64; 2]>,
    /// Digest of the figure's source file; `None` if unknown.
    pub digest: Option<String>,
}

/// Correlation of two sources. This type gets no further field.
///
/// ```
/// let one: taceva_metrology::budget::Correlation = serde_json::from_str(r#"{"between": ["a", "b"], "r": -0.5}"#)?;
/// assert_eq!(one.r, -0.5);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Correlation {
    /// Names of the sources.
    pub between: [String; 2],
    /// Correlation coefficient.
    pub r: f64,
}

/// An effect that no source covers.
///
/// ```
/// let one: taceva_metrology::budget::Missing =
///     serde_json::from_str(r#"{"source": "drift", "reason": "other days: not in this recording"}"#)?;
/// assert_eq!(one.source, "drift");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Missing {
    /// Name of the figure that would cover the effect.
    pub source: String,
    /// Effect, and its relevance to the budget.
    pub reason: String,
}

impl Missing {
    /// Missing effect that the figure `source` would cover.
    pub fn new(source: &str, reason: &str) -> Missing {
        Missing {
            source: source.to_owned(),
            reason: reason.to_owned(),
        }
    }
}

/// Certificate of the reference that a budget relies on.
///
/// ```
/// # use taceva_metrology::budget::Traceability;
/// let one: Traceability =
///     serde_json::from_str(r#"{"number": "D-K-1", "laboratory": "a laboratory", "serial": "42", "valid_until": null}"#)?;
/// assert_eq!(one.number, "D-K-1");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Traceability {
    /// Number of the certificate.
    pub number: String,
    /// Laboratory that issued the certificate.
    pub laboratory: String,
    /// Serial number of the instrument.
    pub serial: String,
    /// Last day of validity; `None` if not stated.
    pub valid_until: Option<String>,
    /// Day of the recording, in the form of `valid_until`; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recorded_on: Option<String>,
}

impl Traceability {
    /// True if the certificate had expired on the day of the recording.
    fn is_expired(&self) -> bool {
        // Dates of one form compare as texts.
        let days = self.recorded_on.as_ref().zip(self.valid_until.as_ref());
        days.is_some_and(|(on, until)| on > until)
    }
}

impl Budget {
    /// Half-width of the interval, rounded to two digits; `None` without an interval.
    pub fn rounded(&self) -> Option<f64> {
        self.half_width().map(two_digits)
    }

    /// Half-width of the interval; the greater half-width for an asymmetric interval. Equals `expanded` unless the interval is from draws.
    pub fn half_width(&self) -> Option<f64> {
        match self.method {
            Method::FirstOrder => self.expanded,
            Method::MonteCarlo => self.interval.map(|ends| {
                let [low, high] = ends.map(|end| (end - self.value).abs());
                low.max(high)
            }),
        }
    }

    /// Value, expanded uncertainty U in two digits and coverage, in one line. An interval from draws has no k and no degrees of freedom.
    pub fn statement(&self) -> String {
        let (unit, name) = (shown(&self.unit), shown(&self.measurand));
        let value = beside(self.value, self.scale());
        let (p, freedom) = (self.p * 100.0, self.nu_eff);
        let of_draws = self.rounded().filter(|_| self.method == Method::MonteCarlo);
        if let Some(half) = of_draws {
            let half = beside(half, half);
            return format!(
                "{name} = {value} {unit}, U = {half} {unit} (half-width of the Monte Carlo interval, p = {p} %)"
            );
        }
        let uncertainty = match (self.rounded(), self.k) {
            (Some(expanded), Some(k)) => {
                format!("U = {} {unit} (k = {k:.3}", beside(expanded, expanded))
            }
            (Some(expanded), None) => format!("U = {expanded} {unit} (no k"),
            _ => format!("u = {} {unit} (no U", beside(self.u, self.u)),
        };
        format!("{name} = {value} {unit}, {uncertainty}, p = {p} %, nu_eff {freedom})")
    }

    /// Interval and its method, in words; `None` without an interval.
    pub fn interval_in_words(&self) -> Option<String> {
        let [low, high] = self.interval?.map(|end| beside(end, self.scale()));
        let unit = shown(&self.unit);
        Some(format!("interval {low} to {high} {unit}, {}", self.method))
    }

    /// Caveat about the reference: no certificate, or a certificate that had expired on the day of the recording; `None` for neither.
    pub fn reservation(&self) -> Option<&'static str> {
        let stated = self.traceability.as_ref();
        if stated.is_some_and(Traceability::is_expired) {
            return Some("certificate expired");
        }
        let mut warnings = self.warnings.iter();
        warnings
            .any(|warning| warning == NOT_TRACEABLE)
            .then_some("not traceable")
    }

    /// Distinct ranges of true values that the sources were measured on, in words.
    pub fn labels_in_words(&self) -> Vec<String> {
        let ranges = self.label_ranges().into_iter();
        ranges.map(|range| self.range_in_words(range)).collect()
    }

    /// Warnings for a reading outside the true values on which a source was measured.
    pub(super) fn beyond_labels(&self) -> Vec<String> {
        let Some(at) = self.at else {
            return Vec::new();
        };
        let mut ranges = self.label_ranges();
        // The ends themselves are rounded.
        let rounding = |[low, high]: &[f64; 2]| 1e-9 * (high - low);
        ranges.retain(|of| at < of[0] - rounding(of) || at > of[1] + rounding(of));
        let warning = |range: [f64; 2]| {
            format!(
                "{at} {} is outside the labels of the samples, {}: their errors may not apply to this reading",
                shown(&self.unit),
                self.range_in_words(range)
            )
        };
        ranges.into_iter().map(warning).collect()
    }

    fn label_ranges(&self) -> Vec<[f64; 2]> {
        distinct(self.sources.iter().filter_map(|source| source.labels))
    }

    /// Range as text, to three digits of its width.
    fn range_in_words(&self, [low, high]: [f64; 2]) -> String {
        let place = (high - low).max(high.abs() / 10.0) / 10.0;
        let [low, high] = [low, high].map(|end| beside(end, place));
        let unit = shown(&self.unit);
        format!("{low} {unit} to {high} {unit}")
    }

    /// Uncertainty that determines the decimals of printed values.
    fn scale(&self) -> f64 {
        let wide = self.half_width().filter(|half| *half > 0.0);
        wide.unwrap_or(self.u)
    }

    /// Correlation of the values of two budgets with the same sources; `None` if either value has no uncertainty.
    ///
    /// # Reference
    /// GUM H.2.3: r = ΣΣ cᵢuᵢ cⱼ′uⱼ′ rᵢⱼ / (u u′), with contributions cᵢuᵢ to u here and cⱼ′uⱼ′ to u′ in `other`, and correlations rᵢⱼ.
    pub fn correlation_with(&self, other: &Budget) -> Option<f64> {
        let r = |one: &str, two: &str| {
            let pair = |of: &&Correlation| of.between == [one, two] || of.between == [two, one];
            let stated = self.correlations.iter().find(pair).map(|of| of.r);
            stated.unwrap_or(if one == two { 1.0 } else { 0.0 })
        };
        let others = || other.sources.iter();
        let pairs = self
            .sources
            .iter()
            .flat_map(|one| others().map(move |two| (one, two)));
        let covariance: f64 = pairs
            .map(|(one, two)| one.contribution * two.contribution * r(&one.name, &two.name))
            .sum();
        let scale = self.u * other.u;
        (scale > 0.0).then(|| covariance / scale)
    }
}

impl fmt::Display for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = shown(&self.unit);
        for warning in &self.warnings {
            writeln!(f, "warning: {warning}")?;
        }
        writeln!(f, "{}", self.statement())?;
        if let Some(interval) = self.interval_in_words() {
            writeln!(f, "{interval}")?;
        }
        for source in &self.sources {
            let (kind, name, shape, nu) =
                (source.kind, shown(&source.name), &source.shape, source.nu);
            let contribution = beside(source.contribution, self.u);
            write!(f, "  {kind} {name}: {contribution} {unit}, ")?;
            match source.share {
                Some(share) => writeln!(f, "{:.1} %, {shape}, nu {nu}", share * 100.0)?,
                None => writeln!(f, "-, {shape}, nu {nu}")?,
            }
        }
        if !self.correlations.is_empty() {
            writeln!(f, "  shares do not add up to 100 %: sources are correlated")?;
        }
        for Missing { source, reason } in &self.missing {
            writeln!(f, "  missing: {} ({reason})", shown(source))?;
        }
        Ok(())
    }
}
