//! Values of a score: one number, many numbers, or the reason for a missing value.

use std::fmt::{self, Write as _};

use taceva_core::{Unit, counted};

use crate::score::curve::Curve;
use crate::score::digits::significant;
use crate::score::map::Map;
use crate::score::matrix::Matrix;

/// Value of a score. The printed text has four digits, or the decimals of a precision such as `{:.2}`; [`scalar`](Value::scalar) returns all
/// digits. A width such as `{:>24}` applies to numbers and words alike.
///
/// ```
/// use taceva_metrics::{UndefinedReason, Value};
/// assert_eq!(Value::Scalar(0.5).scalar(), Some(0.5));
/// assert_eq!(Value::Scalar(1.0 / 3.0).to_string(), "0.3333");
/// assert_eq!(format!("{:.2}", Value::Scalar(0.5)), "0.50");
/// assert_eq!(Value::Undefined(UndefinedReason::Empty).to_string(), "undefined: empty");
/// assert_eq!(format!("{:>18}", Value::Undefined(UndefinedReason::Empty)), "  undefined: empty");
/// assert_eq!(Value::Undefined(UndefinedReason::Empty).scalar(), None);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value {
    /// One finite number.
    Scalar(f64),
    /// A number for each place of the sensing surface.
    Map(Map),
    /// A number for each level of another quantity.
    Curve(Curve),
    /// A number for each pair of names.
    Matrix(Matrix),
    /// The samples determine no value.
    Undefined(UndefinedReason),
    /// The metric does not apply to this channel or sensor.
    NotApplicable(InapplicableReason),
}

impl Value {
    /// Number of a [`Value::Scalar`]; `None` for any other value.
    pub fn scalar(&self) -> Option<f64> {
        match self {
            Value::Scalar(value) => Some(*value),
            _ => None,
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Scalar(value) if f.precision().is_some() => fmt::Display::fmt(value, f),
            Value::Scalar(value) => f.pad(&significant(*value)),
            Value::Map(_) => pad(f, "a map"),
            Value::Curve(_) => pad(f, "a curve"),
            Value::Matrix(_) => pad(f, "a matrix"),
            Value::Undefined(reason) => pad(f, &format!("undefined: {reason}")),
            Value::NotApplicable(reason) => pad(f, &format!("not applicable: {reason}")),
        }
    }
}

/// Writes `words` padded to the width of the formatter. The precision is ignored, because [`fmt::Formatter::pad`] would shorten the words to it.
fn pad(f: &mut fmt::Formatter<'_>, words: &str) -> fmt::Result {
    let room = f.width().unwrap_or(0).saturating_sub(words.chars().count());
    let before = match f.align() {
        Some(fmt::Alignment::Right) => room,
        Some(fmt::Alignment::Center) => room / 2,
        Some(fmt::Alignment::Left) | None => 0,
    };
    let fill = f.fill();
    (0..before).try_for_each(|_| f.write_char(fill))?;
    f.write_str(words)?;
    (before..room).try_for_each(|_| f.write_char(fill))
}

/// A finite number, or the reason why it is missing.
pub(crate) type Finished = Result<f64, UndefinedReason>;

impl From<Result<f64, UndefinedReason>> for Value {
    fn from(result: Result<f64, UndefinedReason>) -> Value {
        match result {
            Ok(value) => Value::Scalar(value),
            Err(reason) => Value::Undefined(reason),
        }
    }
}

