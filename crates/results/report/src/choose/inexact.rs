//! Inexact values that decide a bound: `> 1000 USD` is above 500 USD, and no side of 20 × 27 × 18 mm is above 30 mm.

use super::need::Bound;
use super::property::Property;
use crate::catalogue::{Goods, Price, Roughly, Sensor};

/// Decision on a bound by an inexact value.
pub(super) struct Decided {
    /// True if every possible value meets the bound, false if none does.
    pub(super) is_met: bool,
    /// Number as text: `> 1000 USD`.
    pub(super) shown: String,
}

/// Least and greatest possible value of a property, with the number as text.
struct Inexact {
    ends: [f64; 2],
    shown: String,
}

/// Decision on `bound` by an inexact value of `sensor`. `None` if an exact value is known, or if only a part of the possible values meets the bound.
pub(super) fn decided(sensor: &Sensor, bound: &Bound) -> Option<Decided> {
    let property = bound.property;
    if property.of(sensor).is_some() {
        return None;
    }
    let found = price(sensor, property).or_else(|| published(sensor, property));
    let Inexact { ends, shown } = found.or_else(|| thickness(sensor, property))?;
    let [is_met, is_met_by_greatest] = ends.map(|end| bound.holds(end));
    (is_met == is_met_by_greatest).then_some(Decided { is_met, shown })
}

/// Possible values of the only known price of a ready sensor in the currency of the bound; `None` for several prices.
fn price(sensor: &Sensor, property: Property) -> Option<Inexact> {
    let currency = property.currency()?;
    let ready = sensor.prices.iter();
    let ready = ready.filter(|price| price.goods == Goods::Sensor && price.currency == currency);
    let ready: Vec<&Price> = ready.collect();
    let [price] = ready[..] else {
        return None;
    };
    Some(Inexact {
        ends: ends(price.bound?, price.amount)?,
        shown: price.shown(),
    })
}

/// Possible values of the inexact published number of the property.
fn published(sensor: &Sensor, property: Property) -> Option<Inexact> {
    let score = property.score()?;
    let mut results = sensor.results.iter().filter(|result| result.is_defined());
    let result = results.find(|of| (of.metric.as_str(), of.channel.as_str()) == score)?;
    let shown = format!("{} {}", result.shown(), property.unit());
    Some(Inexact {
        ends: ends(result.bound?, result.value)?,
        shown: shown.trim_end().to_owned(),
    })
}

/// Possible thickness: one of the three outer dimensions, because their order differs between sources.
fn thickness(sensor: &Sensor, property: Property) -> Option<Inexact> {
    let size = sensor.size.as_ref();
    let size = size.filter(|size| property == Property::Thickness && size.mm.len() == 3)?;
    let sides = size.mm.iter().copied();
    Some(Inexact {
        ends: [sides.fold(f64::INFINITY, f64::min), size.greatest_mm()?],
        shown: format!("one of {} mm", size.shown()),
    })
}

/// Least and greatest possible value of `number`; `None` for an approximate number.
const fn ends(bound: Roughly, number: f64) -> Option<[f64; 2]> {
    match bound {
        Roughly::Above => Some([number, f64::INFINITY]),
        Roughly::Below => Some([0.0, number]),
        Roughly::About => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::catalogue;
    use crate::choose::{Choice, Dropped, Need, choose};

    /// Choice for `needs` among the whole catalogue.
    fn chosen(needs: &str) -> Choice {
        let needs = Need::parse(needs).unwrap_or_else(|error| panic!("{error}"));
        choose(&catalogue::all(), &needs)
    }

    fn reason<'a>(list: &'a [Dropped], name: &str) -> Option<&'a str> {
        let found = list.iter().find(|of| of.name == name);
        found.map(|of| of.reason.as_str())
    }

    /// Cell of the last column in the row of a sensor.
    fn cell(choice: &Choice, name: &str) -> String {
        let table = choice.values();
        let mut rows = table.rows.iter().map(|row| row.plain());
        let row = rows.find(|row| row[0] == name);
        row.unwrap_or_else(|| panic!("no {name}"))[2].clone()
    }

    #[test]
    fn a_price_above_an_amount_is_above_each_lower_bound_and_open_to_others() {
        let name = "Contactile PapillArray";
        let cheap = chosen("price <= 500 USD");
        let dropped = reason(&cheap.dropped, name).unwrap_or_else(|| panic!("{cheap:?}"));
        let expected = "`price <= 500 USD`: its price in USD is > 1000 USD";
        assert_eq!(dropped, expected);
        assert_eq!(cell(&cheap, name), "> 1000 USD (not met)");
        let dear = chosen("price <= 2000 USD");
        let other = reason(&dear.other_definitions, name);
        assert!(other.is_some(), "{dear:?}");
    }

    #[test]
    fn a_thickness_is_decided_by_its_bound_or_by_all_three_outer_dimensions() {
        let wide = chosen("thickness <= 30 mm");
        assert_eq!(cell(&wide, "FlexiTac"), "< 1 mm");
        assert_eq!(cell(&wide, "DIGIT"), "one of 20 × 27 × 18 mm");
        let ranked = |name: &str| wide.ranked.iter().any(|of| of.name == name);
        assert!(ranked("FlexiTac") && ranked("DIGIT") && !ranked("Xense G1"));
        let thin = chosen("thickness <= 17 mm");
        let dropped = reason(&thin.dropped, "DIGIT").unwrap_or_else(|| panic!("{thin:?}"));
        assert!(dropped.ends_with("is one of 20 × 27 × 18 mm"), "{dropped}");
        // A diameter alone leaves the thickness open.
        assert!(reason(&thin.other_definitions, "DIGIT Pinki").is_some());
    }
}
