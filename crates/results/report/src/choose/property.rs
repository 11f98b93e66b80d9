//! What needs ask of a sensor.

use std::fmt;

use taceva_metrics::{Better, Standing};

use crate::catalogue::Sensor;
use crate::number::FormattedValue;

/// A number of a sensor that needs ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// The mean absolute error of a channel or plane, in mm or N.
    Error(&'static str),
    /// The repeatability of a channel or plane, in mm or N.
    Repeatability(&'static str),
    /// The spatial robustness of a channel or plane, in mm or N.
    Spatial(&'static str),
    /// The share of gratings whose spacing is predicted to within 0.05 mm: of lines or dots.
    Resolution(&'static str),
    /// Indentation over normal force, in mm/N.
    Sensitivity,
    /// Evenness of the sensitivity over the surface.
    Uniformity,
    /// Frames a second, in Hz.
    FrameRate,
    /// The area that is sensed, in mm².
    FieldOfView,
    /// Thickness of the sensor, in mm.
    Thickness,
    /// The greatest indentation, in mm.
    GreatestDepth,
    /// The greatest normal force, in N.
    GreatestForce,
    /// Whether light from outside is kept out: 1 or 0.
    Opaque,
}

impl Property {
    /// The number of `sensor`, if it is known.
    pub fn of(self, sensor: &Sensor) -> Option<f64> {
        let result = || {
            let (metric, channel) = self.score()?;
            sensor.result(metric, channel).map(|result| result.value)
        };
        let (intrinsic, limits) = (sensor.intrinsic.as_ref(), sensor.limits.as_ref());
        match self {
            Property::Error(_)
            | Property::Repeatability(_)
            | Property::Spatial(_)
            | Property::Resolution(_)
            | Property::Sensitivity
            | Property::Uniformity => result(),
            Property::FrameRate => sensor.frame_rate_hz(),
            Property::FieldOfView => sensor.field_of_view_mm2(),
            Property::Thickness => Some(intrinsic?.thickness_mm),
            Property::GreatestDepth => Some(limits?.pz_max_mm),
            Property::GreatestForce => Some(limits?.fz_max_n),
            Property::Opaque => sensor.opaque.map(|opaque| if opaque { 1.0 } else { 0.0 }),
        }
    }

    /// True of greatest depths and forces: the greatest that a source tried, which need not be the limit of the gel.
    pub(super) fn is_reached(self) -> bool {
        matches!(self, Property::GreatestDepth | Property::GreatestForce)
    }

    /// The metric and channel of the score that it is, where it is one.
    pub(super) fn score(self) -> Option<(&'static str, &'static str)> {
        match self {
            Property::Error(channel) => Some(("mae", channel)),
            Property::Repeatability(channel) => Some(("repeatability", channel)),
            Property::Spatial(channel) => Some(("r_spatial", channel)),
            Property::Resolution(kind) => Some(("sr", kind)),
            Property::Sensitivity => Some(("sensitivity", "Fz")),
            Property::Uniformity => Some(("uniformity", "Fz")),
            Property::FrameRate => Some(("intrinsic", "frame_rate")),
            Property::FieldOfView => Some(("intrinsic", "field_of_view")),
            Property::Thickness
            | Property::GreatestDepth
            | Property::GreatestForce
            | Property::Opaque => None,
        }
    }

    /// The interval of 95 % of the number of `sensor`, if there is one.
    pub fn interval(self, sensor: &Sensor) -> Option<[f64; 2]> {
        let (metric, channel) = self.score()?;
        sensor.result(metric, channel)?.interval
    }

    /// Whether the number of `sensor` takes part in verdicts, and if not, why; what is no score takes part.
    pub fn standing(self, sensor: &Sensor) -> Standing {
        let score = self.score();
        let result = score.and_then(|(metric, channel)| sensor.result(metric, channel));
        result.map_or(Standing::Counts, |result| result.standing)
    }

    /// Whether lower or higher numbers are better.
    pub fn better(self) -> Better {
        match self {
            Property::Error(_)
            | Property::Repeatability(_)
            | Property::Spatial(_)
            | Property::Thickness => Better::Lower,
            Property::Resolution(_)
            | Property::Sensitivity
            | Property::Uniformity
            | Property::FrameRate
            | Property::FieldOfView
            | Property::GreatestDepth
            | Property::GreatestForce
            | Property::Opaque => Better::Higher,
        }
    }

    /// The unit of the number; empty for a share.
    pub fn unit(self) -> &'static str {
        match self {
            Property::Error(channel)
            | Property::Repeatability(channel)
            | Property::Spatial(channel) => {
                if channel.starts_with('F') {
                    "N"
                } else {
                    "mm"
                }
            }
            Property::Sensitivity => "mm/N",
            Property::FrameRate => "Hz",
            Property::FieldOfView => "mm²",
            Property::Thickness | Property::GreatestDepth => "mm",
            Property::GreatestForce => "N",
            Property::Resolution(_) | Property::Uniformity | Property::Opaque => "",
        }
    }

    /// `value` with its unit, to four digits.
    pub fn shown(self, value: f64) -> String {
        let value_shown = FormattedValue::number(value, None).value;
        // Published numbers have few digits, and keep them as they were printed.
        let short = value.to_string();
        let digits = if short.len() <= value_shown.len() {
            short
        } else {
            value_shown
        };
        match (self, self.unit()) {
            (Property::Opaque, _) if value > 0.0 => "yes".to_owned(),
            (Property::Opaque, _) => "no".to_owned(),
            (_, "") => digits,
            (_, unit) => format!("{digits} {unit}"),
        }
    }

    /// The share that `value` has of the best of `sensors`.
    pub(super) fn share(self, value: f64, sensors: &[&Sensor]) -> Option<f64> {
        let known = sensors.iter().filter_map(|sensor| self.of(sensor));
        if self.better() == Better::Lower {
            let best = known.fold(f64::INFINITY, f64::min);
            return (value > 0.0).then(|| best / value);
        }
        let best = known.fold(0.0, f64::max);
        (best > 0.0).then(|| value / best)
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Property::Error(channel) => write!(f, "MAE of {channel}"),
            Property::Repeatability(channel) => write!(f, "repeatability of {channel}"),
            Property::Spatial(channel) => write!(f, "spatial robustness of {channel}"),
            Property::Resolution(kind) => {
                write!(f, "share of {kind} gratings predicted to within 0.05 mm")
            }
            Property::Sensitivity => f.write_str("sensitivity"),
            Property::Uniformity => f.write_str("uniformity"),
            Property::FrameRate => f.write_str("frame rate"),
            Property::FieldOfView => f.write_str("field of view"),
            Property::Thickness => f.write_str("thickness"),
            Property::GreatestDepth => f.write_str("greatest depth"),
            Property::GreatestForce => f.write_str("greatest normal force"),
            Property::Opaque => f.write_str("light kept out"),
        }
    }
}
