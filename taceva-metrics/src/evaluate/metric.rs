//! A metric as data: what it is called, what it needs, and how it is finished from what was kept.

use taceva_core::{Field, Needs, Unit};

use crate::exact::streams::Streams;
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::plane_sums::PlaneSums;
use crate::score::Parameter;
use crate::score::better::Better;
use crate::score::facts::Fact;
use crate::score::range::Range;
use crate::score::value::UndefinedReason;

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
    /// Which values are good.
    pub better: Better,
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
    pub(crate) constants: Constants,
    pub(crate) formula: Formula,
}

impl Metric {
    /// Whether predictions of channels enter it.
    pub fn reads_predictions(&self) -> bool {
        self.needs.fields.contains(Field::Prediction)
    }

    /// Whether it reads predictions as the model gives them, and not brought back to the bounds of the model: robustness would be that of
    /// the bounds otherwise.
    pub fn reads_unbounded_predictions(&self) -> bool {
        matches!(self.formula, Formula::Spatial | Formula::Lighting)
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

/// The constants that are reported with a score.
pub(crate) type Constants = fn(Unit) -> Vec<Parameter>;

/// What a metric is finished from, and how.
#[derive(Debug)]
pub(crate) enum Formula {
    /// From the sums of each channel's pairs.
    Pairs {
        /// The sums it reads.
        streams: Streams,
        /// Whether it counts only samples that reach the gate.
        gated: bool,
        /// How it is finished.
        finish: Finish<PairSums>,
    },
    /// From the sums of each channel's pairs and the constant that its model is measured by.
    Skill,
    /// From the distances in a plane of two channels.
    Plane(Finish<PlaneSums>),
    /// From the compliance of the surface: how far it yields.
    Sensitivity,
    /// From the compliance of the surface, by place: how alike it yields everywhere.
    Uniformity,
    /// From the errors of the spacing of gratings.
    Resolution,
    /// From errors by distance and depth.
    Spatial,
    /// From errors by scene.
    Lighting,
    /// From predictions of the same press: the spread within cells.
    Repeatability,
    /// From predictions of the same press: the spread of the cells' means in relation to that within them.
    SignalToRepeatability,
    /// From loading and unloading, by point.
    Hysteresis,
    /// From the surfaces of several units.
    InterSensor,
    /// From times, digests and places of contact.
    Intrinsic,
    /// From predictions without contact.
    Detection,
    /// From predictions over truth.
    Linearity,
    /// From all predictions over all truths.
    Crosstalk,
    /// From errors by level of the truth.
    BiasLevel,
    /// From magnitudes of errors.
    Tolerance,
    /// From errors over time.
    Drift,
}

/// From sums to a value.
#[derive(Debug)]
pub(crate) struct Finish<S> {
    /// The samples that take part.
    pub(crate) count: fn(&S) -> u64,
    /// The value.
    pub(crate) evaluate: fn(&S) -> Result<f64, UndefinedReason>,
}
