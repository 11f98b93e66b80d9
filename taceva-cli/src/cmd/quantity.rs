//! A number with its unit, as an option states it.

use taceva_core::{Channel, SourceUnit, Unit, shown};

use super::Usage;

/// A number in the unit of a channel.
pub(super) struct Quantity {
    pub(super) value: f64,
    pub(super) unit: Unit,
    /// True if it was written in another unit, such as mN.
    is_converted: bool,
    /// The number with its unit as the user wrote them.
    pub(super) written: String,
}

impl Quantity {
    /// Reads `0.1N` or `100 mN`, the value of `option`.
    pub(super) fn read(option: &str, written: &str) -> anyhow::Result<Quantity> {
        let refused =
            |problem: &str| Usage::error(format!("{option} `{}`: {problem}", shown(written)));
        let is_of_number = |letter: char| letter.is_ascii_digit() || "+-.".contains(letter);
        let end = written.find(|letter: char| !is_of_number(letter));
        let (number, symbol) = written.split_at(end.unwrap_or(written.len()));
        let number = number.parse::<f64>().ok();
        let Some(number) = number.filter(|number| number.is_finite()) else {
            return Err(refused("expected a number with its unit, such as 0.1N"));
        };
        let symbol = symbol.trim();
        if symbol.is_empty() {
            return Err(refused("expected a unit after the number, such as 0.1N"));
        }
        let unit = SourceUnit::parse(symbol).map_err(|error| refused(&error.to_string()))?;
        Ok(Quantity {
            value: unit.convert(number),
            unit: unit.unit(),
            is_converted: (unit.convert(1.0) - 1.0).abs() > 0.0,
            written: written.to_owned(),
        })
    }

    /// Refuses a converted number beside a column of an unknown unit, which nothing converts.
    pub(super) fn beside(&self, option: &str, column: &str) -> anyhow::Result<()> {
        if !self.is_converted {
            return Ok(());
        }
        Err(Usage::error(format!(
            "{option} {}: the unit of column {} is not known and counts as {}; convert the column, and state the number in {}",
            shown(&self.written),
            shown(column),
            self.unit.symbol(),
            self.unit.symbol()
        )))
    }
}

/// Unit of one of the six channels.
pub(super) fn unit_of_six(name: &str) -> Option<Unit> {
    let mut six = Channel::SIX.into_iter();
    let channel = six.find(|channel| channel.name() == name);
    channel.map(|channel| channel.unit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_converted_to_the_unit_of_its_channel() {
        let read = |written: &str| {
            let quantity = Quantity::read("--tolerance", written).ok()?;
            Some((quantity.value.to_bits(), quantity.unit))
        };
        assert_eq!(read("0.1N"), Some((0.1_f64.to_bits(), Unit::Newton)));
        assert_eq!(read("100 mN"), Some((0.1_f64.to_bits(), Unit::Newton)));
        assert_eq!(
            read("-0.5mm"),
            Some(((-0.5_f64).to_bits(), Unit::Millimetre))
        );
        for wrong in ["0.1", "N", "", "1 furlong", "1e400N", "nanN"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
