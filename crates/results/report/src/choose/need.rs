//! Needs of a task, parsed from words and bounds.

use std::fmt;
use taceva_core::shown;

use super::need_error::NeedError;
use super::property::Property;
use super::words::{CURRENCIES, OTHER_UNITS, QUANTITIES, Quantity, WORDS};

/// Need of a task: bounds that exclude sensors, and properties that rank sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct Need {
    /// Need as the user wrote it.
    pub words: String,
    /// Bounds. A sensor that does not meet one of the bounds is excluded.
    pub bounds: Vec<Bound>,
    /// Properties that rank the remaining sensors.
    pub ranks: Vec<Property>,
}

/// Lower or upper bound of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Bounded property.
    pub property: Property,
    /// True for a lower bound, false for an upper bound.
    pub is_least: bool,
    /// Bound, in the unit of the property.
    pub value: f64,
}

impl Need {
    /// Parses needs separated by commas: words such as `accurate shear`, bounds such as `rate >= 50 Hz` or `force <= 1 N`, and error limits such as
    /// `localisation 0.3 mm`.
    ///
    /// # Errors
    /// [`NeedError`] with every invalid need and the known needs.
    pub fn parse(text: &str) -> Result<Vec<Need>, NeedError> {
        let words = text.split(',').map(str::trim);
        let (mut needs, mut errors) = (Vec::new(), Vec::new());
        for word in words.filter(|word| !word.is_empty()) {
            match one(word) {
                Ok(need) => needs.push(need),
                Err(error) => errors.push(error),
            }
        }
        match (errors.len(), needs.is_empty()) {
            (0, true) => Err(NeedError::Empty),
            (0, false) => Ok(needs),
            (1, _) => Err(errors.remove(0)),
            _ => Err(NeedError::Several(errors)),
        }
    }

    /// Parses needs from a file: `needs = ["shear", "rate >= 50 Hz"]`.
    ///
    /// # Errors
    /// [`NeedError`] with the line or the invalid need.
    pub fn read(text: &str) -> Result<Vec<Need>, NeedError> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Written {
            needs: Vec<String>,
        }
        let written: Written = toml::from_str(text)?;
        Need::parse(&written.needs.join(","))
    }

    /// All accepted needs, one on each line: words with the properties by which they rank or exclude, then quantities with their units.
    ///
    /// ```
    /// assert!(taceva_report::Need::vocabulary().contains("force >= <number> N"));
    /// ```
    pub fn vocabulary() -> String {
        let words = WORDS.iter().map(|word| {
            let bounds = word.bounds.iter().map(|(property, is_least, value)| {
                let (property, is_least, value) = (*property, *is_least, *value);
                format!(
                    "excludes unless {}",
                    Bound {
                        property,
                        is_least,
                        value
                    }
                )
            });
            let ranks = word
                .ranks
                .iter()
                .map(|property| format!("ranks by {property}"));
            let meaning: Vec<String> = bounds.chain(ranks).collect();
            format!("  {:<29} {}", word.names.join(" | "), meaning.join(", "))
        });
        let quantities = QUANTITIES.iter().map(|quantity| {
            let need = quantity.written("<number>");
            format!("  {need:<29} bounds {}", quantity.property)
        });
        words.chain(quantities).collect::<Vec<_>>().join("\n")
    }

    /// Properties that the need uses.
    pub fn properties(&self) -> impl Iterator<Item = Property> {
        let bounds = self.bounds.iter().map(|bound| bound.property);
        bounds.chain(self.ranks.iter().copied())
    }
}

/// Words for a price.
const PRICES: [&str; 4] = ["affordable", "cheap", "cost", "inexpensive"];

/// Words for robustness to faults.
const FAULTS: [&str; 5] = ["dirt", "durable", "dust", "robust", "scratch"];

