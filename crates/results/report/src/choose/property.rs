//! Properties of a sensor to which needs refer.

use std::fmt;

use taceva_metrics::{Better, Standing};

use crate::catalogue::{RESULT, Sensor};
use crate::number::FormattedValue;

/// Property of a sensor to which needs refer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// Mean absolute error of a channel or plane, in mm or N.
    Error(&'static str),
    /// Repeatability of a channel or plane, in mm or N.
    Repeatability(&'static str),
    /// Spatial robustness of a channel or plane, in mm or N.
    Spatial(&'static str),
    /// Share of line or dot gratings for which the error of the predicted spacing is at most 0.05 mm.
    Resolution(&'static str),
    /// Mean degradation of the error of a channel over the faults of a list, as a ratio.
    Degradation(&'static str),
    /// Severity at which the skill of a channel ends, 1 to 6; mean over the faults of a list.
    SkillEnd(&'static str),
    /// Indentation per normal force, in mm/N.
    Sensitivity,
    /// Uniformity of the sensitivity over the surface, as a ratio.
    Uniformity,
    /// Frame rate, in Hz.
    FrameRate,
    /// Sensing area, in mm².
    FieldOfView,
    /// Thickness of the whole sensor, in mm.
    Thickness,
    /// Thickness of the gel, in mm.
    GelThickness,
    /// Greatest outer dimension, in mm.
    Size,
    /// Median of the three outer dimensions, in mm; a diameter counts as two dimensions.
    Width,
    /// Lowest exact price of a ready sensor in a currency: `USD`.
    Price(&'static str),
    /// Availability from a seller: 1 if a seller is known, otherwise unknown.
    Bought,
    /// Greatest indentation, in mm.
    GreatestDepth,
    /// Greatest normal force, in N.
    GreatestForce,
    /// Opacity of the sensor to ambient light: 1 for opaque, 0 for transparent.
    Opaque,
}

impl Property {
    /// Value of this property for `sensor`; `None` if unknown.
    pub fn of(self, sensor: &Sensor) -> Option<f64> {
        let result = || {
            let (metric, channel) = self.score()?;
            let result = sensor.result(metric, channel);
            let defined = result.filter(|result| result.is_defined());
            defined.map(|result| result.value)
        };
        let (size, limits) = (sensor.size.as_ref(), sensor.limits.as_ref());
        match self {
            Property::Error(_)
            | Property::Repeatability(_)
            | Property::Spatial(_)
            | Property::Resolution(_)
            | Property::Sensitivity
            | Property::Uniformity
            | Property::FrameRate
            | Property::FieldOfView
            | Property::Thickness
            | Property::GelThickness => result(),
            Property::Degradation(channel) => {
                let (value, _) = sensor.faults.as_ref()?.degradation(channel)?;
                Some(value)
            }
            Property::SkillEnd(channel) => sensor.faults.as_ref()?.skill_end(channel),
            Property::Size => size?.greatest_mm(),
            Property::Width => size?.middle_mm(),
            Property::Price(currency) => Some(sensor.price_in(currency)?.amount),
            Property::Bought => sensor.is_sold().then_some(1.0),
            Property::GreatestDepth => Some(limits?.pz_max_mm),
            Property::GreatestForce => Some(limits?.fz_max_n),
            Property::Opaque => sensor.opaque.map(|opaque| if opaque { 1.0 } else { 0.0 }),
        }
    }

    /// True for greatest depths and forces. Values are the greatest tested values, which may be below the limit of the gel.
    pub(super) fn is_reached(self) -> bool {
        matches!(self, Property::GreatestDepth | Property::GreatestForce)
    }

    /// True for errors in a plane. The value is the mean of both axes, not a distance.
    pub(super) fn is_of_both_axes(self) -> bool {
        matches!(self, Property::Error("Pxy" | "Fxy"))
    }

    /// Currency of a price; `None` for other properties.
    pub(super) fn currency(self) -> Option<&'static str> {
        match self {
            Property::Price(currency) => Some(currency),
            _ => None,
        }
    }

    /// Metric and channel of the score that the property uses; `None` for properties other than scores.
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
            Property::Thickness => Some(("intrinsic", "thickness")),
            Property::GelThickness => Some(("gel_thickness", "gel")),
            Property::Degradation(_)
            | Property::SkillEnd(_)
            | Property::Size
            | Property::Width
            | Property::Price(_)
            | Property::Bought
            | Property::GreatestDepth
            | Property::GreatestForce
            | Property::Opaque => None,
        }
    }

    /// 95 % interval of the value for `sensor`, if any.
    pub fn interval(self, sensor: &Sensor) -> Option<[f64; 2]> {
        if let Property::Degradation(channel) = self {
            let (_, interval) = sensor.faults.as_ref()?.degradation(channel)?;
            return interval;
        }
        let (metric, channel) = self.score()?;
        sensor.result(metric, channel)?.interval
    }

    /// Standing of the value for `sensor` in verdicts. Properties other than scores always count.
    pub fn standing(self, sensor: &Sensor) -> Standing {
        if let Property::Degradation(channel) | Property::SkillEnd(channel) = self {
            let faults = sensor.faults.as_ref();
            return faults.map_or(Standing::Counts, |faults| faults.standing(channel));
        }
        let score = self.score();
        let result = score.and_then(|(metric, channel)| sensor.result(metric, channel));
        result.map_or(Standing::Counts, |result| result.standing)
    }

    /// Context of the value: the measured part of a size, the goods of a price, the greatest tested depth and force of a published error, or the
    /// variant of a result. `None` for other properties.
    pub(super) fn part(self, sensor: &Sensor) -> Option<String> {
        match self {
            Property::Repeatability(_) | Property::Spatial(_) | Property::Uniformity => {
                let (metric, channel) = self.score()?;
                let result = sensor.result(metric, channel)?;
                result.note.clone().filter(|_| result.source == RESULT)
            }
            Property::Error(channel) => {
                let limits = sensor.limits.as_ref()?;
                let error = sensor.result("mae", channel)?;
                let [depth, force] = [limits.pz_max_mm, limits.fz_max_n];
                (error.source == limits.source).then(|| format!("{depth} mm, {force} N"))
            }
            Property::Size | Property::Width => {
                let size = sensor.size.as_ref()?;
                Some(format!("{} mm, {}", size.shown(), size.conditions))
            }
            Property::Price(currency) => Some(sensor.price_in(currency)?.conditions()),
            _ => None,
        }
    }

    /// Better direction of the property.
    pub fn better(self) -> Better {
        match self {
            Property::Error(_)
            | Property::Repeatability(_)
            | Property::Spatial(_)
            | Property::Degradation(_)
            | Property::Thickness
            | Property::GelThickness
            | Property::Size
            | Property::Width
            | Property::Price(_) => Better::Lower,
            Property::Resolution(_)
            | Property::SkillEnd(_)
            | Property::Sensitivity
            | Property::Uniformity
            | Property::FrameRate
            | Property::FieldOfView
            | Property::GreatestDepth
            | Property::GreatestForce
            | Property::Bought
            | Property::Opaque => Better::Higher,
        }
    }

    /// Unit of the property; empty for a share.
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
            Property::Thickness
            | Property::GelThickness
            | Property::Size
            | Property::Width
            | Property::GreatestDepth => "mm",
            Property::GreatestForce => "N",
            Property::Price(currency) => currency,
            Property::Resolution(_)
            | Property::Degradation(_)
            | Property::SkillEnd(_)
            | Property::Uniformity
            | Property::Bought
            | Property::Opaque => "",
        }
    }

    /// `value` with its unit, to four digits.
    pub fn shown(self, value: f64) -> String {
        let value_shown = FormattedValue::number(value, None).value;
        // Published numbers have few digits and are displayed as printed.
        let short = value.to_string();
        let digits = if short.len() <= value_shown.len() {
            short
        } else {
            value_shown
        };
        match (self, self.unit()) {
            (Property::Opaque | Property::Bought, _) if value > 0.0 => "yes".to_owned(),
            (Property::Opaque | Property::Bought, _) => "no".to_owned(),
            (_, "") => digits,
            (_, unit) => format!("{digits} {unit}"),
        }
    }

    /// Ratio of `value` to the best of `sensors`, 0 to 1; inverted if lower is better. `None` if greater is better and no value is above 0.
    pub(super) fn share(self, value: f64, sensors: &[&Sensor]) -> Option<f64> {
        let known = sensors.iter().filter_map(|sensor| self.of(sensor));
        if self.better() == Better::Lower {
            let best = known.fold(f64::INFINITY, f64::min);
            // An error of 0 is the best possible.
            return Some(if value > 0.0 { best / value } else { 1.0 });
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
            Property::Degradation(channel) => write!(f, "mean degradation of {channel} by faults"),
            Property::SkillEnd(channel) => {
                write!(f, "mean severity at which the skill of {channel} ends")
            }
            Property::Sensitivity => f.write_str("sensitivity"),
            Property::Uniformity => f.write_str("uniformity"),
            Property::FrameRate => f.write_str("frame rate"),
            Property::FieldOfView => f.write_str("field of view"),
            Property::Thickness => f.write_str("thickness of the sensor"),
            Property::GelThickness => f.write_str("thickness of the gel"),
            Property::Size => f.write_str("greatest dimension"),
            Property::Width => f.write_str("middle dimension"),
            Property::Price(currency) => write!(f, "price in {currency}"),
            Property::Bought => f.write_str("can be bought"),
            Property::GreatestDepth => f.write_str("greatest depth"),
            Property::GreatestForce => f.write_str("greatest normal force"),
            Property::Opaque => f.write_str("light kept out"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_people_read() {
        let shown = |value: f64| Property::Error("Fz").shown(value);
        assert_eq!(shown(0.031_415_926_535_897_9), "0.03142 N");
        assert_eq!(shown(25.0), "25 N");
        assert_eq!(shown(0.0361), "0.0361 N");
    }

    #[test]
    fn an_error_of_zero_is_the_best_and_not_an_unknown_one() {
        let all = crate::catalogue::all();
        let all: Vec<&Sensor> = all.iter().collect();
        let share = |value: f64| Property::Spatial("Pz").share(value, &all);
        assert_eq!(share(0.0), Some(1.0));
        assert!(share(0.5).is_some_and(|share| 0.0 < share && share < 1.0));
    }
}
