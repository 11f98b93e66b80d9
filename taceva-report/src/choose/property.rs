//! What needs ask of a sensor.

use std::fmt;

use crate::catalogue::Sensor;

/// A number of a sensor that needs ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// The mean absolute error of a channel or plane, in mm or N.
    Error(&'static str),
    /// The repeatability of a channel or plane, in mm or N.
    Repeatability(&'static str),
    /// The spatial robustness of a channel or plane, in mm or N.
    Spatial(&'static str),
    /// The share of gratings that are told within 0.05 mm: of lines or dots.
    Resolution(&'static str),
    /// Indentation over normal force, in mm/N.
    Sensitivity,
    /// Evenness of the sensitivity over the surface.
    Uniformity,
    /// Pictures a second, in Hz.
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
        let result = |metric, channel| sensor.result(metric, channel).map(|result| result.value);
        let (intrinsic, limits) = (sensor.intrinsic.as_ref(), sensor.limits.as_ref());
        match self {
            Property::Error(channel) => result("mae", channel),
            Property::Repeatability(channel) => result("repeatability", channel),
            Property::Spatial(channel) => result("r_spatial", channel),
            Property::Resolution(kind) => result("sr", kind),
            Property::Sensitivity => result("sensitivity", "Fz"),
            Property::Uniformity => result("uniformity", "Fz"),
            Property::FrameRate => intrinsic
                .map(|intrinsic| intrinsic.frame_rate_hz)
                .or_else(|| result("intrinsic", "frame_rate")),
            Property::FieldOfView => intrinsic
                .map(|intrinsic| intrinsic.field_of_view_mm2)
                .or_else(|| result("intrinsic", "field_of_view")),
            Property::Thickness => Some(intrinsic?.thickness_mm),
            Property::GreatestDepth => Some(limits?.pz_max_mm),
            Property::GreatestForce => Some(limits?.fz_max_n),
            Property::Opaque => sensor.opaque.map(|opaque| if opaque { 1.0 } else { 0.0 }),
        }
    }

    /// Whether small numbers are good.
    pub fn is_better_low(self) -> bool {
        matches!(
            self,
            Property::Error(_)
                | Property::Repeatability(_)
                | Property::Spatial(_)
                | Property::Thickness
        )
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

    /// `value` with its unit.
    pub fn shown(self, value: f64) -> String {
        match (self, self.unit()) {
            (Property::Opaque, _) if value > 0.0 => "yes".to_owned(),
            (Property::Opaque, _) => "no".to_owned(),
            (_, "") => value.to_string(),
            (_, unit) => format!("{value} {unit}"),
        }
    }

    /// The share that `value` has of the best of `sensors`.
    pub(super) fn share(self, value: f64, sensors: &[&Sensor]) -> Option<f64> {
        let known = sensors.iter().filter_map(|sensor| self.of(sensor));
        if self.is_better_low() {
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
            Property::Resolution(kind) => write!(f, "share of {kind} gratings told within 0.05 mm"),
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
