//! Shortened digests of all values. The seal stores them, so that an error can name the changed key.

use std::collections::BTreeMap;

use crate::seal::canonical::Canonical;
use crate::seal::digest::hexadecimal;

/// Maximum depth of the nested keys that get a separate digest.
const LEVELS: usize = 3;
/// Maximum number of keys. A file with more keys stores no digests of values.
const MOST: usize = 4_096;

/// Shortened digest of each value, by its key: `metrics.mae.Fz`, `studies[1].provenance.seed`.
pub(crate) type Keys = BTreeMap<String, String>;

/// Digests of the values in `value`, by key; empty if there are more than [`MOST`] keys.
pub(crate) fn of(value: &Canonical) -> Keys {
    let mut keys = Keys::new();
    add(value, "", LEVELS, &mut keys);
    if keys.len() > MOST { Keys::new() } else { keys }
}

fn add(value: &Canonical, path: &str, levels: usize, keys: &mut Keys) {
    match value {
        Canonical::Object(entries) if levels > 0 && !entries.is_empty() => {
            for (key, value) in entries {
                let path = if path.is_empty() {
                    key.clone()
                } else {
                    format!("{path}.{key}")
                };
                add(value, &path, levels - 1, keys);
            }
        }
        Canonical::List(items)
            if items.len() <= MOST
                && items
                    .iter()
                    .all(|item| matches!(item, Canonical::Object(_))) =>
        {
            for (number, item) in items.iter().enumerate() {
                add(item, &format!("{path}[{number}]"), levels, keys);
            }
        }
        _ => {
            let digest = value.digest();
            keys.insert(path.to_owned(), hexadecimal(&digest[..4]));
        }
    }
}

/// First key whose value was changed, added or removed.
pub(crate) fn first_change(was: &Keys, is: &Keys) -> Option<String> {
    if was.is_empty() {
        return None;
    }
    let mut names = was.keys().chain(is.keys());
    names.find(|name| was.get(*name) != is.get(*name)).cloned()
}

/// Encodes keys as one line: `mae.Fz=1a2b3c4d;…`. Separators in names are percent-encoded.
pub(crate) fn to_line(keys: &Keys) -> String {
    let entries = keys.iter().map(|(name, digits)| {
        let name: String = name
            .chars()
            .map(|letter| match letter {
                ';' | '=' | '%' | '"' | '\\' => format!("%{:02x}", u32::from(letter)),
                _ if letter.is_control() => format!("%{:02x}", u32::from(letter)),
                _ => letter.to_string(),
            })
            .collect();
        format!("{name}={digits}")
    });
    entries.collect::<Vec<_>>().join(";")
}

/// Parses a line made by [`to_line`]. Names remain percent-encoded.
pub(crate) fn from_line(line: &str) -> Keys {
    line.split(';')
        .filter_map(|entry| entry.split_once('='))
        .map(|(name, digits)| (name.to_owned(), digits.to_owned()))
        .collect()
}
