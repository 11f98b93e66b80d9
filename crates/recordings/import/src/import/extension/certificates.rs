//! Compares the certificates of a dataset with those of the rows that are added to it.

use std::collections::BTreeSet;

use serde_json::Value;
use taceva_core::{Certificate, Instrument, Traceability, shown};
use taceva_dataset::{Dataset, RecordingFacts};

use super::Addition;
use crate::error::ImportError;

/// Rejects rows whose labels have a different certificate than the labels of the dataset, or lack a certificate that the labels of the dataset have.
pub(super) fn check_certificates(
    before: &Dataset,
    facts: &RecordingFacts,
    added: &Addition,
) -> Result<(), ImportError> {
    if added.new_certificate {
        return Ok(());
    }
    for instrument in Instrument::ALL {
        let own = certificates(&before.header().traceability, instrument);
        let new = certificates(&facts.traceability, instrument);
        let Some(other) = new.iter().find(|certificate| !own.contains(certificate)) else {
            continue;
        };
        let key = format!("{instrument}.certificate");
        let changed = other.and_then(|other| changed(&own, other, &key));
        let problem = changed.unwrap_or_else(|| {
            format!(
                "`{key}` is {} in the dataset and {} in the map",
                in_words(&own),
                in_words(&new)
            )
        });
        return Err(ImportError::request(
            before.path(),
            format!(
                "{problem}; add these rows with `--new-certificate`, or import them as a separate dataset"
            ),
        ));
    }
    Ok(())
}

/// Certificates of `instrument`; `None` for labels without a certificate.
fn certificates(of: &[Traceability], instrument: Instrument) -> Vec<Option<&Certificate>> {
    let of = of.iter().filter(|of| of.instrument == instrument);
    let certificates: Vec<Option<&Certificate>> = of.map(|of| of.certificate.as_ref()).collect();
    match certificates.is_empty() {
        true => vec![None],
        false => certificates,
    }
}

/// Difference between `new` and the certificate of the dataset with the same number; `None` if equal or if no number matches.
fn changed(own: &[Option<&Certificate>], new: &Certificate, key: &str) -> Option<String> {
    let mut own = own.iter().flatten();
    let before = own.find(|own| own.number == new.number)?;
    let [before, after] = [*before, new].map(|certificate| serde_json::to_value(certificate).ok());
    let difference = first_difference(&before?, &after?, key)?;
    let number = shown(&new.number);
    Some(format!(
        "{difference} in the map, although both certificates have the number `{number}`"
    ))
}

/// First key that differs, with both values.
fn first_difference(before: &Value, after: &Value, key: &str) -> Option<String> {
    if before == after {
        return None;
    }
    if let (Value::Object(before), Value::Object(after)) = (before, after) {
        let names: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
        return names.into_iter().find_map(|name| {
            let [before, after] =
                [before, after].map(|table| table.get(name).unwrap_or(&Value::Null));
            first_difference(before, after, &format!("{key}.{name}"))
        });
    }
    let [before, after] = [before, after].map(value_in_words);
    Some(format!("`{key}` is {before} in the dataset and {after}"))
}

fn value_in_words(value: &Value) -> String {
    match value {
        Value::Null => "absent".to_owned(),
        Value::String(text) => format!("`{}`", shown(text)),
        other => format!("`{}`", shown(&other.to_string())),
    }
}

fn in_words(certificates: &[Option<&Certificate>]) -> String {
    let words = certificates.iter().map(|certificate| match certificate {
        Some(certificate) => format!("`{}`", shown(&certificate.number)),
        None => "absent".to_owned(),
    });
    words.collect::<Vec<_>>().join(" and ")
}
