//! Catalogue as table rows.

use taceva_metrics::Better;

use super::{Kind, Sensor};
use crate::table::{Column, Direction, Table};

/// Table with one row for each sensor. A note names the studies of sensors.
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
        Column::new("numbers"),
    ];
    let mut table = Table::new("Catalogue of tactile sensors, as published", columns);
    let is_sensor = |entry: &&Sensor| entry.kind == Kind::Sensor;
    for sensor in sensors.iter().filter(is_sensor) {
        // Published numbers keep their digits.
        let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |of| of.to_string());
        let mae = |channel| number(sensor.result("mae", channel).map(|result| result.value));
        let opaque = sensor
            .opaque
            .map_or("–", |opaque| if opaque { "yes" } else { "no" });
        table.push([
            sensor.name.clone(),
            sensor.mechanism.join("+"),
            opaque.to_owned(),
            mae("Pxy"),
            mae("Pz"),
            mae("Fxy"),
            mae("Fz"),
            number(sensor.frame_rate_hz()),
            sensor.known().to_string(),
        ]);
    }
    table.note("A dash: no number of that definition is known here. The last column counts all known numbers; `taceva catalogue show NAME` lists each with its source, definition and conditions.");
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
            "",
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
            &price.class(),
            &price.conditions(),
        ]
        .map(str::to_owned)
    });
    let ways = sensor.availability.iter().map(|offer| {
        let conditions = format!("{}, seen on {}", offer.conditions, offer.seen);
        let word = offer.way.word();
        ["availability", "", word, "", &offer.source, "", &conditions].map(str::to_owned)
    });
    size.chain(prices).chain(ways).collect()
}

/// Table of all published numbers of a sensor, with source and conditions.
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
        Kind::Sensor => sensor.mechanism.join("+"),
        Kind::Study => "a study of sensors, not a sensor".to_owned(),
    };
    let columns = [Column::of_metrics()].into_iter();
    let mut table = Table::new(
        format!("{} ({kind})", sensor.name),
        columns.chain(others.map(Column::new)),
    );
    let built = |metric: &str, channel: &str, value: f64, unit: &str, source: &str| {
        let value = value.to_string();
        [metric, channel, &value, unit, source, "", ""]
            .map(str::to_owned)
            .to_vec()
    };
    if let Some(of) = &sensor.intrinsic {
        for (name, value, unit) in [
            ("camera", of.camera_mp, "MP"),
            ("thickness", of.thickness_mm, "mm"),
            ("field_of_view", of.field_of_view_mm2, "mm²"),
            ("frame_rate", of.frame_rate_hz, "Hz"),
        ] {
            table.push(built("intrinsic", name, value, unit, &of.source));
        }
    }
    if let Some(of) = &sensor.limits {
        for (name, value, unit) in [
            ("Pz", of.pz_max_mm, "mm"),
            ("Fz", of.fz_max_n, "N"),
            ("radius", of.radius_max_mm, "mm"),
        ] {
            table.push(built("greatest", name, value, unit, &of.source));
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
    for word in ["yes", "partial", "no"] {
        let names = of(word);
        if !names.is_empty() {
            table.note(format!("Reported in the publication ({word}): {names}."));
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
