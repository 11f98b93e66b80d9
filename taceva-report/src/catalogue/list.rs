//! The catalogue as rows.

use super::Sensor;
use crate::listing::Listing;
use crate::number::numeral;

/// A row a sensor.
pub fn list(sensors: &[Sensor]) -> Listing {
    let head = [
        "sensor",
        "mechanism",
        "light kept out",
        "MAE Pxy mm",
        "MAE Pz mm",
        "MAE Fxy N",
        "MAE Fz N",
        "rate Hz",
    ];
    let mut listing = Listing::new(
        "Catalogue of vision-based tactile sensors, as published",
        &head,
    );
    for sensor in sensors {
        let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), numeral);
        let mae = |channel| number(sensor.result("mae", channel).map(|result| result.value));
        let rate = sensor
            .intrinsic
            .as_ref()
            .map(|intrinsic| intrinsic.frame_rate_hz);
        let opaque = sensor
            .opaque
            .map_or("–", |opaque| if opaque { "yes" } else { "no" });
        listing.rows.push(vec![
            sensor.name.clone(),
            sensor.mechanism.join("+"),
            opaque.to_owned(),
            mae("Pxy"),
            mae("Pz"),
            mae("Fxy"),
            mae("Fz"),
            number(rate),
        ]);
    }
    listing.notes.push("A dash: no number is known here. `taceva catalogue show NAME` gives every number with its source.".to_owned());
    listing
}

/// Every published number of a sensor, with source and conditions.
pub fn details(sensor: &Sensor) -> Listing {
    let head = ["metric", "channel", "value", "unit", "source", "conditions"];
    let mut listing = Listing::new(
        &format!("{} ({})", sensor.name, sensor.mechanism.join("+")),
        &head,
    );
    let entry =
        |metric: &str, channel: &str, value: String, unit: &str, source: &str, conditions: &str| {
            [metric, channel, &value, unit, source, conditions]
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
            listing.rows.push(entry(
                "intrinsic",
                name,
                value.to_string(),
                unit,
                &of.source,
                "",
            ));
        }
    }
    if let Some(of) = &sensor.limits {
        for (name, value, unit) in [
            ("Pz", of.pz_max_mm, "mm"),
            ("Fz", of.fz_max_n, "N"),
            ("radius", of.radius_max_mm, "mm"),
        ] {
            listing.rows.push(entry(
                "greatest",
                name,
                value.to_string(),
                unit,
                &of.source,
                "",
            ));
        }
    }
    for result in &sensor.results {
        let source = format!("{}, {}", result.source, result.read_from);
        let value = result.value.to_string();
        listing.rows.push(entry(
            &result.metric,
            &result.channel,
            value,
            &result.unit,
            &source,
            &result.conditions,
        ));
    }
    for missing in &sensor.missing {
        listing.notes.push(format!(
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
            listing
                .notes
                .push(format!("Reported by the work itself, {word}: {names}."));
        }
    }
    for source in &sensor.sources {
        let link = source
            .link
            .as_ref()
            .map_or_else(String::new, |link| format!(" {link}"));
        listing
            .notes
            .push(format!("Source `{}`: {}{link}", source.id, source.text));
    }
    listing
}
