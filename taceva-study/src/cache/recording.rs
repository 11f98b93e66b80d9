//! Recordings that are kept: folders whose files are shared by links.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use taceva_dataset::{Dataset, Digest};

use super::tree::link;
use super::{Cache, Key, remove};
use crate::durable::sync_folder;

impl Cache {
    /// The recording kept under `key`, put at `place`, where nothing is; `None` if there is none or it is not what was written.
    pub(super) fn take_recording(&self, key: &Key, place: &Path) -> Option<Dataset> {
        let entry = self.entry(key);
        let beside = beside(place)?;
        let linked = remove(&beside).and_then(|()| link(&entry, &beside));
        match linked {
            Err(error) if error.kind() == io::ErrorKind::NotFound && !entry.exists() => {}
            // Nothing is wrong with the entry where there is no room for links.
            Err(error) => self.note_unreadable(&entry, &error),
            Ok(()) => match check(&beside) {
                Ok(()) => return moved(&beside, place),
                Err(problem) => self.discard(key, &problem),
            },
        }
        // Nobody reads a name that begins with a dot, should it stay.
        drop(remove(&beside));
        None
    }

    /// Keeps the closed recording at `place` under `key`.
    pub(super) fn keep_recording(&self, key: &Key, place: &Path) {
        if !self.entry(key).exists() {
            self.put(key, |beside| link(place, beside));
        }
    }
}

/// What is wrong with the recording at `path`, if anything is: header and table as they are opened, and every frame by its digest.
///
/// Frames would else be read where no stage that reads them is kept, and then it is too late to press again.
fn check(path: &Path) -> Result<(), String> {
    let dataset = Dataset::open(path).map_err(|error| error.to_string())?;
    let header = dataset.header().frames.iter();
    let references = header.filter_map(|frames| frames.reference.as_ref());
    let references = references.map(|reference| (&reference.path, reference.sha256));
    let frames = dataset.table().frames().iter().flatten();
    let frames = frames.map(|frame| (&frame.path, frame.digest));
    for (name, expected) in references.chain(frames) {
        let file = File::open(path.join(name));
        let found = file.and_then(|mut file| Digest::of_reader(&mut file));
        if found.map_err(|error| format!("{name}: {error}"))? != expected {
            return Err(format!("{name} is not the frame that was recorded"));
        }
    }
    Ok(())
}

fn moved(beside: &Path, place: &Path) -> Option<Dataset> {
    fs::rename(beside, place).ok()?;
    place.parent().map(sync_folder)?.ok()?;
    Dataset::open(place).ok()
}

fn beside(place: &Path) -> Option<PathBuf> {
    let name = place.file_name()?.to_string_lossy();
    Some(place.with_file_name(format!(".{name}.partial")))
}