/// Reason why the samples determine no value or no interval.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator, UndefinedReason, Value};
/// let evaluator = Evaluator::of_channels([Channel::FZ])?;
/// let scores = evaluator.finish()?;
/// let mae = scores.mae(Channel::FZ).ok_or("a score")?;
/// assert_eq!(mae.value, Value::Undefined(UndefinedReason::Empty));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum UndefinedReason {
    /// There is no sample.
    Empty,
    /// There are fewer samples than the formula needs.
    TooFew {
        /// Least number of samples that the formula needs.
        least: u64,
    },
    /// All true values are equal, but the formula needs their spread.
    ConstantTruth {
        /// True if every prediction equals the constant truth.
        perfect: bool,
    },
    /// No true value reaches the contact threshold.
    BelowGate,
    /// No sample is within the declared footprint.
    OutsideFootprint,
    /// No bin has enough samples.
    NoBin {
        /// Least number of samples of a bin.
        least: u64,
    },
    /// There are fewer bins with enough samples than the formula needs.
    TooFewBins {
        /// Number of bins found.
        have: u64,
        /// Least number of bins that the formula needs.
        least: u64,
    },
    /// No bin or cell has two samples, so the spread by chance is unknown.
    NoRepeats,
    /// No press was repeated.
    NoRepeatedPress,
    /// There are fewer repeated presses than the formula needs.
    TooFewCells {
        /// Number of repeated presses found.
        have: u64,
        /// Least number of repeated presses that the formula needs.
        least: u64,
    },
    /// The repeats of every press are equal, so a ratio to their spread is undefined.
    EqualRepeats,
    /// All errors are equal, so their scatter is 0.
    EqualErrors,
    /// The mean of truth and prediction is the same for every sample, so errors have no slope over it.
    EqualMeans,
    /// All samples belong to one cluster, so the scatter between clusters is unknown.
    OneCluster,
    /// No contact point has samples at two depths both while loading and while unloading.
    ShortBranch,
    /// The compared ranges, such as depths of loading and unloading or surfaces of two units, do not overlap.
    NoOverlap,
    /// No force was measured.
    NoForce,
    /// Every sample is in contact, but the metric needs samples without contact.
    NoIdleSamples,
    /// No press has a light force, from 0.02 N to 0.2 N.
    NoLightPresses,
    /// The light presses are at too few places. Unequal numbers of presses reduce the effective number of places.
    TooFewPlaces {
        /// Effective number of places.
        have: u64,
        /// Least effective number of places.
        least: u64,
    },
    /// Predictions do not increase with the force of light presses.
    NoRise,
    /// The detection limit exceeds the forces of all light presses.
    BeyondLightPresses,
    /// The detection limit falls below the lightest press if one place is left out. The limit then has no interval.
    AtLightestPress,
    /// No sample in contact has a place.
    NoContact,
    /// There is only one channel, but the comparison needs two.
    OneChannel,
    /// There is only one unit of the sensor, but the comparison needs two.
    OneUnit,
    /// The rotation between two units is undetermined: there are fewer than three points, or all are on one line.
    OpenTurn,
    /// No sample has a time.
    NoTimes,
    /// All samples have the same time.
    EqualTimes,
    /// No two successive frames have a digest (checksum of the picture).
    NoDigests,
    /// The median time between pictures exceeds one second, so they have no frame rate.
    NoStream,
    /// The named fact about the sensor is not declared.
    NotDeclared(&'static str),
    /// No interval is defined for this score.
    NoInterval,
    /// The score is a maximum of several numbers. Resampling does not show the variation of a maximum.
    Greatest,
    /// The value is at an end of its range and stays there if any one cluster is left out. The variation is unknown.
    AtEnd,
    /// The mean is zero, so a ratio to it is undefined.
    ZeroMean,
    /// No sample belongs to the reference scene.
    NoReferenceScene,
    /// All samples belong to the reference scene, so there is no scene to compare with it.
    OneScene,
    /// The pictures of the reference scene are black.
    ZeroIntensity,
    /// The error in the reference scene is zero.
    ZeroBaseline,
    /// Neither the light nor the error differs from the reference scene.
    NoChange,
    /// Every value is NaN or too large to round to a millionth of its unit.
    NoMillionths,
    /// The value exceeds the range of binary64.
    Overflow,
    /// There are too few clusters for an interval.
    TooFewClusters {
        /// Number of clusters found.
        have: usize,
    },
    /// Too few bootstrap replicates have a value: fewer than 39, or fewer than 95 % of all.
    TooFewReplicates {
        /// Number of replicates with a value.
        defined: usize,
        /// Number of replicates drawn.
        drawn: usize,
    },
    /// A sample has no contact point, so the clusters are unknown.
    NoClusters,
    /// The score has no value if one of the clusters is left out.
    HangsOnOneCluster,
}

