//! Repeats the verification of bundles whose numbers are in a catalogue.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_files::seal::digest_of_bytes;

use super::error::CatalogueFolderError;
use super::finding::CatalogueFinding;
use super::folder::manifest_path;
use super::submission::check_outcome;
use crate::error::BundleError;
use crate::layout::{MANIFEST, MOST_BYTES, MOST_MANIFEST};
use crate::source::Source;
use crate::verify::{VerifyRequest, verify};

/// Verifies `bundles` to the deepest level that their files allow. Each manifest must equal the copy in the catalogue at `root`, byte for byte.
///
/// The level of a claim in the manifest limits the level of its row. A row therefore cannot state a deeper level than its bundle reaches.
///
/// # Errors
/// [`CatalogueFolderError::Bundle`] for a bundle that cannot be read. Damaged bundles and differing numbers are listed instead.
pub fn check_bundles(
    root: &Path,
    bundles: &[PathBuf],
    jobs: NonZeroUsize,
) -> Result<Vec<CatalogueFinding>, CatalogueFolderError> {
    let mut findings = Vec::new();
    for bundle in bundles {
        let named = shown(bundle).to_string();
        let mut asked = VerifyRequest::new(bundle);
        asked.jobs = jobs;
        if let Err(error) = check_outcome(&verify(&asked)?, bundle) {
            let message = error.to_string();
            let problem = message.strip_prefix(&format!("{named}: "));
            findings.push(CatalogueFinding::new(&named, problem.unwrap_or(&message)));
            continue;
        }
        let text = Source::open(bundle, MOST_BYTES)?.text(MANIFEST, MOST_MANIFEST);
        let text = text.map_err(BundleError::Damaged)?;
        let path = manifest_path(&digest_of_bytes(text.as_bytes()));
        if !root.join(&path).is_file() {
            let problem = format!(
                "its manifest is not in the catalogue, expected {path}; add the bundle by `taceva catalogue add`"
            );
            findings.push(CatalogueFinding::new(&named, problem));
        }
    }
    Ok(findings)
}
