//! Files of a catalogue on disk. A link is neither read nor written.

use std::fs;
use std::path::Path;

use taceva_files::replace;
use taceva_report::catalogue::Sensor;

use super::error::CatalogueFolderError;
use crate::layout::{MOST_MANIFEST, MOST_TEXT};

/// Folder of the entries.
pub(super) const ENTRIES: &str = "entries";
/// Folder of the manifests.
pub(super) const BUNDLES: &str = "bundles";
/// Filename extension of an entry.
const TOML: &str = ".toml";
/// Filename extension of a manifest.
const JSON: &str = ".json";

/// Text of a file in a catalogue.
pub(super) struct TextFile {
    /// Path in the catalogue: `entries/gelsight.toml`.
    pub(super) path: String,
    /// Name without its extension.
    pub(super) stem: String,
    /// Text, or the reason why the file cannot be read.
    pub(super) text: Result<String, String>,
}

/// Entry of a catalogue.
pub(super) struct EntryFile {
    pub(super) path: String,
    pub(super) text: String,
    pub(super) sensor: Sensor,
}

/// Entries of the catalogue at `root`.
pub(super) fn entry_files(root: &Path) -> Result<Vec<EntryFile>, CatalogueFolderError> {
    let mut entries = Vec::new();
    for TextFile { path, text, .. } in entry_texts(root)? {
        let refused = |problem: String| CatalogueFolderError::refused(&root.join(&path), problem);
        let text = text.map_err(refused)?;
        let sensor = Sensor::read(&path, &text)?;
        entries.push(EntryFile { path, text, sensor });
    }
    Ok(entries)
}

/// Texts of the entries, sorted by file name.
pub(super) fn entry_texts(root: &Path) -> Result<Vec<TextFile>, CatalogueFolderError> {
    texts(root, ENTRIES, TOML, MOST_TEXT)
}

/// Texts of the manifests, sorted by file name.
pub(super) fn manifest_texts(root: &Path) -> Result<Vec<TextFile>, CatalogueFolderError> {
    texts(root, BUNDLES, JSON, MOST_MANIFEST)
}

/// Path of the manifest with the digest `digest`, which is `sha256:` and digits.
pub(super) fn manifest_path(digest: &str) -> String {
    let digits = digest.strip_prefix("sha256:").unwrap_or(digest);
    format!("{BUNDLES}/{digits}{JSON}")
}

/// Path of the entry with the name `slug`.
pub(super) fn entry_path(slug: &str) -> String {
    format!("{ENTRIES}/{slug}{TOML}")
}

/// Rejects a folder that has neither a folder of entries nor a folder of bundles.
pub(super) fn check_catalogue_folder(root: &Path) -> Result<(), CatalogueFolderError> {
    fs::metadata(root).map_err(CatalogueFolderError::file(root))?;
    if !root.join(ENTRIES).is_dir() && !root.join(BUNDLES).is_dir() {
        let problem = format!(
            "not a catalogue: expected a folder with {ENTRIES}/ and {BUNDLES}/; `taceva catalogue add BUNDLE --to DIR` makes one"
        );
        return Err(CatalogueFolderError::refused(root, problem));
    }
    Ok(())
}

/// Writes a file of a catalogue, as a whole or not at all. Creates its folder if missing.
pub(super) fn write(root: &Path, path: &str, text: &str) -> Result<(), CatalogueFolderError> {
    if let Some((folder, _)) = path.split_once('/') {
        check_no_link(root, folder)?;
        let folder = root.join(folder);
        fs::create_dir_all(&folder).map_err(CatalogueFolderError::file(&folder))?;
    }
    check_no_link(root, path)?;
    let target = root.join(path);
    replace(&target, |staged| fs::write(staged, text)).map_err(CatalogueFolderError::file(&target))
}

/// Rejects a link at `path` in the catalogue.
fn check_no_link(root: &Path, path: &str) -> Result<(), CatalogueFolderError> {
    let target = root.join(path);
    let is_link = fs::symlink_metadata(&target).is_ok_and(|about| about.is_symlink());
    match is_link {
        true => Err(CatalogueFolderError::refused(
            &target,
            "a link, which is not followed; expected a file or a folder of the catalogue itself",
        )),
        false => Ok(()),
    }
}

/// Files in `folder` with this filename extension, sorted by name; empty if the folder does not exist.
fn texts(
    root: &Path,
    folder: &str,
    ending: &str,
    most: u64,
) -> Result<Vec<TextFile>, CatalogueFolderError> {
    check_no_link(root, folder)?;
    let place = root.join(folder);
    if !place.is_dir() {
        return Ok(Vec::new());
    }
    let mut files = Vec::new();
    for entry in fs::read_dir(&place).map_err(CatalogueFolderError::file(&place))? {
        let entry = entry.map_err(CatalogueFolderError::file(&place))?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let Some(stem) = name.strip_suffix(ending) else {
            continue;
        };
        files.push(TextFile {
            path: format!("{folder}/{name}"),
            stem: stem.to_owned(),
            text: text_of(&entry.path(), most),
        });
    }
    files.sort_by(|one, other| one.path.cmp(&other.path));
    Ok(files)
}

/// Text of the regular file at `path`, of at most `most` bytes.
fn text_of(path: &Path, most: u64) -> Result<String, String> {
    let about = fs::symlink_metadata(path).map_err(|error| error.to_string())?;
    if !about.is_file() {
        return Err("a link or a special file, expected a regular file".to_owned());
    }
    if about.len() > most {
        return Err(format!("{} bytes, expected at most {most}", about.len()));
    }
    fs::read_to_string(path).map_err(|error| error.to_string())
}
