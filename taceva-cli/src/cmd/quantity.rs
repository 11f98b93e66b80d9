//! Value of an option that is a number with a unit.

use taceva_core::{Channel, SourceUnit, Unit, shown};

use super::Usage;

/// Number in the unit of a channel.
pub(super) struct Quantity {
    pub(super) value: f64,
    pub(super) unit: Unit,
    /// True if the unit was converted, so that the value differs from the written number, such as for 100mN.
    pub(super) is_converted: bool,
    /// The number with its unit as the user wrote them.
    pub(super) written: String,
}

impl Quantity {
    /// Parses `0.1N` or `100 mN`, the value of `option`.
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
        let value = unit.convert(number);
        Ok(Quantity {
            value,
            unit: unit.unit(),
            is_converted: value.to_bits() != number.to_bits(),
            written: written.to_owned(),
        })
    }
}

/// Unit of the channel `name` if it is one of the six contact channels; `None` for other names.
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
        let is_converted =
            |written: &str| Some(Quantity::read("--invert", written).ok()?.is_converted);
        assert_eq!(
            ["0.1N", "100mN"].map(is_converted),
            [Some(false), Some(true)]
        );
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
