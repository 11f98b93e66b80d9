//! Description of a metric as data: names, unit, direction, needs, and the family whose sums its scores need.

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
    /// Section of reports.
    pub theme: Theme,
    /// Direction of good values.
    pub better: Better,
    /// Variants with another direction than the metric.
    pub variants: &'static [(&'static str, Better)],
    /// The unit of its values.
    pub unit: ScoreUnit,
    /// Range of possible values, which also bounds intervals.
    pub range: Range,
    /// Definition with its version; a new version changes the meaning.
    pub definition: &'static str,
    /// Source of the definition.
    pub reference: &'static str,
    /// Description in a few sentences.
    pub documentation: &'static str,
    /// Fields, channels and samples that a value requires.
    pub needs: Needs,
    /// Facts about the sensor that a value requires.
    pub facts: &'static [Fact],
    /// Constants that are reported with a score.
    pub(crate) constants: fn(Unit) -> Vec<Parameter>,
    /// True if predictions enter unclipped, beyond the bounds of the model too.
    pub(crate) reads_unbounded: bool,
    /// True if it scores only forces.
    pub(crate) forces_only: bool,
    /// Variant that decides verdicts, if the value itself depends on noise or on the number of repeats.
    pub decided_by: Option<&'static str>,
    /// Rule for the standing of its scores in verdicts.
    pub(crate) verdict: VerdictRule,
    /// Value of the deciding variant under chance alone, which its interval must exclude.
    pub(crate) chance: Option<f64>,
    /// Family whose sums the metric is computed from.
    pub(crate) family: &'static FamilyKind,
    /// Formula, if its family has several metrics.
    pub(crate) formula: Formula,
}

impl Metric {
    /// Metric of `family` without a name: the defaults of every field.
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

    /// True if it uses predictions of channels.
    pub fn reads_predictions(&self) -> bool {
        self.needs.fields.contains(Field::Prediction)
    }

    /// True if it scores only forces, so that it needs no predicted positions.
    pub fn is_of_forces(&self) -> bool {
        self.forces_only
    }

    /// True if it reads predictions unclipped. Otherwise robustness would describe the bounds of the model.
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
    /// Unit of the channel.
    OfChannel,
    /// Unit of the channel per hour; mm and N only.
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
