//! Amounts in text: a number with its unit.

use std::fmt;
use std::str::FromStr;

use super::{SourceUnit, Unit, UnitError};

/// A number in the unit in which TacEva stores its quantity, parsed from text such as `2.0 mN` or `1 %`. A plain value, which gets no further field.
///
/// ```
/// use taceva_core::{Amount, Unit};
/// let amount: Amount = "2.0 mN".parse()?;
/// assert_eq!((amount.value, amount.unit), (0.002, Unit::Newton));
/// assert_eq!(amount.to_string(), "0.002 N");
/// # Ok::<(), taceva_core::AmountError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    /// Finite number in `unit`.
    pub value: f64,
    /// Unit in which TacEva stores the quantity.
    pub unit: Unit,
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.value, self.unit)
    }
}

impl FromStr for Amount {
    type Err = AmountError;

    fn from_str(text: &str) -> Result<Amount, AmountError> {
        let text = text.trim();
        let percent = || text.strip_suffix('%').map(|number| (number, "%"));
        let parted = text.split_once(char::is_whitespace).or_else(percent);
        let (number, symbol) = parted.ok_or(AmountError::Form)?;
        let unit = SourceUnit::parse(symbol.trim()).map_err(AmountError::Unit)?;
        let number = number
            .trim()
            .parse::<f64>()
            .map_err(|_| AmountError::Number)?;
        let value = unit.convert(number);
        match value.is_finite() {
            true => Ok(Amount {
                value,
                unit: unit.unit(),
            }),
            false => Err(AmountError::NotFinite),
        }
    }
}

/// Reason why a text is not an amount.
///
/// ```
/// use taceva_core::Amount;
/// let error = "2.0mN".parse::<Amount>().unwrap_err();
/// assert_eq!(error.to_string(), "a number, a blank and a unit, such as \"10 mN\"");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AmountError {
    /// The text has no blank before its unit. Only `%` needs none.
    Form,
    /// The unit is unknown.
    Unit(UnitError),
    /// The part before the unit is not a number.
    Number,
    /// The number is infinite or NaN.
    NotFinite,
}

impl fmt::Display for AmountError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AmountError::Form => f.write_str("a number, a blank and a unit, such as \"10 mN\""),
            AmountError::Unit(error) => write!(f, "a known unit: {error}"),
            AmountError::Number => f.write_str("a number before the unit"),
            AmountError::NotFinite => f.write_str("a finite number"),
        }
    }
}

impl std::error::Error for AmountError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_amount_is_converted_to_the_stored_unit_and_reads_back_as_written() {
        for (text, value, unit) in [
            ("2.0 mN", 0.002, Unit::Newton),
            (" 12  um ", 0.012, Unit::Millimetre),
            ("1 %", 0.01, Unit::One),
            ("1%", 0.01, Unit::One),
            ("5 Nm", 5_000.0, Unit::NewtonMillimetre),
        ] {
            let amount: Amount = text.parse().expect("an amount");
            assert_eq!(amount, Amount { value, unit }, "{text}");
            assert_eq!(amount.to_string().parse(), Ok(amount), "{text}");
        }
    }

    #[test]
    fn a_text_that_is_no_finite_amount_of_a_known_unit_is_refused() {
        let error = |text: &str| text.parse::<Amount>().expect_err(text);
        assert_eq!(error("2.0"), AmountError::Form);
        assert_eq!(error("two mN"), AmountError::Number);
        assert_eq!(error("inf mN"), AmountError::NotFinite);
        assert_eq!(error("NaN mN"), AmountError::NotFinite);
        assert_eq!(error("1e308 kN"), AmountError::NotFinite);
        assert!(matches!(error("2 furlong"), AmountError::Unit(_)));
    }
}
