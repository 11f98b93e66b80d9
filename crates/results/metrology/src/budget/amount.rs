//! Amounts of a budget file: a number, or a number with its unit.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Visitor};
use taceva_core::Unit;

use super::error::BudgetProblem;

/// Amount as written in the budget file.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Amount {
    Number(f64),
    Text(String),
}

/// Quantity and unit that a key of the budget file expects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Wanted {
    /// A value in this unit.
    In(Unit),
    /// A share of the reading.
    Share,
    /// An angle, converted to radians.
    Angle,
    /// Any quantity: a plain number unchanged, an angle in radians, other units as written.
    Any,
    /// A plain number, a share or an angle in radians, for a measurand in a unit that TacEva cannot convert.
    Plain,
}

impl<'de> Deserialize<'de> for Amount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Amount, D::Error> {
        struct Either;
        impl Visitor<'_> for Either {
            type Value = Amount;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or a string such as \"10 mN\"")
            }
            fn visit_f64<E>(self, value: f64) -> Result<Amount, E> {
                Ok(Amount::Number(value))
            }
            fn visit_i64<E>(self, value: i64) -> Result<Amount, E> {
                Ok(Amount::Number(value as f64))
            }
            fn visit_str<E>(self, value: &str) -> Result<Amount, E> {
                Ok(Amount::Text(value.to_owned()))
            }
        }
        deserializer.deserialize_any(Either)
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Amount::Number(number) => write!(f, "{number}"),
            Amount::Text(text) => f.write_str(text),
        }
    }
}

impl Amount {
    /// Converts the amount to a finite number in the expected unit.
    pub(super) fn resolve(&self, wanted: Wanted) -> Result<f64, BudgetProblem> {
        let wrong = |expected: &str| BudgetProblem::Value {
            found: taceva_core::shown(&self.to_string()).to_string(),
            expected: expected.to_owned(),
        };
        let (number, unit) = match self {
            Amount::Number(number) => (*number, None),
            Amount::Text(text) => {
                let amount = text.parse::<taceva_core::Amount>();
                let amount = amount.map_err(|expected| wrong(&expected.to_string()))?;
                (amount.value, Some(amount.unit))
            }
        };
        if !f64::is_finite(number) {
            return Err(wrong("a finite number"));
        }
        match (wanted, unit) {
            (Wanted::Any | Wanted::Plain | Wanted::Share, None) => Ok(number),
            (Wanted::Any | Wanted::Plain | Wanted::Angle, Some(Unit::Degree)) => {
                Ok(number.to_radians())
            }
            (Wanted::Any, Some(_)) | (Wanted::In(Unit::One), None) => Ok(number),
            (Wanted::In(kept), Some(unit)) if unit == kept => Ok(number),
            (Wanted::Share | Wanted::Plain, Some(Unit::One)) => Ok(number),
            (Wanted::In(kept), _) => Err(wrong(&format!(
                "an amount in {kept} or a unit of the same quantity"
            ))),
            (Wanted::Plain, _) => Err(wrong(
                "a number in the unit of the expression, because only units such as mm, N or deg are converted",
            )),
            (Wanted::Share, _) => Err(wrong("a share of the reading, such as \"1 %\"")),
            (Wanted::Angle, _) => Err(wrong("an angle, such as \"1 deg\"")),
        }
    }
}