fn one(words: &str) -> Result<Need, NeedError> {
    let lower = words.to_lowercase();
    if let Some(word) = WORDS
        .iter()
        .find(|word| word.names.contains(&lower.as_str()))
    {
        let bounds = word.bounds.iter().map(|(property, is_least, value)| Bound {
            property: *property,
            is_least: *is_least,
            value: *value,
        });
        return Ok(Need {
            words: words.to_owned(),
            bounds: bounds.collect(),
            ranks: word.ranks.to_vec(),
        });
    }
    if PRICES.iter().any(|price| lower.starts_with(price)) {
        return Err(NeedError::Price(shown(words).to_string()));
    }
    if FAULTS.iter().any(|fault| lower.contains(fault)) {
        return Err(NeedError::Fault(shown(words).to_string()));
    }
    // Longest name first, because `depth error` contains `depth`.
    let named = QUANTITIES
        .iter()
        .filter(|quantity| lower.starts_with(quantity.name));
    let quantity = named.max_by_key(|quantity| quantity.name.len());
    let quantity = quantity.ok_or_else(|| NeedError::Unknown(shown(words).to_string()))?;
    let bound = bound(quantity, words, &words[quantity.name.len()..])?;
    Ok(Need {
        words: words.to_owned(),
        bounds: vec![bound],
        ranks: Vec::new(),
    })
}

/// Parses `<= 1 N`, `>= 50 Hz`, or a bare number. A bare number is the worst accepted value.
fn bound(quantity: &Quantity, words: &str, rest: &str) -> Result<Bound, NeedError> {
    let refuse = || NeedError::Number {
        words: shown(words).to_string(),
        units: quantity.units(),
        example: match rest.contains(" at ") {
            // A load is a need of its own.
            true => format!("{}, force >= 5 N", quantity.example()),
            false => quantity.example(),
        },
    };
    let rest = rest.trim();
    for sign in ["<", ">"] {
        let strict = rest
            .strip_prefix(sign)
            .filter(|rest| !rest.starts_with('='));
        if let Some(number) = strict {
            return Err(NeedError::Strict {
                words: shown(words).to_string(),
                instead: shown(&format!("{} {sign}= {}", quantity.name, number.trim())).to_string(),
            });
        }
    }
    let sides = [("<=", false), ("≤", false), (">=", true), ("≥", true)];
    let side = sides
        .iter()
        .find_map(|(sign, is_least)| Some((rest.strip_prefix(sign)?, *is_least)));
    let (rest, is_least) = side.unwrap_or((rest, quantity.is_least()));
    let rest = rest.trim();
    let end = rest.find(|letter: char| !(letter.is_ascii_digit() || letter == '.'));
    let (number, unit) = rest.split_at(end.unwrap_or(rest.len()));
    let number: f64 = number.parse().map_err(|_| refuse())?;
    let (property, value) = measured(quantity, number, unit.trim()).ok_or_else(refuse)?;
    if !(value.is_finite() && value > 0.0) {
        return Err(refuse());
    }
    Ok(Bound {
        property,
        is_least: is_least || quantity.is_reach,
        value,
    })
}

/// Property and `number` converted to the unit of the property; `None` for an unknown unit.
fn measured(quantity: &Quantity, number: f64, unit: &str) -> Option<(Property, f64)> {
    if let Property::Price(_) = quantity.property {
        let mut known = CURRENCIES.into_iter();
        let currency = known.find(|currency| currency.eq_ignore_ascii_case(unit))?;
        return Some((Property::Price(currency), number));
    }
    if unit == quantity.unit {
        return Some((quantity.property, number));
    }
    let mut others = OTHER_UNITS.iter();
    let other = others.find(|other| other.unit == quantity.unit && other.written == unit)?;
    Some((quantity.property, number * other.times / other.over))
}

