//! Explains why a path contains no dataset.

use std::fs;
use std::path::Path;

use crate::layout;
use crate::shell::shell_word;
use crate::text::{first_names, shown_path};

/// Names in the folder of a run: the plan file, which identifies a run, and the folder of recordings.
const RUN: [&str; 2] = ["plans.json", "recordings"];
/// Maximum number of listed names; the others are counted.
const LISTED: usize = 8;

/// Describes the content of `path`, which has no header, and names the datasets inside it.
pub(crate) fn absence(path: &Path) -> String {
    if !path.exists() {
        return "no such file or folder".to_owned();
    }
    if path.is_file() {
        return "it is a file, expected a folder".to_owned();
    }
    let missing = "it has no `dataset.toml`";
    if is_run(path) {
        return match datasets(&path.join(RUN[1])).as_slice() {
            [] => format!("{missing}: it is the folder of a run that has recorded nothing yet"),
            found => format!(
                "{missing}: it is the folder of a run; name one of its recordings: {}",
                first_names(found, LISTED)
            ),
        };
    }
    match datasets(path).as_slice() {
        [] => missing.to_owned(),
        found => format!(
            "{missing}, but contains datasets; name one: {}",
            first_names(found, LISTED)
        ),
    }
}

/// True if `path` is a folder that is neither a dataset nor a recording nor a run, and contains no dataset.
pub fn is_foreign_folder(path: &Path) -> bool {
    let has_own = [layout::HEADER, layout::JOURNAL]
        .iter()
        .any(|name| path.join(name).exists());
    path.is_dir() && !has_own && !is_run(path) && datasets(path).is_empty()
}

fn is_run(path: &Path) -> bool {
    RUN.iter().all(|name| path.join(name).exists())
}

/// Paths of the datasets in the folder at `path`, quoted for a shell and sorted.
fn datasets(path: &Path) -> Vec<String> {
    let entries = fs::read_dir(path).into_iter().flatten().flatten();
    let whole = entries.filter(|entry| entry.path().join(layout::HEADER).is_file());
    let mut names: Vec<String> = whole.map(|entry| quoted(&entry.path())).collect();
    names.sort();
    names
}

/// Path as one shell word, quoted if necessary.
pub fn quoted(path: &Path) -> String {
    shell_word(&shown_path(path))
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
    fn the_folder_of_a_run_names_its_recordings() {
        let run = folder(&[
            "plans.json",
            "recordings/1-gelsight/dataset.toml",
            "recordings/2-wm/dataset.toml",
        ]);
        let said = absence(run.path());
        assert!(
            said.contains("recordings/1-gelsight, ") && said.ends_with("recordings/2-wm"),
            "{said}"
        );
    }

    #[test]
    fn an_absent_path_a_file_and_an_empty_folder_are_distinguished() {
        let empty = folder(&["a.txt"]);
        assert_eq!(absence(&empty.path().join("b")), "no such file or folder");
        assert_eq!(
            absence(&empty.path().join("a.txt")),
            "it is a file, expected a folder"
        );
        assert_eq!(absence(empty.path()), "it has no `dataset.toml`");
    }
}
