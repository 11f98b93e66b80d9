//! Catalogue as table rows.

use taceva_metrics::Better;

use super::bundle_row::{DEPTH_NOTE, Measured};
use super::facts::{SIZE, TESTED};
use super::offer::Goods;
use super::{Kind, Sensor};
use crate::table::{Column, Direction, Table};

/// Explanation of the abbreviations of mechanisms.
pub(crate) const MECHANISMS: &str = "IMM: the camera maps intensity. MDM: the camera follows displacements of markers. MFM: the sensor fuses modalities. \
                                     Magnetic, capacitive, resistive and optical sensors have taxels and no camera.";

/// Table with one row for each sensor. A note names the studies of sensors. A column counts the values from bundles, if there are any.
pub fn list(sensors: &[Sensor]) -> Table {
    let error = |name: &str, unit: &str| {
        let column = Column::new(name).unit(unit);
        column.direction(Direction::Is(Better::Lower))
    };
    let columns = [
        Column::new("sensor"),
        Column::new("mechanism"),
        Column::new("light kept out"),
        error("MAE Pxy", "mm"),
        error("MAE Pz", "mm"),
        error("MAE Fxy", "N"),
        error("MAE Fz", "N"),
        Column::new("rate").unit("Hz"),
        Column::new("size").unit("mm"),
        Column::new("price"),
        Column::new("can be"),
        Column::new("numbers"),
    ];
    let has_bundles = sensors.iter().any(Sensor::has_bundles);
    let of_bundles = has_bundles.then(|| Column::new("of bundles"));
    let columns = columns.into_iter().chain(of_bundles);
    let mut table = Table::new("Catalogue of tactile sensors, as published", columns);
    let is_sensor = |entry: &&Sensor| entry.kind == Kind::Sensor;
    for sensor in sensors.iter().filter(is_sensor) {
        // Published numbers keep their digits.
        let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |of| of.to_string());
        let mae = |channel| number(sensor.result("mae", channel).map(|result| result.value));
        let opaque = sensor
            .opaque
            .map_or("–", |opaque| if opaque { "yes" } else { "no" });
        let of_bundles = has_bundles.then(|| sensor.all_rows().count().to_string());
        let cells = [
            sensor.name.clone(),
            sensor.mechanism.join("+"),
            opaque.to_owned(),
            mae("Pxy"),
            mae("Pz"),
            mae("Fxy"),
            mae("Fz"),
            number(sensor.frame_rate_hz()),
            (sensor.size.as_ref()).map_or_else(|| "–".to_owned(), super::Size::shown),
            prices(sensor),
            ways(sensor),
            sensor.known().to_string(),
        ];
        table.push(cells.into_iter().chain(of_bundles));
    }
    table.note("A dash: no number with the definition of the column is known here. `numbers` counts all published numbers, sizes and prices; `taceva catalogue show NAME` lists each with its source, definition and conditions.");
    table.note("Prices are in the currency of their source and not converted; `(parts)` is the cost of parts, not the price of a ready sensor.");
    table.note(MECHANISMS);
    for sensor in sensors.iter().filter(is_sensor) {
        if let Some(identity) = &sensor.identity {
            table.note(format!("{}: {identity}.", sensor.name));
        }
    }
    let studies: Vec<&str> = sensors
        .iter()
        .filter(|entry| entry.kind == Kind::Study)
        .map(|entry| entry.name.as_str())
        .collect();
    if !studies.is_empty() {
        table.note(format!(
            "Studies of sensors, which have no rows of their own: {}.",
            studies.join(", ")
        ));
    }
    table
}

/// Known prices: `510 USD`, `15 USD (parts)`; a dash without prices.
pub(crate) fn prices(sensor: &Sensor) -> String {
    let prices = sensor.prices.iter().map(|price| match price.goods {
        Goods::Sensor => price.shown(),
        Goods::Parts => format!("{} (parts)", price.shown()),
        Goods::Unstated => format!("{} (sensor or parts)", price.shown()),
    });
    or_dash(prices.collect())
}

/// Ways to get a sensor: `bought; built`; a dash if no way is known.
fn ways(sensor: &Sensor) -> String {
    let ways = sensor.availability.iter();
    or_dash(ways.map(|offer| offer.way.word().to_owned()).collect())
}

fn or_dash(words: Vec<String>) -> String {
    match words.is_empty() {
        true => "–".to_owned(),
        false => words.join("; "),
    }
}

/// Sentence for a sensor that is found by an alias: `GelSight Mini: listed as GelSight`, with the remark on its identity.
///
/// ```
/// use taceva_report::catalogue::{listed_as, named};
/// let sensor = named("gelsight mini")?;
/// assert!(listed_as("gelsight mini", &sensor).is_some_and(|line| line.starts_with("GelSight Mini: listed as GelSight; ")));
/// assert_eq!(listed_as("GelSight", &sensor), None);
/// # Ok::<(), taceva_report::catalogue::NameError>(())
/// ```
pub fn listed_as(name: &str, sensor: &Sensor) -> Option<String> {
    let wanted = name.to_lowercase();
    let mut aliases = sensor.aliases.iter();
    let alias = aliases.find(|alias| alias.to_lowercase() == wanted)?;
    let identity = sensor.identity.iter().map(|words| format!("; {words}"));
    let identity: String = identity.collect();
    Some(format!("{alias}: listed as {}{identity}", sensor.name))
}

