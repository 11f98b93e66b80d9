//! From JSON to results, place by place: whatever is amiss is named by where it stands.

mod place;
mod values;

use super::{ResultsError, Skip, Study};
use crate::json::Json;
use place::Place;

/// The evaluations in `text`.
pub(super) fn studies(text: &str) -> Result<Vec<Study>, ResultsError> {
    let json: Json = serde_json::from_str(text)?;
    let root = Place::root(&json);
    match json.get("schema") {
        Some(Json::Text(schema)) if is_of(schema, "taceva.evaluation/1") => Ok(vec![study(&root)?]),
        Some(Json::Text(schema)) if is_of(schema, "taceva.run/1") => {
            let studies = root.entry("studies")?.items()?;
            studies.iter().map(study).collect()
        }
        Some(Json::Text(schema)) => Err(ResultsError::Schema {
            found: format!("schema `{}`", schema.escape_debug()),
        }),
        _ => Err(ResultsError::Schema {
            found: "no schema".to_owned(),
        }),
    }
}

/// Whether a schema is some minor version of `major`.
fn is_of(schema: &str, major: &str) -> bool {
    let minor = schema.strip_prefix(major);
    minor.is_some_and(|minor| {
        minor.is_empty()
            || minor
                .strip_prefix('.')
                .is_some_and(|minor| minor.parse::<u32>().is_ok())
    })
}

fn study(root: &Place<'_>) -> Result<Study, ResultsError> {
    let subject = root.entry("subject")?;
    let named = |key: &str| -> Result<String, ResultsError> {
        let text = subject
            .optional(key)
            .map_or(Ok("unknown"), |place| place.text());
        text.map(str::to_owned)
    };
    let mut scores = Vec::new();
    for (metric, channels) in root.entry("metrics")?.entries()? {
        for (channel, place) in channels.entries()? {
            scores.push(values::score(metric, channel, &place)?);
        }
    }
    let skipped = match root.optional("skipped") {
        Some(place) => place.items()?.iter().map(skip).collect::<Result<_, _>>()?,
        None => Vec::new(),
    };
    let provenance = root.optional("provenance");
    let entries = provenance.as_ref().map_or(Ok(Vec::new()), Place::entries)?;
    let mut notes = Vec::new();
    if let Some(place) = provenance
        .as_ref()
        .and_then(|place| place.optional("notes"))
    {
        for note in place.items()? {
            notes.push(note.text()?.to_owned());
        }
    }
    let entries = entries.into_iter().filter(|(name, _)| *name != "notes");
    Ok(Study {
        sensor: subject.entry("sensor")?.text()?.to_owned(),
        serial: named("serial")?,
        gel: named("gel")?,
        source: named("source")?,
        scores,
        skipped,
        provenance: entries
            .map(|(name, place)| (name.to_owned(), flat(place.json())))
            .filter(|(_, text)| !text.is_empty())
            .collect(),
        notes,
        samples: None,
    })
}

fn skip(place: &Place<'_>) -> Result<Skip, ResultsError> {
    Ok(Skip {
        what: place.entry("what")?.text()?.to_owned(),
        reason: place.entry("reason")?.text()?.to_owned(),
    })
}

/// A value of provenance as one line.
fn flat(json: &Json) -> String {
    match json {
        Json::Null => String::new(),
        Json::Bool(value) => value.to_string(),
        Json::Number(number) => number.to_string(),
        Json::Text(text) => text.clone(),
        Json::List(items) => items.iter().map(flat).collect::<Vec<_>>().join(", "),
        Json::Object(entries) => {
            let entries = entries.iter();
            let texts = entries.map(|(name, value)| format!("{name} {}", flat(value)));
            texts.collect::<Vec<_>>().join(", ")
        }
    }
}
