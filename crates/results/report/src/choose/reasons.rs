//! Reasons why a sensor has no rank: every need that it does not meet, and every unknown value.

use super::inexact::decided;
use super::{Bound, Need, Property};
use crate::catalogue::Sensor;
use crate::names::listed;

/// First value of `sensor` that a need uses and that is excluded from verdicts.
pub(super) fn barred(sensor: &Sensor, needs: &[Need]) -> Option<String> {
    let properties = needs
        .iter()
        .flat_map(|need| need.properties().map(move |property| (need, property)));
    let mut barred = properties.filter_map(|(need, property)| {
        let reason = property.standing(sensor).reason()?;
        Some(format!("`{}` uses {property}: {reason}", need.words))
    });
    barred.next()
}

/// True if the value of `sensor` is known and does not meet `bound`, or if no possible value of an inexact value meets `bound`. Always false for a
/// known greatest depth or force, because the sensor may withstand more than the greatest tested value.
pub(super) fn is_unmet(sensor: &Sensor, bound: &Bound) -> bool {
    match bound.property.of(sensor) {
        Some(value) => !bound.property.is_reached() && !bound.holds(value),
        None => decided(sensor, bound).is_some_and(|decided| !decided.is_met),
    }
}

/// True if an inexact value of `sensor` decides a hard need.
pub(super) fn is_decided(sensor: &Sensor, needs: &[Need]) -> bool {
    bounds(needs).any(|(_, bound)| decided(sensor, bound).is_some())
}

/// Hard needs that `sensor` does not meet, each with the value.
pub(super) fn unmet(sensor: &Sensor, needs: &[Need]) -> Vec<String> {
    let failed = bounds(needs).filter(|(_, bound)| is_unmet(sensor, bound));
    let reasons = failed.filter_map(|(need, bound)| {
        let property = bound.property;
        let value = match property.of(sensor) {
            Some(value) => property.shown(value),
            None => decided(sensor, bound)?.shown,
        };
        let ends = property.interval(sensor);
        let is_unsure = ends.is_some_and(|ends| ends.into_iter().any(|end| bound.holds(end)));
        let unsure = match is_unsure {
            true => ", by the value only: its interval crosses the bound",
            false => "",
        };
        Some(match property {
            Property::Opaque => format!("`{}` needs {CLOSED}, and its gel does not", need.words),
            _ => format!("{}: its {property} is {value}{unsure}", asked(need, bound)),
        })
    });
    reasons.collect()
}

/// Hard needs for which the value of `sensor` is unknown.
pub(super) fn unproven(sensor: &Sensor, needs: &[Need]) -> Vec<String> {
    let unproven = bounds(needs).filter_map(|(need, bound)| {
        let property = bound.property;
        let reason = match property.of(sensor) {
            None if decided(sensor, bound).is_some() => return None,
            None if property == Property::Opaque => {
                let words = &need.words;
                return Some(format!("`{words}` needs {CLOSED}, which is unknown"));
            }
            None if property == Property::Bought => {
                let words = &need.words;
                return Some(format!("`{words}` needs a seller, and no seller is known"));
            }
            None => match property.other(sensor) {
                Some(other) => format!("is not known; known: {other}"),
                None => "is not known".to_owned(),
            },
            Some(value) if property.is_reached() && !bound.holds(value) => format!(
                "that was tested is {}, which need not be its limit",
                property.shown(value)
            ),
            Some(_) => return None,
        };
        Some(format!("{}: its {property} {reason}", asked(need, bound)))
    });
    unproven.collect()
}

/// Properties in soft needs whose value is unknown for `sensor`, as text; `None` if all values are known.
pub(super) fn unplaced(sensor: &Sensor, needs: &[Need]) -> Option<String> {
    let ranks = needs.iter().flat_map(|need| &need.ranks);
    let unknown = ranks.filter(|property| property.of(sensor).is_none());
    let unknown: Vec<&Property> = unknown.collect();
    let names = unknown.iter().copied().map(Property::to_string);
    let names: Vec<String> = names.collect();
    let others = unknown.iter().filter_map(|property| property.other(sensor));
    let others: String = others.map(|other| format!("; known: {other}")).collect();
    (!names.is_empty()).then(|| format!("no known {}{others}", listed(&names)))
}

/// Text of a bound on [`Property::Opaque`].
const CLOSED: &str = "a gel that keeps light out";

