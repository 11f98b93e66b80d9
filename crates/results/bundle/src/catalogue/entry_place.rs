//! Entry of a sensor: the file for its rows, found by the name of the sensor in the results.

use std::path::Path;

use serde::Serialize;
use taceva_core::{is_obeyed, shown};
use taceva_report::catalogue::{self, NameError, Sensor};

use super::error::CatalogueFolderError;
use super::folder::{EntryFile, entry_path};

/// Page names that no sensor may have.
const RESERVED: [&str; 2] = ["index", "measured"];
/// Maximum length of a sensor name, bytes. Tables cut a text after 80 letters, and append origin, level and bundle to the name.
const MOST_NAME: usize = 40;
/// Names that [`is_name`] accepts, for messages.
pub(super) const NAME_RULE: &str = "expected at most 40 bytes with Latin letters or digits, no control characters, no blanks at the ends, and neither `index` nor `measured`";

/// File of an entry, with the text to which rows are appended.
pub(super) struct EntryPlace {
    /// Path in the catalogue: `entries/gelsight.toml`.
    pub(super) path: String,
    /// Existing text of the entry. A new entry has only the keys before its rows.
    pub(super) text: String,
}

impl EntryPlace {
    /// Entry of the sensor called `name`: an entry with that name or alias, the entry of a built-in sensor, or a new entry.
    ///
    /// # Errors
    /// [`CatalogueFolderError::Refused`] for a name that resembles another name, has two meanings, or is not a valid file name.
    pub(super) fn of(
        name: &str,
        entries: &[EntryFile],
        bundle: &Path,
    ) -> Result<EntryPlace, CatalogueFolderError> {
        let refused = |problem: String| Err(CatalogueFolderError::refused(bundle, problem));
        if let Some(known) = entries.iter().find(|entry| entry.sensor.is_called(name)) {
            return Ok(EntryPlace {
                path: known.path.clone(),
                text: known.text.clone(),
            });
        }
        let built_in = match catalogue::named(name) {
            Ok(sensor) => Some(sensor),
            Err(error @ NameError::Ambiguous { .. }) => {
                return refused(format!("the sensor `{}`: {error}", shown(name)));
            }
            Err(_) => None,
        };
        if let Some(sensor) = built_in {
            let mut known = entries.iter();
            return Ok(match known.find(|entry| entry.sensor.name == sensor.name) {
                Some(known) => EntryPlace {
                    path: known.path.clone(),
                    text: known.text.clone(),
                },
                None => EntryPlace::new(&sensor.name, &sensor.slug(), bundle)?,
            });
        }
        let built_in = catalogue::all();
        let mut all = entries.iter().map(|entry| &entry.sensor).chain(&built_in);
        if let Some(alike) = all.find(|sensor| sensor.is_called_like(name)) {
            return refused(format!(
                "the name of the sensor `{}` resembles `{}`: expected one name for one sensor; if both are the same sensor, write `aliases = [{}]` into {}",
                shown(name),
                shown(&alike.name),
                serde_json::Value::from(name),
                entry_path(&alike.slug()),
            ));
        }
        if !is_name(name) {
            return refused(format!("the sensor `{}`: {NAME_RULE}", shown(name)));
        }
        let slug = Sensor::slug_of(name);
        if let Some(other) = entries.iter().find(|entry| entry.path == entry_path(&slug)) {
            return refused(format!(
                "the sensors `{0}` and `{2}` would share the file {1}: choose another name",
                shown(name),
                other.path,
                shown(&other.sensor.name)
            ));
        }
        EntryPlace::new(name, &slug, bundle)
    }

    /// New entry of the sensor called `name`.
    fn new(name: &str, slug: &str, bundle: &Path) -> Result<EntryPlace, CatalogueFolderError> {
        #[derive(Serialize)]
        struct Head<'a> {
            catalogue_version: u32,
            name: &'a str,
            kind: &'a str,
            mechanism: &'a [&'a str],
        }
        let head = Head {
            catalogue_version: 2,
            name,
            kind: "sensor",
            mechanism: &[],
        };
        let text = toml::to_string(&head)
            .map_err(|error| CatalogueFolderError::refused(bundle, error.to_string()))?;
        Ok(EntryPlace {
            path: entry_path(slug),
            text,
        })
    }
}

/// True if `name` gives a valid page address and fits into tables.
pub(super) fn is_name(name: &str) -> bool {
    let slug = Sensor::slug_of(name);
    let has_letter = slug.chars().any(|letter| letter.is_ascii_alphanumeric());
    let is_page = has_letter && !RESERVED.contains(&slug.as_str());
    let is_plain = name.trim() == name && !name.chars().any(is_obeyed);
    is_page && is_plain && name.len() <= MOST_NAME
}
