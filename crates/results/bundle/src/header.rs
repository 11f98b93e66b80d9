//! Headers of datasets, matched with results by the digests that the results name.

use taceva_core::shown;
use taceva_results::EvaluationReport;

/// Digests of the datasets and recordings that `reports` name.
pub(crate) fn known(reports: &[EvaluationReport]) -> Vec<&str> {
    let mut known: Vec<&str> = Vec::new();
    for report in reports {
        let own = &report.provenance;
        known.extend(own.dataset.as_deref());
        let recordings = own.recordings.iter();
        known.extend(recordings.map(|recording| recording.digest.as_str()));
    }
    known
}

/// Digest in the header `text`, including the tasks if the dataset has tasks; empty without a digest.
///
/// # Errors
/// The reason why the text is not TOML.
pub(crate) fn digest(text: &str) -> Result<String, String> {
    let table: toml::Table =
        toml::from_str(text).map_err(|error| shown(error.message()).to_string())?;
    let digest = table.get("digest_with_tasks").or(table.get("digest"));
    let digest = digest.and_then(toml::Value::as_str);
    Ok(digest.unwrap_or_default().to_owned())
}

/// Fault of a header whose dataset is not in `known`; `None` for a known dataset.
pub(crate) fn fault(digest: &str, known: &[&str]) -> Option<String> {
    (!known.contains(&digest)).then(|| {
        format!(
            "the dataset {} is not one of the results: {}",
            shown(digest),
            shown(&known.join(", "))
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_with_tasks_belongs_to_results_by_its_digest_with_tasks() {
        assert_eq!(digest("digest = \"a\"\n"), Ok("a".to_owned()));
        let text = "digest = \"a\"\ndigest_with_tasks = \"b\"\n[task.slip]\nkind = \"event\"\n";
        assert_eq!(digest(text), Ok("b".to_owned()));
    }
}
