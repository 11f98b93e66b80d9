//! Suggests the command that begins the import of a folder that is not yet a dataset.

use std::fs;
use std::path::Path;

use taceva_dataset::internal::{is_foreign_folder, quoted};

use crate::layouts::Preset;

/// Returns the command that begins the import of the folder at `path`: with the preset of its layout, or with a map to write first. `None` for a dataset, a
/// run, a folder of datasets and an empty folder.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("targets.csv"), "x\n")?;
/// let advice = taceva_import::advice(folder.path()).ok_or("a known layout")?;
/// assert!(advice.contains("--preset bristol --out DATASET"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn advice(path: &Path) -> Option<String> {
    if !is_foreign_folder(path) {
        return None;
    }
    let folder = quoted(path);
    if let Some(preset) = Preset::recognised(path) {
        let preset = preset.name();
        return Some(format!(
            "import it first: taceva import {folder} --preset {preset} --out DATASET"
        ));
    }
    fs::read_dir(path).ok()?.next()?.ok()?;
    Some(format!("write a map first: taceva init recording {folder}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for file in files {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().expect("inside")).expect("made");
            fs::write(path, "x").expect("written");
        }
        folder
    }

    #[test]
    fn a_known_layout_is_answered_with_its_preset_and_another_with_the_draft_of_a_map() {
        for (file, part) in [
            (
                "targets.csv",
                "import it first: taceva import FOLDER --preset bristol --out DATASET",
            ),
            (
                "annotations/probe_data.csv",
                "import it first: taceva import FOLDER --preset py3dcal --out DATASET",
            ),
            (
                "deep/labels.csv",
                "write a map first: taceva init recording FOLDER",
            ),
        ] {
            let folder = folder(&[file]);
            let said = advice(folder.path()).expect("a command");
            assert_eq!(said.replace(&quoted(folder.path()), "FOLDER"), part);
        }
        let empty = tempfile::tempdir().expect("a folder");
        assert_eq!(advice(empty.path()), None);
    }
}
