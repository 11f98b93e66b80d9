//! Periods of angles in tables.

use std::fmt;
use std::str::FromStr;

use taceva_core::Unit;

/// Period of an angle: a number in the unit of its column, or a multiple of π in radians.
///
/// # Units
/// The unit of the column, degrees or radians.
///
/// ```
/// use taceva_core::Unit;
/// use taceva_evaluate::Period;
/// let turn: Period = "2pi".parse()?;
/// assert_eq!(turn.degrees("yaw", Unit::Radian), Ok(360));
/// assert_eq!(Period::from(180).degrees("tool", Unit::Degree), Ok(180));
/// assert!(turn.degrees("yaw", Unit::Degree).is_err());
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Period {
    number: f64,
    /// True for a multiple of π, such as `2pi`.
    is_of_pi: bool,
}

/// Greatest allowed difference between a period in radians and whole degrees, in degrees. It allows for rounding to three decimals.
const ROUNDED_DEG: f64 = 0.03;

impl Period {
    /// Unit that the name of a column, or a multiple of π, implies; `None` if neither implies a unit.
    pub(super) fn stated_unit(self, name: &str) -> Option<Unit> {
        let by_name = [("_rad", Unit::Radian), ("_deg", Unit::Degree)];
        let by_name = by_name.iter().find(|(end, _)| name.ends_with(end));
        by_name
            .map(|(_, unit)| *unit)
            .or(self.is_of_pi.then_some(Unit::Radian))
    }

    /// Period of the column `name` in `unit`, in whole degrees.
    ///
    /// # Errors
    /// A message with the remedy, if the period does not match the unit, or is not a whole number of degrees.
    pub fn degrees(self, name: &str, unit: Unit) -> Result<u16, String> {
        let of_radians = match self.is_of_pi {
            true => self.number * 180.0,
            false => self.number.to_degrees(),
        };
        let is_whole = (of_radians - of_radians.round()).abs() <= ROUNDED_DEG;
        // A period of 6.283 degrees is not plausible.
        let is_of_radians = is_whole && of_radians <= 360.0 + ROUNDED_DEG;
        let degrees = match (unit, self.is_of_pi) {
            (Unit::Degree, is_of_pi)
                if is_of_pi || (is_of_radians && self.number.fract() != 0.0) =>
            {
                return Err(format!(
                    "a period of {self} is given for `{name}`, whose unit is {unit}: write {name}={} for degrees, or --units {name}=rad",
                    of_radians.round()
                ));
            }
            // The channel itself rejects a period for a length or a force.
            (_, true) | (Unit::Radian, false) => of_radians,
            (_, false) => self.number,
        };
        let rounding = if unit == Unit::Radian {
            ROUNDED_DEG
        } else {
            0.0
        };
        let whole = degrees.round();
        if unit == Unit::Radian && degrees > 360.0 + rounding {
            return Err(format!(
                "a period of {self} is given for `{name}`, which is in radians: write {name}=2pi for a whole turn, or --units {name}=deg if its \
                 numbers are degrees"
            ));
        }
        if (degrees - whole).abs() > rounding || !(0.0..=f64::from(u16::MAX)).contains(&whole) {
            return Err(format!(
                "a period of {self} is given for `{name}` in {unit}: expected a whole number of degrees, such as {name}=360 or {name}=2pi"
            ));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number from 0 to the maximum of u16"
        )]
        Ok(whole as u16)
    }
}

impl From<u16> for Period {
    /// Creates a period of `number`, in the unit of its column.
    fn from(number: u16) -> Period {
        Period {
            number: f64::from(number),
            is_of_pi: false,
        }
    }
}

impl FromStr for Period {
    type Err = String;

    /// Parses `360`, `6.2832`, `2pi` or `pi`.
    fn from_str(text: &str) -> Result<Period, String> {
        let text = text.trim();
        let of_pi = text.strip_suffix("pi").or_else(|| text.strip_suffix('π'));
        let number = match of_pi {
            Some("") => Ok(1.0),
            Some(number) => number.trim_end_matches(['*', ' ']).parse(),
            None => text.parse(),
        };
        match number {
            Ok(number) if f64::is_finite(number) => Ok(Period {
                number,
                is_of_pi: of_pi.is_some(),
            }),
            _ => Err(format!(
                "`{}` is not a period, expected a number such as 360, or 2pi",
                taceva_core::shown(text)
            )),
        }
    }
}

impl fmt::Display for Period {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.is_of_pi, self.number) {
            (false, number) => write!(f, "{number}"),
            (true, number) => write!(f, "{number}pi"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(text: &str, unit: Unit) -> Result<u16, String> {
        text.parse::<Period>()?.degrees("yaw", unit)
    }

    #[test]
    fn a_period_is_a_number_in_the_unit_of_its_column_or_a_multiple_of_pi() {
        for (text, unit, expected) in [
            ("360", Unit::Degree, 360),
            ("2pi", Unit::Radian, 360),
            ("pi", Unit::Radian, 180),
            ("0.5*pi", Unit::Radian, 90),
            ("2π", Unit::Radian, 360),
            ("6.283185307179586", Unit::Radian, 360),
            ("6.2832", Unit::Radian, 360),
            ("6.283", Unit::Radian, 360),
            ("3.1416", Unit::Radian, 180),
            ("2pi", Unit::Millimetre, 360),
        ] {
            assert_eq!(degrees(text, unit), Ok(expected), "{text}");
        }
    }

    #[test]
    fn a_period_that_does_not_fit_the_unit_is_refused_with_the_one_that_does() {
        for (text, unit, remedy) in [
            ("360", Unit::Radian, "write yaw=2pi"),
            ("2pi", Unit::Degree, "write yaw=360"),
            (
                "6.283",
                Unit::Degree,
                "write yaw=360 for degrees, or --units yaw=rad",
            ),
            ("3.1416", Unit::Degree, "write yaw=180 for degrees"),
            ("90.5", Unit::Degree, "a whole number of degrees"),
            ("1", Unit::Radian, "a whole number of degrees"),
            ("-360", Unit::Degree, "a whole number of degrees"),
            ("full", Unit::Degree, "`full` is not a period"),
        ] {
            let problem = degrees(text, unit).expect_err(text);
            assert!(problem.contains(remedy), "{problem}");
        }
        let two = Period::from(2);
        assert_eq!(two.stated_unit("yaw_rad"), Some(Unit::Radian));
        assert_eq!(two.stated_unit("yaw_deg"), Some(Unit::Degree));
        assert_eq!(two.stated_unit("yaw"), None);
        assert_eq!(
            "pi".parse::<Period>().map(|pi| pi.stated_unit("yaw")),
            Ok(Some(Unit::Radian))
        );
    }
}
