//! Addition of a bundle to a catalogue: verified first, then its manifest and the rows of its numbers are written.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use taceva_files::Staged;
use taceva_report::catalogue::{Measured, Origin, Sensor, rows_text};

use super::entry_place::EntryPlace;
use super::error::CatalogueFolderError;
use super::folder::{BUNDLES, EntryFile, entry_files, manifest_path, manifest_texts, write};
use super::request::AddRequest;
use super::submission::{Submission, results_digest};
use crate::layout::MOST_TEXT;
use crate::manifest::Manifest;

/// Result of adding a bundle to a catalogue.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Addition {
    /// Entries that received rows, as paths in the catalogue.
    pub entries: Vec<String>,
    /// Digest of the bundle's manifest.
    pub bundle: String,
    /// Number of rows of the bundle in tables `[[measured]]`.
    pub measured: u64,
    /// Number of rows of the bundle in tables `[[unknown]]`.
    pub unknown: u64,
    /// Number of rows of the bundle in tables `[[simulated]]`.
    pub simulated: u64,
    /// Lowest verification level of the rows.
    pub level: String,
    /// Statement on samples that were not measured.
    pub badge: Option<String>,
}

/// Adds a bundle to a catalogue. Appends the new rows to the entries, whose existing text is unchanged. Each file is replaced atomically.
///
/// ```no_run
/// use std::path::Path;
/// use taceva_bundle::{AddRequest, add_to_catalogue, check_catalogue, write_index};
///
/// let root = Path::new("tactile-results");
/// let added = add_to_catalogue(&AddRequest::new(Path::new("result.tar.gz"), root))?;
/// println!("{} measured numbers, verified to the level {}", added.measured, added.level);
/// let check = check_catalogue(root)?;
/// if check.findings.is_empty() {
///     write_index(root, &check)?;
/// }
/// # Ok::<(), taceva_bundle::CatalogueFolderError>(())
/// ```
///
/// # Errors
/// [`CatalogueFolderError`] if the bundle is not verified, is a draft or is in the catalogue already, if an entry is invalid, or if a file
/// cannot be written. After an error the catalogue is unchanged, unless only some of several entries could be written. Repeat the call to write
/// the other entries.
pub fn add(request: &AddRequest) -> Result<Addition, CatalogueFolderError> {
    let submission = Submission::read(request)?;
    let root = request.catalogue.as_path();
    if !root.exists() {
        // Checks first, so that a refusal creates no folder.
        changed(root, &submission, request)?;
        fs::create_dir_all(root).map_err(CatalogueFolderError::file(root))?;
    }
    let place = root.join(BUNDLES);
    // Locks the catalogue, because concurrent additions would lose each other's rows.
    let turn = Staged::alone(&place).map_err(CatalogueFolderError::file(&place))?;
    let Some(_turn) = turn else {
        let problem = "another process is adding a bundle; run this command again when that process has ended";
        return Err(CatalogueFolderError::refused(root, problem));
    };
    let texts = changed(root, &submission, request)?;
    write(root, &manifest_path(&submission.digest), &submission.text)?;
    for (path, text) in &texts {
        write(root, path, text)?;
    }
    Ok(added(&submission, texts.into_keys().collect()))
}

/// Texts of the entries with the rows of the bundle, by path.
fn changed(
    root: &Path,
    submission: &Submission,
    request: &AddRequest,
) -> Result<BTreeMap<String, String>, CatalogueFolderError> {
    let entries = entry_files(root)?;
    check_new(root, submission, request)?;
    let mut texts: BTreeMap<String, String> = BTreeMap::new();
    for (name, rows) in &submission.sensors {
        let mut place = EntryPlace::of(name, &entries, &request.bundle)?;
        if !has_rows(&entries, &place.path, &submission.digest) {
            // Two names of one sensor share one entry.
            if let Some(text) = texts.remove(&place.path) {
                place.text = text;
            }
            let text = appended(&place, rows, request)?;
            texts.insert(place.path, text);
        }
    }
    if texts.is_empty() {
        let problem = "this bundle is already in the catalogue, expected a new bundle";
        return Err(CatalogueFolderError::refused(&request.bundle, problem));
    }
    Ok(texts)
}

/// Rejects a bundle with the results of another bundle in the catalogue.
fn check_new(
    root: &Path,
    submission: &Submission,
    request: &AddRequest,
) -> Result<(), CatalogueFolderError> {
    let own = manifest_path(&submission.digest);
    let results = results_digest(&submission.manifest);
    for file in manifest_texts(root)? {
        let refused = |problem: String| {
            let problem = format!("{problem}; restore it, or remove it with its rows");
            CatalogueFolderError::refused(&root.join(&file.path), problem)
        };
        let text = file.text.map_err(refused)?;
        // Skips the seals: `check` verifies them, and every addition would compute all of them.
        let known: Manifest =
            serde_json::from_str(&text).map_err(|error| refused(error.to_string()))?;
        if file.path != own && results_digest(&known) == results {
            let problem = format!(
                "its results are already in the catalogue, from {}; expected new results",
                file.path
            );
            return Err(CatalogueFolderError::refused(&request.bundle, problem));
        }
    }
    Ok(())
}

/// True if the entry at `path` has rows of the bundle.
fn has_rows(entries: &[EntryFile], path: &str, bundle: &str) -> bool {
    let of_path = entries.iter().find(|entry| entry.path == path);
    of_path.is_some_and(|entry| {
        let mut rows = entry.sensor.all_rows();
        rows.any(|row| row.bundle == bundle)
    })
}

/// Text of the entry with the rows at its end.
fn appended(
    place: &EntryPlace,
    rows: &[Measured],
    request: &AddRequest,
) -> Result<String, CatalogueFolderError> {
    let rows = rows_text(rows)
        .map_err(|error| CatalogueFolderError::refused(&request.bundle, error.to_string()))?;
    let text = format!("{}\n\n{}\n", place.text.trim_end(), rows.trim_end());
    if text.len() as u64 > MOST_TEXT {
        let problem = format!(
            "{} would have {} bytes: expected at most {MOST_TEXT}; keep the bundle in another catalogue",
            place.path,
            text.len()
        );
        return Err(CatalogueFolderError::refused(&request.bundle, problem));
    }
    Sensor::read(&place.path, &text)?;
    Ok(text)
}

fn added(submission: &Submission, entries: Vec<String>) -> Addition {
    let rows = || submission.sensors.values().flatten();
    let count = |origin: Origin| {
        let of_origin = rows().filter(|row| Origin::of_source(&row.source) == Some(origin));
        of_origin.count() as u64
    };
    let least = rows().min_by_key(|row| row.depth());
    Addition {
        entries,
        bundle: submission.digest.clone(),
        measured: count(Origin::Measured),
        unknown: count(Origin::Unknown),
        simulated: count(Origin::Simulated),
        level: least.map_or_else(String::new, |row| row.verified.clone()),
        badge: submission.manifest.badge.clone(),
    }
}
