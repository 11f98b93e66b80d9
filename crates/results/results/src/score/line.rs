//! Lines of a score: one for the score and one per variant, for rows of tables.

use taceva_core::Unit;
use taceva_metrics::Better;

use super::Score;
use crate::interval::Interval;
use crate::value::Value;

/// Name of a metric, followed by the name of a variant if given: `mae`, `r_spatial.within`.
///
/// ```
/// assert_eq!(taceva_results::full_name("r_spatial", Some("within")), "r_spatial.within");
/// ```
pub fn full_name(metric: &str, variant: Option<&str>) -> String {
    match variant {
        Some(variant) => format!("{metric}.{variant}"),
        None => metric.to_owned(),
    }
}

/// One number of a score or of its variant, or the reason for its absence. Corresponds to one row of a table.
///
/// ```
/// use taceva_core::Unit;
/// use taceva_results::Score;
/// let score = Score::of_number("mae", "Fz", 0.5, Unit::Newton);
/// let names: Vec<String> = score.lines().map(|line| line.shown_name()).collect();
/// assert_eq!(names, ["mae ↓"]);
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ScoreLine<'a> {
    /// Name of the metric, followed by the name of the variant: `mae`, `r_spatial.within`.
    pub name: String,
    /// Channel or plane of the score.
    pub channel: &'a str,
    /// Value, or the reason for its absence.
    pub value: &'a Value,
    /// Unit of value and interval.
    pub unit: Unit,
    /// Interval; `None` if the metric or variant has no interval.
    pub interval: Option<&'a Interval>,
    /// Score to which the number belongs.
    pub score: &'a Score,
    /// True for the value of the score itself, false for one of its variants.
    pub is_headline: bool,
}

impl Score {
    /// Lines of the score and of its variants with a single number. Maps, curves and matrices of variants have no line.
    pub fn lines(&self) -> impl Iterator<Item = ScoreLine<'_>> {
        let own = ScoreLine {
            name: self.metric.clone(),
            channel: &self.channel,
            value: &self.value,
            unit: self.unit,
            interval: self.interval.as_ref(),
            score: self,
            is_headline: true,
        };
        let single = self.variants.iter();
        let single = single.filter(|variant| !variant.value.is_of_many());
        let single = single.map(move |variant| ScoreLine {
            name: full_name(&self.metric, Some(&variant.name)),
            channel: &self.channel,
            value: &variant.value,
            unit: variant.unit,
            interval: variant.interval.as_ref(),
            score: self,
            is_headline: false,
        });
        std::iter::once(own).chain(single)
    }
}

impl ScoreLine<'_> {
    /// Name with an arrow in the direction of better values: `mae ↓`.
    pub fn shown_name(&self) -> String {
        Better::named(&self.name)
    }

    /// True for the score of a constant prediction, which is listed for reference and is not a score of the model.
    pub fn is_reference(&self) -> bool {
        matches!(
            self.name.as_str(),
            "skill.constant" | "sr.of_constant" | "tolerance.of_constant"
        )
    }
}
