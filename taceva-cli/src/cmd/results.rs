//! Results that are there already, read for the commands that look at them.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use taceva_report::{Listing, Samples, Study, catalogue};

use super::Usage;
use crate::args::Format;

/// The studies of every result: of files, or of the catalogue where no file has that name.
pub(super) fn read_all(named: &[std::path::PathBuf]) -> anyhow::Result<Vec<Study>> {
    let mut studies = Vec::new();
    for path in named {
        studies.extend(read(path)?);
    }
    Ok(studies)
}

/// The studies of one result, with the samples that lie beside it.
pub(super) fn read(path: &Path) -> anyhow::Result<Vec<Study>> {
    if !path.exists() {
        let name = path.to_string_lossy();
        let sensor = catalogue::find(&name).ok_or_else(|| {
            Usage::error(format!(
                "`{}`: no such file, and no such name in the catalogue; see taceva catalogue list",
                taceva_report::escape_terminal(&name)
            ))
        })?;
        return Ok(vec![sensor.as_study()]);
    }
    let text =
        fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    let mut studies = Study::read(&text).with_context(|| path.display().to_string())?;
    let samples = path.with_extension("samples.csv");
    if let ([study], true) = (studies.as_mut_slice(), samples.is_file()) {
        let table = fs::read_to_string(&samples)
            .with_context(|| format!("cannot read {}", samples.display()))?;
        let read = Samples::read(&table).with_context(|| samples.display().to_string())?;
        study.samples = Some(read);
    }
    Ok(studies)
}

/// Rows in the form asked for; `json` makes the one that is no table.
pub(super) fn rendered(listing: &Listing, format: Format, json: impl FnOnce() -> String) -> String {
    match format {
        Format::Text => listing.text(),
        Format::Json => json(),
        Format::Csv => listing.csv(),
        Format::Md => listing.markdown(),
        Format::Tex => listing.latex(),
    }
}
