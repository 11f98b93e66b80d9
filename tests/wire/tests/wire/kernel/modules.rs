//! Modules of a kernel, and their loading order.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Files of all modules below `folder`, by module name.
fn files(folder: &Path) -> BTreeMap<String, PathBuf> {
    let mut found = BTreeMap::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(folder) = waiting.pop() {
        for entry in fs::read_dir(folder).expect("a folder of modules") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                waiting.push(path);
            } else if path.extension().is_some_and(|extension| extension == "ko") {
                let name = path.file_stem().expect("a name").to_string_lossy();
                found.insert(name.replace('-', "_"), path);
            }
        }
    }
    found
}

/// Modules `wanted` below `folder` and their dependencies, each after its own dependencies: name and bytes. A module without a file is
/// built into the kernel.
pub(crate) fn in_order(folder: &Path, wanted: &[&str]) -> Vec<(String, Vec<u8>)> {
    let files = files(folder);
    let mut ordered = Vec::new();
    for name in wanted {
        add(&files, name, &mut ordered);
    }
    ordered
}

fn add(files: &BTreeMap<String, PathBuf>, name: &str, ordered: &mut Vec<(String, Vec<u8>)>) {
    let Some(path) = files
        .get(name)
        .filter(|_| ordered.iter().all(|(known, _)| known != name))
    else {
        return;
    };
    let bytes = fs::read(path).expect("a module");
    for needed in needed_by(&bytes) {
        add(files, &needed, ordered);
    }
    ordered.push((name.to_owned(), bytes));
}

/// Dependencies of a module: `depends=a,b` between zero bytes.
fn needed_by(module: &[u8]) -> Vec<String> {
    const LABEL: &[u8] = b"\0depends=";
    let Some(at) = module.windows(LABEL.len()).position(|bytes| bytes == LABEL) else {
        return Vec::new();
    };
    let text = module[at + LABEL.len()..].split(|byte| *byte == 0).next();
    let text = String::from_utf8_lossy(text.unwrap_or_default()).into_owned();
    let names = text.split(',').filter(|name| !name.is_empty());
    names.map(|name| name.replace('-', "_")).collect()
}