impl fmt::Display for UndefinedReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            UndefinedReason::Empty => f.write_str("empty"),
            UndefinedReason::TooFew { least } => {
                write!(f, "fewer than {}", counted(*least, "sample"))
            }
            UndefinedReason::ConstantTruth { .. } => f.write_str("constant truth"),
            UndefinedReason::BelowGate => f.write_str("no truth reaches the gate"),
            UndefinedReason::OutsideFootprint => f.write_str("no sample on the footprint"),
            UndefinedReason::NoBin { least } => {
                write!(f, "no bin has {}", counted(*least, "sample"))
            }
            UndefinedReason::TooFewBins { have, least } => {
                write!(f, "{}, {least} are needed", counted(*have, "bin"))
            }
            UndefinedReason::NoRepeats => f.write_str("no bin has two samples"),
            UndefinedReason::NoRepeatedPress => f.write_str("no press was repeated"),
            UndefinedReason::TooFewCells { have, least } => {
                let presses = counted(*have, "repeated press");
                write!(f, "{presses}, {least} are needed")
            }
            UndefinedReason::EqualRepeats => f.write_str("repeats do not differ"),
            UndefinedReason::EqualErrors => f.write_str("errors do not differ"),
            UndefinedReason::EqualMeans => {
                f.write_str("means of truth and prediction do not differ")
            }
            UndefinedReason::OneCluster => {
                f.write_str("several samples of one cluster, two clusters are needed")
            }
            UndefinedReason::ShortBranch => f.write_str("no point has two depths on both branches"),
            UndefinedReason::NoOverlap => f.write_str("no common range"),
            UndefinedReason::NoForce => f.write_str("no force was measured"),
            UndefinedReason::NoIdleSamples => f.write_str("every sample is in contact"),
            UndefinedReason::NoLightPresses => {
                f.write_str("no light press: press ten places or more with 0.02 N to 0.2 N")
            }
            UndefinedReason::TooFewPlaces { have, least } => {
                let places = if *have == 1 { "place" } else { "places" };
                write!(
                    f,
                    "light presses count as {have} {places}, {least} are needed"
                )
            }
            UndefinedReason::NoRise => {
                f.write_str("predictions do not rise with the force of light presses")
            }
            UndefinedReason::BeyondLightPresses => {
                f.write_str("the limit exceeds the force of every light press")
            }
            UndefinedReason::AtLightestPress => {
                f.write_str("the limit reaches down to the lightest press: press lighter")
            }
            UndefinedReason::NoContact => f.write_str("no sample in contact has a place"),
            UndefinedReason::OneChannel => f.write_str("one channel, two are needed"),
            UndefinedReason::OneUnit => f.write_str("one unit, two are needed"),
            UndefinedReason::OpenTurn => {
                f.write_str("points on one line do not determine a rotation")
            }
            UndefinedReason::NoTimes => f.write_str("no time stamps"),
            UndefinedReason::EqualTimes => f.write_str("equal time stamps"),
            UndefinedReason::NoStream => {
                f.write_str("single pictures, not a stream: the median interval exceeds 1 s")
            }
            UndefinedReason::NoDigests => f.write_str("no successive digests of frames"),
            UndefinedReason::NotDeclared(fact) => {
                write!(f, "the sensor's `{fact}` is not declared")
            }
            UndefinedReason::NoInterval => f.write_str("no interval is defined"),
            UndefinedReason::Greatest => {
                f.write_str("the interval of a greatest value is unreliable")
            }
            UndefinedReason::AtEnd => {
                f.write_str("the score is at the end of its range in every cluster")
            }
            UndefinedReason::ZeroMean => f.write_str("the mean is zero"),
            UndefinedReason::NoReferenceScene => f.write_str("no sample of the reference scene"),
            UndefinedReason::OneScene => f.write_str("only the reference scene"),
            UndefinedReason::ZeroIntensity => f.write_str("the reference scene is black"),
            UndefinedReason::ZeroBaseline => f.write_str("the reference scene has no error"),
            UndefinedReason::NoChange => f.write_str("light and error did not change"),
            UndefinedReason::NoMillionths => {
                f.write_str("no value is known to a millionth of its unit")
            }
            UndefinedReason::Overflow => f.write_str("beyond the range of binary64"),
            UndefinedReason::TooFewClusters { have } => {
                let least = crate::score::least::LEAST_CLUSTERS;
                write!(f, "{}, {least} are needed", counted(*have, "cluster"))
            }
            UndefinedReason::TooFewReplicates { defined, drawn } => {
                let least = crate::score::least::LEAST_REPLICATES;
                write!(
                    f,
                    "{defined} of {drawn} replicates have a value, 95 % and at least {least} are needed"
                )
            }
            UndefinedReason::NoClusters => f.write_str("samples without point_id"),
            UndefinedReason::HangsOnOneCluster => {
                f.write_str("the score has no value if one cluster is left out")
            }
        }
    }
}

/// Reason why a metric does not apply to a channel or sensor.
///
/// ```
/// use taceva_metrics::InapplicableReason;
/// assert_eq!(InapplicableReason::NotOneNumber.to_string(), "many numbers instead of one");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum InapplicableReason {
    /// No contact threshold is defined for this unit.
    NoGate(Unit),
    /// No tolerances or levels are defined for this unit.
    NoStep(Unit),
    /// The samples do not have this channel.
    ChannelAbsent(&'static str),
    /// The value is a map, a curve or a matrix instead of one number.
    NotOneNumber,
}

impl fmt::Display for InapplicableReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InapplicableReason::NoGate(unit) => write!(f, "no gate is defined for {unit}"),
            InapplicableReason::NoStep(unit) => write!(f, "no step is defined for {unit}"),
            InapplicableReason::ChannelAbsent(name) => {
                write!(f, "channel `{}` is not scored", taceva_core::shown(name))
            }
            InapplicableReason::NotOneNumber => f.write_str("many numbers instead of one"),
        }
    }
}
