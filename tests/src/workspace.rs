//! Files of the workspace, and its description by cargo.

use std::path::{Path, PathBuf};

use cargo_metadata::{Metadata, MetadataCommand};

/// Path of the workspace folder.
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent()
        .expect("the tests crate lies in the workspace")
        .to_owned()
}

/// Reads the text file at `relative` in the workspace.
///
/// # Panics
/// If the file cannot be read, which ends the test.
pub fn read(relative: &str) -> String {
    let path = root().join(relative);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Cargo's metadata of the workspace, without its dependencies.
///
/// # Panics
/// If cargo fails, which ends the test.
pub fn metadata() -> Metadata {
    MetadataCommand::new()
        .manifest_path(root().join("Cargo.toml"))
        .no_deps()
        .exec()
        .expect("cargo metadata of the workspace that is being tested")
}