/// Bounds of all needs, each with its need.
fn bounds(needs: &[Need]) -> impl Iterator<Item = (&Need, &Bound)> {
    let bounds = needs.iter();
    bounds.flat_map(|need| need.bounds.iter().map(move |bound| (need, bound)))
}

/// Need as the user wrote it, with its bound if the words do not state it: `firm contact` with `greatest normal force ≥ 1.5 N`. The need `force <=
/// 1 N` also gets its bound, because the sensor must reach 1 N.
fn asked(need: &Need, bound: &Bound) -> String {
    let has_number = need.words.contains(|letter: char| letter.is_ascii_digit());
    match has_number && !bound.property.is_reached() {
        true => format!("`{}`", need.words),
        false => format!("`{}` ({bound})", need.words),
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

    fn reason<'a>(list: &'a [Dropped], name: &str) -> &'a str {
        let found = list.iter().find(|of| of.name == name);
        &found
            .unwrap_or_else(|| panic!("no {name}: {list:?}"))
            .reason
    }

    #[test]
    fn a_dropped_sensor_names_every_need_that_it_does_not_meet_and_every_unknown_number() {
        let choice = chosen("rate >= 50 Hz, localisation 0.2 mm, price <= 5 AUD");
        let gelsight = reason(&choice.dropped, "GelSight");
        let unmet = "`rate >= 50 Hz`: its frame rate is 25 Hz; `localisation 0.2 mm`: its MAE of Pxy is 0.2479 mm; ";
        assert!(gelsight.starts_with(unmet), "{gelsight}");
        let unknown = "; `price <= 5 AUD`: its price in AUD is not known; known: ";
        assert!(gelsight.contains(unknown), "{gelsight}");
        let values = choice.values();
        let mut rows = values.rows.iter().map(|row| row.plain());
        let row = rows.find(|row| row[0] == "GelSight").expect("a row");
        let unmet = row.iter().filter(|cell| cell.ends_with(" (not met)"));
        assert_eq!(unmet.count(), 2, "{row:?}");
    }

    #[test]
    fn an_open_sensor_names_every_unknown_number_and_the_bound_behind_a_word() {
        let choice = chosen("firm contact, normal force, price <= 600 USD");
        let vitactip = reason(&choice.open, "ViTacTip");
        let tested = "`firm contact` (greatest normal force ≥ 1.5 N): its greatest normal force that was tested is 0.7 N, which need not be its limit; `price <= 600 USD`: its price in USD is not known";
        assert!(vitactip.starts_with(tested), "{vitactip}");
    }

    #[test]
    fn sensors_with_one_reason_share_one_line() {
        let choice = chosen("bought, rate >= 1 Hz");
        let reason = "`bought` needs a seller, and no seller is known";
        let alike = choice.open.iter().filter(|of| of.reason == reason);
        assert!(alike.count() > 1, "{choice:?}");
        let text = choice.table().text();
        let line = format!(": open, because {reason}.");
        assert_eq!(text.matches(&line).count(), 1, "{text}");
    }

    #[test]
    fn prices_in_other_currencies_are_counted_and_never_converted() {
        let note = "Not compared with the bound, because the price has another currency: ";
        let euros = chosen("price <= 600 EUR, rate >= 1 Hz");
        assert!(euros.ranked.is_empty(), "{euros:?}");
        let dollars = euros.other_currencies["USD"];
        let text = euros.table().text();
        assert!(text.contains(note), "{text}");
        let counted =
            format!("{dollars} sensors in USD. Choose again with a bound in that currency.");
        assert!(dollars > 1 && text.contains(&counted), "{text}");
        let dollars = chosen("price <= 600 USD, rate >= 1 Hz");
        assert!(!dollars.other_currencies.contains_key("USD"), "{dollars:?}");
        assert!(dollars.other_currencies["KRW"] > 1, "{dollars:?}");
        assert!(!chosen("rate >= 1 Hz").table().text().contains(note));
    }

    #[test]
    fn a_need_for_thickness_shows_the_outer_dimensions_of_a_sensor_without_a_thickness() {
        for needs in [
            "thickness <= 20 mm",
            "height <= 20 mm",
            "sensor thickness <= 20 mm",
        ] {
            let choice = chosen(needs);
            let digit = reason(&choice.other_definitions, "DIGIT");
            let known = "no thickness of the sensor; known: 20 × 27 × 18 mm (housing)";
            assert!(digit.starts_with(known), "{digit}");
        }
    }
}