impl Bound {
    /// True if `value` meets the bound.
    pub fn holds(&self, value: f64) -> bool {
        if self.is_least {
            value >= self.value
        } else {
            value <= self.value
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if matches!(self.property, Property::Opaque | Property::Bought) {
            return write!(f, "{}", self.property);
        }
        let sign = if self.is_least { "≥" } else { "≤" };
        write!(
            f,
            "{} {sign} {}",
            self.property,
            self.property.shown(self.value)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_bound_to_the_side_that_is_meant() {
        let bound = |text: &str| Need::parse(text).expect("a need")[0].bounds[0].to_string();
        assert_eq!(bound("force <= 1 N"), "greatest normal force ≥ 1 N");
        assert_eq!(bound("localisation 0.3 mm"), "MAE of Pxy ≤ 0.3 mm");
        assert_eq!(bound("rate >= 50 Hz"), "frame rate ≥ 50 Hz");
        assert_eq!(bound("depth error 0.05 mm"), "MAE of Pz ≤ 0.05 mm");
    }

    #[test]
    fn the_written_form_of_every_quantity_is_a_need_of_the_side_that_it_shows() {
        for quantity in QUANTITIES {
            let example = quantity.example();
            let need = &Need::parse(&example).unwrap_or_else(|error| panic!("{error}"))[0];
            assert_eq!(need.bounds[0].is_least, example.contains(">="), "{example}");
        }
        let table = Need::vocabulary();
        for form in ["rate >= <number> Hz", "thickness <= <number> mm"] {
            assert!(table.contains(form), "{table}");
        }
    }

    #[test]
    fn what_is_not_understood_is_refused_by_name() {
        assert_eq!(Need::parse(" , "), Err(NeedError::Empty));
        let error = Need::parse("shear, beauty").expect_err("unknown");
        assert!(
            error
                .to_string()
                .starts_with("`beauty`: unknown need, expected one of shear (or accurate shear, shear force), no shear")
        );
        for wrong in ["rate >= fast", "rate >= 50 kHz", "force -1 N", "rate"] {
            assert!(
                matches!(Need::parse(wrong), Err(NeedError::Number { .. })),
                "{wrong}"
            );
        }
        let said = |text: &str| Need::parse(text).expect_err("refused").to_string();
        assert_eq!(
            said("rate >= 30 fps"),
            "`rate >= 30 fps`: expected a number above 0 and the unit Hz, such as `rate >= 30 Hz`"
        );
        assert_eq!(
            said("uniformity high"),
            "`uniformity high`: expected a number above 0, such as `uniformity >= 0.9`"
        );
        assert_eq!(
            said("force error <= 0.1 N at 5 N"),
            "`force error <= 0.1 N at 5 N`: expected a number above 0 and the unit N, such as `force error <= 1 N, force >= 5 N`"
        );
        assert!(said("robust to dust").starts_with("`robust to dust`: expected `rugged`"));
        assert!(said("cheap").starts_with("`cheap`: prices are not ranked"));
        assert_eq!(
            said("force error < 0.1 N"),
            "`force error < 0.1 N`: a bound includes its number; write `force error <= 0.1 N`"
        );
        assert_eq!(
            said("price <= 500"),
            "`price <= 500`: expected a number above 0 and a currency of USD, EUR, GBP, AUD, CAD, CHF, CNY, JPY, KRW, such as `price <= 500 USD`"
        );
        let needs = Need::read("needs = [\"shear\", \"rate >= 50 Hz\"]").expect("a file");
        assert_eq!(needs.len(), 2);
    }

    #[test]
    fn every_wrong_need_of_a_list_is_refused_at_once_with_the_known_needs_once() {
        let said = Need::parse("beauty, shear, rate >= fast, elegance").expect_err("three");
        let said = said.to_string();
        for words in [
            "`beauty`, `elegance`: unknown need",
            "`rate >= fast`: expected",
        ] {
            assert!(said.contains(words), "{words}: {said}");
        }
        assert_eq!(said.matches("expected one of").count(), 1, "{said}");
        assert!(said.contains("depth (or accurate depth, "), "{said}");
    }

    #[test]
    fn units_of_the_same_quantity_are_converted_and_currencies_are_not() {
        let bound = |text: &str| Need::parse(text).expect("a need")[0].bounds[0];
        assert_eq!(bound("force 100 mN"), bound("force 0.1 N"));
        assert_eq!(bound("width <= 2.5 cm"), bound("width <= 25 mm"));
        assert_eq!(bound("price <= 90 eur").property, Property::Price("EUR"));
        for sensor in crate::catalogue::all() {
            for price in sensor.prices {
                assert!(
                    CURRENCIES.contains(&price.currency.as_str()),
                    "{}",
                    price.currency
                );
            }
        }
    }
}
