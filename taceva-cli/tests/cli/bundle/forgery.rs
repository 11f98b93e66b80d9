//! Edits of a bundle that are hidden by new digests and seals.

use std::fs;
use std::path::Path;

use serde_json::Value;
use taceva_files::seal::{digest_of_bytes, json};

use crate::support::Bench;

/// Replaces the text of the file at `path`.
pub(crate) fn edit(path: &Path, change: impl FnOnce(String) -> String) {
    let text = fs::read_to_string(path).expect("a text");
    let changed = change(text.clone());
    assert_ne!(changed, text, "{} has nothing to change", path.display());
    fs::write(path, changed).expect("room");
}

/// Seals the file at `path` as it is.
pub(crate) fn accept(path: &Path) {
    let text = fs::read_to_string(path).expect("a text");
    let sealed = json::reseal(&text, "2026-11-28", "forged").expect("JSON");
    fs::write(path, sealed).expect("room");
}

/// The manifest of the bundle in `folder`.
pub(crate) fn manifest(bench: &Bench, folder: &str) -> Value {
    let text = fs::read_to_string(bench.path(folder).join("bundle.json")).expect("written");
    serde_json::from_str(&text).expect("JSON")
}

/// Sets the version of TacEva in `manifest` to another one. Generated files of other versions are not compared.
pub(super) fn of_another_version(manifest: &mut Value) {
    manifest["taceva"] = "0.0.0".into();
}

/// Changes the manifest in `folder`, then states the present size and digest of every file in it.
pub(crate) fn relist(bench: &Bench, folder: &str, change: impl FnOnce(&mut Value)) {
    let mut manifest = manifest(bench, folder);
    let root = bench.path(folder);
    for file in manifest["files"].as_array_mut().expect("files") {
        let name = file["path"].as_str().expect("a path").to_owned();
        let bytes = fs::read(root.join(name)).expect("there");
        file["size"] = bytes.len().into();
        file["sha256"] = digest_of_bytes(&bytes).into();
    }
    change(&mut manifest);
    manifest.as_object_mut().expect("an object").remove("seal");
    let text = serde_json::to_string_pretty(&manifest).expect("JSON");
    let sealed = json::seal(&text).expect("an object");
    fs::write(root.join("bundle.json"), sealed).expect("room");
}
