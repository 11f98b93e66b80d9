//! Recordings in the folders of runs. The cache stores their paths and no copies.
//!
//! A note lists the folders that contain one recording, the latest first. Each line also has the digest of the header, because the folder may have
//! been overwritten with another recording. Another run links the files of the first folder with an unchanged recording. Without an unchanged
//! recording, the presses are repeated from the seed, with the same bytes.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use taceva_dataset::{Dataset, Digest};
use taceva_files::{STAGED, TemporaryFolder, parent_of, sync_folder};

use super::tree::link;
use super::{Cache, Key, remove};

/// Maximum number of folders that are listed for one recording.
const PLACES: usize = 8;

impl Cache {
    /// Takes the recording noted under `key`, and links its files to the folder `place`, which must not exist. Returns `None` if no noted folder
    /// contains the unchanged recording.
    pub(super) fn take_recording(&self, key: &Key, place: &Path) -> Option<Dataset> {
        let folder = TemporaryFolder::create(parent_of(place), STAGED).ok()?;
        let beside = folder.path().join("recording");
        for Held {
            header,
            folder: held,
        } in self.held(key)
        {
            if held.exists() && header_digest(&held) != Some(header) {
                self.note(format!(
                    "the recording in {} has changed; its presses are simulated again",
                    held.display()
                ));
                continue;
            }
            // A missing folder of a removed run needs no message.
            let linked = remove(&beside).and_then(|()| link(&held, &beside));
            match linked {
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(error) => self.note_unreadable(&held, &error),
                Ok(()) => match check(&beside) {
                    Ok(()) => {
                        let found = moved(&beside, place);
                        if found.is_some() {
                            self.keep_recording(key, place);
                        }
                        return found;
                    }
                    Err(problem) => self.note(format!(
                        "{}: {problem}; its presses are simulated again",
                        held.display()
                    )),
                },
            }
        }
        None
    }

    /// Lists `place` under `key` as a folder that contains the closed recording.
    pub(super) fn keep_recording(&self, key: &Key, place: &Path) {
        let Ok(place) = place.canonicalize() else {
            return;
        };
        let Some(header) = header_digest(&place) else {
            return;
        };
        let own = Held {
            header,
            folder: place,
        };
        let mut lines = String::new();
        let before = self.held(key).into_iter();
        let others = before.filter(|other| {
            other.folder != own.folder && header_digest(&other.folder) == Some(other.header)
        });
        for held in [own.clone()].into_iter().chain(others).take(PLACES) {
            // A path that is not text, or contains a line break, cannot be noted.
            match held.folder.to_str().filter(|name| !name.contains('\n')) {
                Some(name) => lines.push_str(&format!("{} {name}\n", held.header)),
                None if held.folder == own.folder => return,
                None => {}
            }
        }
        self.put_anew(key, lines.as_bytes());
    }

    /// Folders that are noted under `key`.
    fn held(&self, key: &Key) -> Vec<Held> {
        let text = fs::read_to_string(self.entry(key)).unwrap_or_default();
        let read = |line: &str| {
            let (header, folder) = line.split_once(' ')?;
            Some(Held {
                header: header.parse().ok()?,
                folder: folder.into(),
            })
        };
        text.lines().filter_map(read).collect()
    }
}

/// A folder that contained a recording at the time of its note.
#[derive(Clone, Debug, PartialEq)]
struct Held {
    /// Digest of the bytes of the recording's header.
    header: Digest,
    folder: PathBuf,
}

fn header_digest(folder: &Path) -> Option<Digest> {
    let header = fs::read(folder.join("dataset.toml")).ok()?;
    Some(Digest::of(&header))
}

/// Checks the recording at `path`: opening checks header and table, then every frame is checked by its digest. The error is a message for the user.
///
/// Without this check, only a later stage would find a damaged frame, too late to repeat the press.
fn check(path: &Path) -> Result<(), String> {
    let dataset = Dataset::open(path).map_err(|error| error.to_string())?;
    dataset.verify_frames().map_err(|error| error.to_string())
}

fn moved(beside: &Path, place: &Path) -> Option<Dataset> {
    fs::rename(beside, place).ok()?;
    place.parent().map(sync_folder)?.ok()?;
    Dataset::open(place).ok()
}
