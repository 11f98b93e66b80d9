//! Price of a sensor, and ways to get a sensor.

use serde::Deserialize;

use super::published::Roughly;

/// Format of a date in the catalogue.
pub(super) const DAY: &str = "a day such as 2026-11-28";

/// Price with its source and date.
///
/// ```
/// use taceva_report::catalogue;
/// let digit = catalogue::find("DIGIT").expect("there");
/// assert_eq!((digit.prices[0].shown(), digit.prices[0].class()), ("15 USD".to_owned(), "below 100 USD".to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Price {
    /// Amount, in `currency`.
    pub amount: f64,
    /// Currency as three letters: `USD`.
    pub currency: String,
    /// Kind of the goods.
    pub goods: Goods,
    /// Description of the goods and quantity at this price: `parts of one sensor, of 1000 made`.
    pub of: String,
    /// Relation of the true price to the amount, if the amount is inexact.
    pub bound: Option<Roughly>,
    /// Id of the source.
    pub source: String,
    /// Place in the source: `table`, `text` or `abstract`.
    pub read_from: String,
    /// Date at which the price was seen.
    pub seen: String,
    /// Remarks for readers; `None` for no remark.
    pub note: Option<String>,
}

/// Kind of the goods that a price is for. Prices of different kinds are not compared.
///
/// ```
/// use taceva_report::catalogue::{self, Goods};
/// let digit = catalogue::find("DIGIT").expect("there");
/// assert_eq!(digit.prices[0].goods, Goods::Parts);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Goods {
    /// A sensor that is ready, from a seller.
    Sensor,
    /// Parts or material for a sensor, or the production of a sensor.
    Parts,
    /// Goods that the source does not state.
    Unstated,
}

impl Goods {
    /// Name of the quantity in tables.
    pub const fn quantity(self) -> &'static str {
        match self {
            Goods::Sensor => "price",
            Goods::Parts => "cost of parts",
            Goods::Unstated => "price or cost of parts",
        }
    }

    /// Definition of the price in tables.
    pub const fn definition(self) -> &'static str {
        match self {
            Goods::Sensor => "price of a ready sensor",
            Goods::Parts => "cost of parts, material or making, not of a ready sensor",
            Goods::Unstated => "definition not stated by the source: a ready sensor or its parts",
        }
    }
}

impl Price {
    /// True for the exact price of a ready sensor.
    pub fn is_comparable(&self) -> bool {
        self.goods == Goods::Sensor && self.bound.is_none()
    }

    /// Amount with its currency, and `≈`, `>` or `<` if inexact.
    pub fn shown(&self) -> String {
        let sign = self.bound.map_or("", Roughly::sign);
        format!("{sign}{} {}", self.amount, self.currency)
    }

    /// Class of the price by the limits 100, 1000, 10000, … of its currency: `below 100 USD`, `below 1000 USD`. A price published as `> 1000 USD`
    /// has the class `1000 USD and more`.
    pub fn class(&self) -> String {
        let edges = (2..=9).map(|power| 10_f64.powi(power));
        let is_open = self.bound == Some(Roughly::Above);
        let mut edges = edges.filter(|edge| !is_open && self.amount < *edge);
        match edges.next() {
            Some(edge) => format!("below {edge} {}", self.currency),
            None => format!("{} {} and more", self.amount, self.currency),
        }
    }

    /// Remarks on the price, and the date at which it was seen.
    pub fn conditions(&self) -> String {
        let note = self.note.as_ref();
        let note = note.map_or_else(String::new, |note| format!("; {note}"));
        format!("{}, seen on {}{note}", self.of, self.seen)
    }
}

/// A way to get a sensor.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Availability {
    /// Bought or built.
    pub way: Way,
    /// Name of the seller, or description of the published files.
    pub conditions: String,
    /// Id of the source.
    pub source: String,
    /// Date at which the source was read.
    pub seen: String,
}

/// Ways to get a sensor: bought, or built from published files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// Ready to buy.
    Bought,
    /// Built from published drawings or instructions.
    Built,
}

impl Way {
    /// Word for the way in tables.
    pub const fn word(self) -> &'static str {
        match self {
            Way::Bought => "bought",
            Way::Built => "built",
        }
    }
}

/// True for a date in the format of [`DAY`].
pub(super) fn is_day(text: &str) -> bool {
    let is_number =
        |part: &str, digits| part.len() == digits && part.bytes().all(|byte| byte.is_ascii_digit());
    let parts: Vec<&str> = text.split('-').collect();
    let [year, month, day] = parts[..] else {
        return false;
    };
    is_number(year, 4)
        && is_number(month, 2)
        && is_number(day, 2)
        && ("01"..="12").contains(&month)
        && ("01"..="31").contains(&day)
}

/// True for a currency code in the format of ISO 4217.
pub(super) fn is_currency(text: &str) -> bool {
    text.len() == 3 && text.bytes().all(|byte| byte.is_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::Sensor;

    fn priced(amount: &str, currency: &str, seen: &str) -> Result<Sensor, String> {
        let text = format!(
            "catalogue_version = 1\nname = \"x\"\nkind = \"sensor\"\nmechanism = []\n[[price]]\namount = {amount}\ncurrency = \"{currency}\"\ngoods = \"parts\"\n\
             of = \"one\"\nsource = \"s\"\nread_from = \"text\"\nseen = \"{seen}\"\n"
        );
        Sensor::read("x.toml", &text).map_err(|error| error.to_string())
    }

    #[test]
    fn the_class_of_a_price_has_its_edge_in_the_class_above() {
        for (amount, class) in [
            ("99.99", "below 100 USD"),
            ("100.0", "below 1000 USD"),
            ("90200.0", "below 100000 USD"),
            ("1e10", "10000000000 USD and more"),
        ] {
            let sensor = priced(amount, "USD", "2026-11-28").expect("a price");
            assert_eq!(sensor.prices[0].class(), class);
        }
        let mut sensor = priced("1000.0", "USD", "2026-11-28").expect("a price");
        sensor.prices[0].bound = Some(Roughly::Above);
        assert_eq!(sensor.prices[0].class(), "1000 USD and more");
    }

    #[test]
    fn a_price_of_no_amount_currency_or_day_is_refused_by_its_value() {
        for (amount, currency, seen, named) in [
            ("0.0", "USD", "2026-11-28", "amount"),
            ("nan", "USD", "2026-11-28", "amount"),
            ("1.0", "dollars", "2026-11-28", "currency"),
            ("1.0", "USD", "yesterday", "seen"),
            ("1.0", "USD", "2026-13-01", "seen"),
        ] {
            let error = priced(amount, currency, seen).expect_err(named);
            assert!(error.contains(named), "{error}");
        }
    }
}
