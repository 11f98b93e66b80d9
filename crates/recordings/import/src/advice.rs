//! The command that imports a folder which is no dataset yet.

use std::fs;
use std::path::Path;

use taceva_dataset::internal::{is_foreign_folder, quoted, shown};

use crate::layouts::Preset;

/// Returns the command that imports the folder at `path`, if it has a known layout or a table.
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
    let command =
        |layout: &str| format!("import it first: taceva import {folder} {layout} --out DATASET");
    if let Some(preset) = Preset::recognised(path) {
        return Some(command(&format!("--preset {}", preset.name())));
    }
    tables(path).first().map(|table| {
        format!(
            "{}, where MAP.toml says which column of {} is which channel",
            command("--map MAP.toml"),
            shown(table)
        )
    })
}

/// CSV tables in the folder at `path` and in its direct subfolders, sorted by name.
fn tables(path: &Path) -> Vec<String> {
    let inside = |folder: &Path| fs::read_dir(folder).into_iter().flatten().flatten();
    let deeper = inside(path).filter(|entry| entry.path().is_dir());
    let deeper = deeper.flat_map(|entry| inside(&entry.path()));
    let all = inside(path).chain(deeper).map(|entry| entry.path());
    let mut names: Vec<String> = all
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
        })
        .filter_map(|table| {
            Some(
                table
                    .strip_prefix(path)
                    .ok()?
                    .to_string_lossy()
                    .into_owned(),
            )
        })
        .collect();
    names.sort_by_key(|name| (name.matches('/').count(), name.clone()));
    names
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
    fn a_known_layout_is_answered_with_its_preset_and_another_with_its_table() {
        for (file, part) in [
            ("targets.csv", "--preset bristol --out DATASET"),
            (
                "annotations/probe_data.csv",
                "--preset py3dcal --out DATASET",
            ),
            (
                "labels.csv",
                "--map MAP.toml --out DATASET, where MAP.toml says which column of labels.csv",
            ),
            ("deep/labels.csv", "which column of deep/labels.csv"),
        ] {
            let folder = folder(&[file]);
            let said = advice(folder.path()).expect("a command");
            assert!(
                said.contains("taceva import ") && said.contains(part),
                "{said}"
            );
        }
    }
}
