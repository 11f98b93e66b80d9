//! Description of a metric as data: names, unit, direction, needs, and the family that its scores are finished from.

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

/// A measure of a sensor or of its predictions: one number per channel or plane, with its definition.
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
    /// The name in commands, plans and reports.
    pub id: &'static str,
    /// The name in words.
    pub title: &'static str,
    /// The symbol in papers, as LaTeX.
    pub symbol: Option<&'static str>,
    /// The section of reports that it stands in.
    pub theme: Theme,
    /// Which values are good.
    pub better: Better,
    /// Variants whose direction is not that of the metric.
    pub variants: &'static [(&'static str, Better)],
    /// The unit of its values.
    pub unit: ScoreUnit,
    /// Which values there can be: what no interval leaves.
    pub range: Range,
    /// The definition and its version; another number means another meaning.
    pub definition: &'static str,
    /// Where it is defined.
    pub reference: &'static str,
    /// What it says, in a few sentences.
    pub documentation: &'static str,
    /// Without what there is no value.
    pub needs: Needs,
    /// Which facts about the sensor there is no value without.
    pub facts: &'static [Fact],
    /// Constants that are reported with a score.
    pub(crate) constants: fn(Unit) -> Vec<Parameter>,
    /// Whether predictions enter as the model gives them, beyond its bounds too.
    pub(crate) reads_unbounded: bool,
    /// Whether its values are of forces alone.
    pub(crate) forces_only: bool,
    /// The variant by which verdicts go, where the value itself depends on noise or on how often presses were repeated.
    pub decided_by: Option<&'static str>,
    /// What decides whether its scores take part in verdicts.
    pub(crate) verdict: VerdictRule,
    /// The number of the deciding variant that chance alone would give: its interval must not hold it.
    pub(crate) chance: Option<f64>,
    /// The family whose sums it is finished from.
    pub(crate) family: &'static FamilyKind,
    /// How it is finished, if its family has several metrics.
    pub(crate) formula: Formula,
}

impl Metric {
    /// Metric of `family` without a name: what stays where a metric says nothing else.
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

    /// Whether predictions of channels enter it.
    pub fn reads_predictions(&self) -> bool {
        self.needs.fields.contains(Field::Prediction)
    }

    /// Whether its values are of forces alone, so that places need no prediction for it.
    pub fn is_of_forces(&self) -> bool {
        self.forces_only
    }

    /// Whether it reads predictions as the model gives them, and not brought back to the bounds of the model: robustness would be that of
    /// the bounds otherwise.
    pub fn reads_unbounded_predictions(&self) -> bool {
        self.reads_unbounded
    }

    /// The direction of the variant called `variant`.
    pub fn better_of(&self, variant: &str) -> Better {
        let mut variants = self.variants.iter();
        let own = variants.find(|(name, _)| *name == variant);
        own.map_or(self.better, |(_, better)| *better)
    }
}

/// Formula of a metric, of the type that its family defines.
#[derive(Clone, Copy)]
pub(crate) struct Formula(pub(crate) &'static (dyn Any + Send + Sync));

impl Formula {
    /// The formula as the type `F` of a family.
    pub(crate) fn get<F: 'static>(self) -> Option<&'static F> {
        self.0.downcast_ref()
    }
}

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Formula")
    }
}

/// The unit of a metric's values.
///
/// ```
/// use taceva_metrics::{ScoreUnit, Unit};
/// assert_eq!(ScoreUnit::PerHour.of(Unit::Newton), Unit::NewtonPerHour);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScoreUnit {
    /// That of the channel.
    OfChannel,
    /// That of the channel per hour; mm and N only.
    PerHour,
    /// Always this one.
    Fixed(Unit),
    /// None: a ratio.
    One,
}

impl ScoreUnit {
    /// The unit for a channel kept in `channel`.
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
