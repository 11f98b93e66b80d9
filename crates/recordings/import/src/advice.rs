//! Advice where a folder is named that is no dataset.

use std::fs;
use std::path::Path;

use crate::preset::layouts::Preset;
use crate::text::{shown, shown_path};

/// The file of the plans of a run, by which its folder is recognised, and the folder of its recordings.
const RUN: [&str; 2] = ["plans.json", "recordings"];
/// How many names are listed; the others are counted.
const LISTED: usize = 8;

/// What stands at `path`, which has no header, and the command that makes a dataset of it or names the one that is there.
pub(crate) fn advice(path: &Path) -> String {
    if !path.exists() {
        return "there is nothing of that name".to_owned();
    }
    if path.is_file() {
        return "it is a file, and a dataset is a folder".to_owned();
    }
    let missing = "it has no `dataset.toml`";
    if RUN.iter().all(|name| path.join(name).exists()) {
        let recordings = path.join(RUN[1]);
        return match datasets(&recordings).as_slice() {
            [] => format!("{missing}: it is the folder of a run that has recorded nothing yet"),
            found => format!(
                "{missing}: it is the folder of a run; name one of its recordings: {}",
                listed(found)
            ),
        };
    }
    let found = datasets(path);
    if !found.is_empty() {
        return format!("{missing}, but datasets are in it: {}", listed(&found));
    }
    let line = |layout: &str| {
        let folder = quoted(path);
        format!("{missing}; import it first: taceva import {folder} {layout} --out DATASET")
    };
    if let Some(preset) = Preset::recognised(path) {
        return line(&format!("--preset {}", preset.name()));
    }
    match tables(path).first() {
        Some(table) => format!(
            "{}, where MAP.toml says which column of {} is which channel",
            line("--map MAP.toml"),
            shown(table)
        ),
        None => missing.to_owned(),
    }
}

/// The datasets in the folder at `path`, sorted by name.
fn datasets(path: &Path) -> Vec<String> {
    let entries = fs::read_dir(path).into_iter().flatten().flatten();
    let whole = entries.filter(|entry| entry.path().join(crate::layout::HEADER).is_file());
    let mut names: Vec<String> = whole.map(|entry| quoted(&entry.path())).collect();
    names.sort();
    names
}

/// The CSV tables in the folder at `path` or in a folder of it, sorted by name.
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

fn listed(names: &[String]) -> String {
    let more = names.len().saturating_sub(LISTED);
    let first = names
        .iter()
        .take(LISTED)
        .cloned()
        .collect::<Vec<_>>()
        .join(", ");
    match more {
        0 => first,
        more => format!("{first} and {more} more"),
    }
}

/// A path as it can be typed in a shell.
fn quoted(path: &Path) -> String {
    let text = shown_path(path);
    let is_plain = |letter: char| letter.is_alphanumeric() || "/._-+,@%".contains(letter);
    match text.chars().all(is_plain) {
        true => text,
        false => format!("'{}'", text.replace('\'', "'\\''")),
    }
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
            let said = advice(folder.path());
            assert!(
                said.contains("taceva import ") && said.contains(part),
                "{said}"
            );
        }
    }

    #[test]
    fn the_folder_of_a_run_names_its_recordings() {
        let run = folder(&[
            "plans.json",
            "recordings/1-gelsight/dataset.toml",
            "recordings/2-wm/dataset.toml",
        ]);
        let said = advice(run.path());
        assert!(
            said.contains("recordings/1-gelsight, ") && said.ends_with("recordings/2-wm"),
            "{said}"
        );
    }

    #[test]
    fn an_absent_path_a_file_and_an_empty_folder_are_distinguished() {
        let empty = folder(&["a.txt"]);
        assert_eq!(
            advice(&empty.path().join("b")),
            "there is nothing of that name"
        );
        assert_eq!(
            advice(&empty.path().join("a.txt")),
            "it is a file, and a dataset is a folder"
        );
        assert_eq!(advice(empty.path()), "it has no `dataset.toml`");
    }
}
