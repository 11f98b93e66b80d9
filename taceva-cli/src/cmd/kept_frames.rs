//! Example pictures of a test with faults, as PNG files with their digests.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use taceva_core::shown;
use taceva_dataset::Digest;
use taceva_dataset::internal::{encode_png, write_durable};
use taceva_files::{Staged, sync_folder};
use taceva_stress::Examples;

use super::Usage;

/// Refuses a folder that exists, before any work.
pub(super) fn check_new(folder: &Path) -> anyhow::Result<()> {
    match fs::symlink_metadata(folder) {
        Err(_) => Ok(()),
        Ok(_) => Err(Usage::error(format!(
            "--keep-frames {}: exists already, expected a new folder",
            shown(folder)
        ))),
    }
}

/// Writes the pictures of `examples` and `digests.csv` to the new folder `folder`. After an error the folder does not exist.
pub(super) fn write(folder: &Path, examples: &Examples) -> anyhow::Result<()> {
    write_all(folder, examples).with_context(|| {
        format!(
            "cannot write {}; the results are complete without it",
            shown(folder)
        )
    })
}

fn write_all(folder: &Path, examples: &Examples) -> anyhow::Result<()> {
    let staged = Staged::beside(folder)?;
    fs::create_dir(staged.path())?;
    let mut digests = "file,digest\n".to_owned();
    for (name, frame) in examples.pictures() {
        let file = format!("{name}.png");
        let bytes = encode_png(&frame).map_err(anyhow::Error::msg)?;
        digests.push_str(&format!("{file},{}\n", Digest::of(&bytes)));
        write_durable(&staged.path().join(file), &bytes)?;
    }
    write_durable(&staged.path().join("digests.csv"), digests.as_bytes())?;
    sync_folder(staged.path())?;
    Ok(staged.put_in_place()?)
}
