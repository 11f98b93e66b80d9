//! Summary of a map for the header of the dataset: labels, joins, pictures and classes.

mod columns;
mod tables;

use std::borrow::Cow;

use super::map::ImportMap;
use crate::error::ImportError;
use crate::source_folder::SourceFolder;
use taceva_dataset::Digest;
use taceva_dataset::internal::Mapping;

/// Maximum number of taxel columns that a header names, and maximum length of a name, bytes. A digest represents the rest.
const NAMED: usize = 64;
const NAME_BYTES: usize = 256;

/// Summary of `map` for the header.
///
/// # Errors
/// [`ImportError`] if the file of a matrix cannot be read.
pub(super) fn mapping(map: &ImportMap, folder: &SourceFolder) -> Result<Mapping, ImportError> {
    Ok(Mapping {
        columns: columns::columns(map, folder)?,
        joins: map.joins.iter().map(tables::join).collect(),
        pictures: map.frames.iter().map(tables::pictures).collect(),
        classes: tables::classes(map),
        rotations: map
            .rotations
            .iter()
            .map(|rotation| rotation.channels.clone())
            .collect(),
    })
}

/// Shortens `names` to the limits of a header.
fn short(names: &[String]) -> Vec<String> {
    let (named, others) = names.split_at(names.len().min(NAMED));
    let named = named.iter().map(|name| short_name(name).into_owned());
    let others = (!others.is_empty()).then(|| {
        let digest = Digest::of(others.join("\n").as_bytes());
        format!("… and {} others, {digest}", others.len())
    });
    named.chain(others).collect()
}

fn short_name(name: &str) -> Cow<'_, str> {
    if name.len() <= NAME_BYTES {
        return name.into();
    }
    let begin: String = name.chars().take(NAME_BYTES / 4).collect();
    format!("{begin}… {}", Digest::of(name.as_bytes())).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_columns_and_long_names_stay_short_and_differ_where_they_did() {
        let names = |last: &str| -> Vec<String> {
            let names = (0..5000).map(|number| format!("taxel {number}"));
            names.chain([last.repeat(9999)]).collect()
        };
        let (one, other) = (short(&names("a")), short(&names("b")));
        assert!(one.join("").len() < 2000, "{one:?}");
        assert_ne!(one, other);
        assert_eq!(one[..NAMED], other[..NAMED]);
        assert_ne!(short(&["a".repeat(999)]), short(&["a".repeat(998)]));
        assert_eq!(short(&["force".to_owned()]), ["force"]);
    }
}
