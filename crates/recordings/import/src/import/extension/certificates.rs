//! Certificates of a dataset and of the rows that are added to it.

use taceva_core::{Instrument, Traceability, shown};
use taceva_dataset::{Dataset, RecordingFacts};

use super::Addition;
use crate::error::ImportError;

/// Refuses rows whose labels have another certificate than those of the dataset, or none in its place.
pub(super) fn check_certificates(
    before: &Dataset,
    facts: &RecordingFacts,
    added: &Addition,
) -> Result<(), ImportError> {
    if added.new_certificate {
        return Ok(());
    }
    for instrument in Instrument::ALL {
        let own = numbers(&before.header().traceability, instrument);
        let new = numbers(&facts.traceability, instrument);
        if new.iter().all(|number| own.contains(number)) {
            continue;
        }
        return Err(ImportError::request(
            before.path(),
            format!(
                "`{instrument}.certificate` is {} in the dataset and {} in the map; add these rows with `--new-certificate`, or import \
                 them as a separate dataset",
                in_words(&own),
                in_words(&new)
            ),
        ));
    }
    Ok(())
}

/// Numbers of the certificates of `instrument`; `None` for labels without one.
fn numbers(of: &[Traceability], instrument: Instrument) -> Vec<Option<&str>> {
    let of = of.iter().filter(|of| of.instrument == instrument);
    let certificates = of.map(|of| of.certificate.as_ref());
    let numbers: Vec<Option<&str>> = certificates
        .map(|certificate| certificate.map(|certificate| certificate.number.as_str()))
        .collect();
    match numbers.is_empty() {
        true => vec![None],
        false => numbers,
    }
}

fn in_words(numbers: &[Option<&str>]) -> String {
    let words = numbers.iter().map(|number| match number {
        Some(number) => format!("`{}`", shown(*number)),
        None => "absent".to_owned(),
    });
    words.collect::<Vec<_>>().join(" and ")
}