/// Rows for size, prices and ways to get a sensor, with the columns of [`details`].
fn offers(sensor: &Sensor) -> Vec<[String; 7]> {
    let source = |id: &str, place: &str| format!("{id}, {place}");
    let size = sensor.size.iter().map(|size| {
        let source = source(&size.source, &size.read_from);
        [
            "size",
            "",
            &size.shown(),
            "mm",
            &source,
            SIZE,
            &size.conditions,
        ]
        .map(str::to_owned)
    });
    let prices = sensor.prices.iter().map(|price| {
        let source = source(&price.source, &price.read_from);
        let sign = price.bound.map_or("", super::Roughly::sign);
        let amount = format!("{sign}{}", price.amount);
        [
            "price",
            "",
            &amount,
            &price.currency,
            &source,
            price.goods.definition(),
            &format!("{}; {}", price.conditions(), price.class()),
        ]
        .map(str::to_owned)
    });
    let ways = sensor.availability.iter().map(|offer| {
        let conditions = format!("{}, seen on {}", offer.conditions, offer.seen);
        let word = offer.way.word();
        let definition = "way to get one";
        [
            "availability",
            "",
            word,
            "",
            &offer.source,
            definition,
            &conditions,
        ]
        .map(str::to_owned)
    });
    size.chain(prices).chain(ways).collect()
}

/// Row of a value from a bundle, with the columns of [`details`].
fn of_bundle(row: &Measured) -> [String; 7] {
    let interval = match row.ci95 {
        Some([low, high]) => format!("95 % interval {low} to {high}"),
        None => "no interval".to_owned(),
    };
    let by = match row.by.is_empty() {
        true => "not stated".to_owned(),
        false => row.by.join(", "),
    };
    [
        row.full_name(),
        row.channel.clone(),
        row.value.to_string(),
        row.unit.clone(),
        format!(
            "bundle {}, {}, level {}",
            row.short_bundle(),
            row.origin_word(),
            row.verified
        ),
        row.definition.clone(),
        format!("{interval}, n = {}, made on {}, by {by}", row.n, row.date),
    ]
}

/// Table of all numbers of a sensor, with source and conditions: published numbers, then values from bundles.
pub fn details(sensor: &Sensor) -> Table {
    let others = [
        "channel",
        "value",
        "unit",
        "source",
        "definition",
        "conditions",
    ];
    let kind = match sensor.kind {
        Kind::Sensor if sensor.mechanism.is_empty() => "mechanism not stated".to_owned(),
        Kind::Sensor => sensor.mechanism.join("+"),
        Kind::Study => "a study of sensors, not a sensor".to_owned(),
    };
    let columns = [Column::of_metrics()].into_iter();
    let mut table = Table::new(
        format!("{} ({kind})", sensor.name),
        columns.chain(others.map(Column::new)),
    );
    if let Some(of) = &sensor.limits {
        for (name, value, unit, definition) in of.rows() {
            let value = value.to_string();
            table.push([
                "greatest", name, &value, unit, &of.source, definition, TESTED,
            ]);
        }
    }
    for row in offers(sensor) {
        table.push(row);
    }
    for result in &sensor.results {
        let source = format!("{}, {}", result.source, result.read_from);
        let note = result.note.as_ref();
        let note = note.map_or_else(String::new, |note| format!("; {note}"));
        let conditions = format!("{}{note}", result.conditions);
        let row = [
            &result.metric,
            &result.channel,
            &result.shown(),
            &result.unit,
            &source,
            &result.definition,
            &conditions,
        ];
        table.push(row.map(ToOwned::to_owned));
    }
    for row in sensor.all_rows() {
        table.push(of_bundle(row));
    }
    if sensor.has_bundles() {
        table.note(DEPTH_NOTE);
    }
    if let Some(identity) = &sensor.identity {
        table.note(format!("{}: {identity}.", sensor.name));
    }
    if !sensor.aliases.is_empty() {
        table.note(format!("Also found as: {}.", sensor.aliases.join(", ")));
    }
    for missing in &sensor.missing {
        table.note(format!(
            "No number of {}: {}.",
            missing.metric, missing.reason
        ));
    }
    let of = |wanted: &str| {
        let found = sensor.reported.iter().filter(|(_, word)| *word == wanted);
        found
            .map(|(name, _)| name.replace('_', " "))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let of_source = sensor.reported.get("source");
    let by = of_source.map_or_else(String::new, |id| format!(", says source `{id}`"));
    for word in ["yes", "partial", "no"] {
        let names = of(word);
        if !names.is_empty() {
            table.note(format!(
                "Reported in {}'s own publication{by} ({word}): {names}.",
                sensor.name
            ));
        }
    }
    for source in &sensor.sources {
        let link = source
            .link
            .as_ref()
            .map_or_else(String::new, |link| format!(" {link}"));
        table.note(format!("Source `{}`: {}{link}", source.id, source.text));
    }
    table
}
