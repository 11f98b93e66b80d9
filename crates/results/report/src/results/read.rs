//! From JSON to results; errors name the place.

mod over_seeds;
mod place;
mod values;

use super::{Made, ResultsError, Skip, Study, standing};
use crate::json::Json;
use place::Place;
use taceva_core::shown;
use taceva_files::seal::{Opened, Version};

/// The evaluations in `text`.
pub(super) fn studies(text: &str) -> Result<Vec<Study>, ResultsError> {
    let json: Json = serde_json::from_str(text)?;
    let root = Place::root(&json);
    let seal = match json.get("schema").and_then(Json::text) {
        Some(schema) if is_known(schema) => {
            taceva_files::seal::json::check(text, version_of(schema))?
        }
        _ => Opened::default(),
    };
    let mut studies = unchecked(&json, &root)?;
    for study in &mut studies {
        note_seal(study, &seal);
    }
    Ok(studies)
}

/// Adds the provenance of the file to that of a study.
fn note_seal(study: &mut Study, seal: &Opened) {
    let mut note = |name: &str, text: String| {
        let entries = &mut study.provenance;
        match entries.iter_mut().find(|(known, _)| known == name) {
            Some((_, texts)) => *texts = format!("{texts}, {text}"),
            None => entries.push((name.to_owned(), text)),
        }
    };
    for edit in &seal.history {
        note("edits", format!("results, {edit}"));
    }
    if !seal.is_sealed {
        note("unsealed", "results".to_owned());
    }
}

/// Whether results of this schema are sealed: all since minor version 2.
fn version_of(schema: &str) -> Version {
    let minor = schema
        .rsplit_once('.')
        .and_then(|(_, minor)| minor.parse().ok());
    match minor.is_some_and(|minor: u32| minor >= 2) {
        true => Version::Sealed,
        false => Version::BeforeSeals,
    }
}

fn is_known(schema: &str) -> bool {
    is_of(schema, "taceva.evaluation/1") || is_of(schema, "taceva.run/1")
}

fn unchecked(json: &Json, root: &Place<'_>) -> Result<Vec<Study>, ResultsError> {
    match json.get("schema") {
        Some(Json::Text(schema)) if is_of(schema, "taceva.evaluation/1") => Ok(vec![study(root)?]),
        Some(Json::Text(schema)) if is_of(schema, "taceva.run/1") => {
            let studies = root.entry("studies")?.items()?;
            studies.iter().map(study).collect()
        }
        Some(Json::Text(schema)) => Err(ResultsError::Schema {
            found: format!("schema `{}`", shown(schema)),
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
    let made = provenance.as_ref().map_or(Ok(Made::default()), made)?;
    if !says_standing(root) {
        standing::by_r2(&mut scores);
    }
    let entries = entries.into_iter().filter(|(name, _)| *name != "notes");
    let over_seeds = root.optional("over_seeds");
    let over_seeds = over_seeds.map(|place| over_seeds::over_seeds(&place));
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
        made,
        notes,
        over_seeds: over_seeds.transpose()?,
        samples: None,
    })
}

/// How it was made, in parts; what an older result does not say is absent.
fn made(provenance: &Place<'_>) -> Result<Made, ResultsError> {
    let mut made = Made::default();
    if let Some(model) = provenance.optional("model") {
        made.model = Some(model.entry("name")?.text()?.to_owned());
        if let Some(settings) = model.optional("settings") {
            for (name, place) in settings.entries()? {
                made.settings.push((name.to_owned(), flat(place.json())));
            }
        }
    }
    if let Some(samples) = provenance.optional("samples") {
        for (part, place) in samples.entries()? {
            made.samples.push((part.to_owned(), place.count()?));
        }
    }
    if let Some(presses) = provenance.optional("presses") {
        for (_, outcomes) in presses.entries()? {
            for (_, place) in outcomes.entries()? {
                made.presses += place.count()?;
            }
        }
    }
    Ok(made)
}

/// Whether the results are of a version that says the standing of each score: since 1.2.
fn says_standing(root: &Place<'_>) -> bool {
    let schema = root.optional("schema").and_then(|at| at.text().ok());
    let minor = schema.and_then(|schema| schema.strip_prefix("taceva.evaluation/1."));
    minor.is_some_and(|minor| minor.parse::<u32>().is_ok_and(|minor| minor >= 2))
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
