//! Descriptions of metrics as data: names, unit, direction, needs, and the family with the required sums.

use std::any::Any;
use std::fmt;

use taceva_core::{Field, FieldSet, Needs, Unit};

use crate::evaluate::family::FamilyKind;
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::sensor_facts::Fact;
use crate::score::theme::Theme;
use crate::score::verdict_rule::VerdictRule;

/// Description of a metric: a number per channel or plane that characterises a sensor or its predictions.
///
/// ```
/// use taceva_metrics::{Better, catalogue};
/// let mae = catalogue::find("mae").ok_or("a metric")?;
/// assert_eq!((mae.better, mae.definition), (Better::Lower, "mae/1"));
/// # Ok::<(), &str>(())
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub struct Metric {
    /// Name in commands, plans and reports.
    pub id: &'static str,
    /// Title in words.
    pub title: &'static str,
    /// Symbol in papers, as LaTeX; `None` without a symbol.
    pub symbol: Option<&'static str>,
    /// Section of reports that shows the metric.
    pub theme: Theme,
    /// Direction of good values: low, high, near zero, or none.
    pub better: Better,
    /// Names of variants with a direction of their own, each with this direction.
    pub variants: &'static [(&'static str, Better)],
    /// Unit of the values.
    pub unit: ScoreUnit,
    /// Range of possible values and interval ends.
    pub range: Range,
    /// Name and version of the definition of the metric, such as `sensitivity/1`. Scores with different versions have different meanings.
    pub definition: &'static str,
    /// Source of the definition.
    pub reference: &'static str,
    /// Description in a few sentences.
    pub documentation: &'static str,
    /// Fields, channels and samples that a value requires.
    pub needs: Needs,
    /// Facts about the sensor that a value requires.
    pub facts: &'static [Fact],
    /// Constants reported with a score, for the unit of its channel.
    pub(crate) constants: fn(Unit) -> Vec<Parameter>,
    /// True if the metric uses predictions before they are clipped to the bounds of the model.
    pub(crate) reads_unbounded: bool,
    /// True if the metric applies only to forces.
    pub(crate) forces_only: bool,
    /// Name of the variant that decides verdicts; `None` if the value itself decides. Set if the value depends on noise or on the number of
    /// repeats.
    pub decided_by: Option<&'static str>,
    /// Rule that decides whether scores of the metric take part in verdicts.
    pub(crate) verdict: VerdictRule,
    /// Value that the deciding variant has by chance alone. Verdicts require an interval that excludes this value.
    pub(crate) chance: Option<f64>,
    /// Family that keeps the sums of the metric.
    pub(crate) family: &'static FamilyKind,
    /// Formula of the metric, which distinguishes several metrics of one family.
    pub(crate) formula: Formula,
}

impl Metric {
    /// Metric of `family` with a default in every other field.
    pub(crate) const fn of(family: &'static FamilyKind) -> Metric {
        Metric {
            id: "",
            title: "",
            symbol: None,
            theme: Theme::Accuracy,
            better: Better::Described,
            variants: &[],
            unit: ScoreUnit::One,
            range: Range::Any,
            definition: "",
            reference: "",
            documentation: "",
            needs: Needs::new(FieldSet::EMPTY),
            facts: &[],
            constants: |_| Vec::new(),
            reads_unbounded: false,
            forces_only: false,
            decided_by: None,
            verdict: VerdictRule::Channels,
            chance: None,
            family,
            formula: Formula(&()),
        }
    }

    /// True if the metric uses predictions of channels.
    pub fn reads_predictions(&self) -> bool {
        self.needs.fields.contains(Field::Prediction)
    }

    /// True if the metric applies only to forces and so needs no predicted positions.
    pub fn is_of_forces(&self) -> bool {
        self.forces_only
    }

    /// True if the metric uses predictions before they are clipped to the bounds of the model. Clipped predictions would show these bounds instead
    /// of the robustness of the model.
    pub fn reads_unbounded_predictions(&self) -> bool {
        self.reads_unbounded
    }

    /// Direction of the variant called `variant`, by default the direction of the metric.
    pub fn better_of(&self, variant: &str) -> Better {
        let mut variants = self.variants.iter();
        let own = variants.find(|(name, _)| *name == variant);
        own.map_or(self.better, |(_, better)| *better)
    }
}

/// Formula of a metric. The family of the metric defines its type.
#[derive(Clone, Copy)]
pub(crate) struct Formula(pub(crate) &'static (dyn Any + Send + Sync));

impl Formula {
    /// The formula as the type `F` of a family; `None` for another type.
    pub(crate) fn get<F: 'static>(self) -> Option<&'static F> {
        self.0.downcast_ref()
    }
}

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Formula")
    }
}

/// Unit of a metric's values.
///
/// ```
/// use taceva_metrics::{ScoreUnit, Unit};
/// assert_eq!(ScoreUnit::PerHour.of(Unit::Newton), Unit::NewtonPerHour);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScoreUnit {
    /// Unit of the channel.
    OfChannel,
    /// Unit of the channel per hour, for channels in mm or N.
    PerHour,
    /// The same unit for every channel.
    Fixed(Unit),
    /// No unit, because the value is a ratio.
    One,
}

impl ScoreUnit {
    /// Unit of a score for a channel in the unit `channel`.
    pub fn of(self, channel: Unit) -> Unit {
        match self {
            ScoreUnit::OfChannel => channel,
            ScoreUnit::PerHour => match channel {
                Unit::Newton => Unit::NewtonPerHour,
                _ => Unit::MillimetrePerHour,
            },
            ScoreUnit::Fixed(unit) => unit,
            ScoreUnit::One => Unit::One,
        }
    }
}
