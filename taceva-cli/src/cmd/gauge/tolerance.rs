//! Width of a tolerance with its unit.

use taceva_core::{SourceUnit, Unit, shown};

use crate::cmd::Usage;

/// Width of a tolerance in the unit of the channels.
pub(super) struct Tolerance {
    pub(super) width: f64,
    pub(super) unit: Unit,
    /// The width as the user wrote it.
    pub(super) written: String,
}

impl Tolerance {
    /// Reads `0.1N` or `100 mN`.
    pub(super) fn read(written: &str) -> anyhow::Result<Tolerance> {
        let refused =
            |problem: &str| Usage::error(format!("--tolerance `{}`: {problem}", shown(written)));
        let is_of_number = |letter: char| letter.is_ascii_digit() || "+-.".contains(letter);
        let end = written.find(|letter: char| !is_of_number(letter));
        let (number, symbol) = written.split_at(end.unwrap_or(written.len()));
        let number = number.parse::<f64>().ok();
        let Some(number) = number.filter(|number| *number > 0.0 && number.is_finite()) else {
            return Err(refused(
                "expected a width above 0 with its unit, such as 0.1N",
            ));
        };
        let symbol = symbol.trim();
        if symbol.is_empty() {
            return Err(refused("expected a unit after the number, such as 0.1N"));
        }
        let unit = SourceUnit::parse(symbol).map_err(|error| refused(&error.to_string()))?;
        Ok(Tolerance {
            width: unit.convert(number),
            unit: unit.unit(),
            written: written.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_width_is_converted_to_the_unit_of_its_channel() {
        let read = |written: &str| {
            let tolerance = Tolerance::read(written).ok()?;
            Some((tolerance.width.to_bits(), tolerance.unit))
        };
        assert_eq!(read("0.1N"), Some((0.1_f64.to_bits(), Unit::Newton)));
        assert_eq!(read("100 mN"), Some((0.1_f64.to_bits(), Unit::Newton)));
        assert_eq!(read("0.5mm"), Some((0.5_f64.to_bits(), Unit::Millimetre)));
        for wrong in ["0.1", "N", "", "-1N", "0N", "1 furlong", "1e400N", "nanN"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
