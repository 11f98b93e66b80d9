//! A folder that appears whole or not at all.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use taceva_files::parent_of;

use crate::error::DatasetError;
use crate::file::{is_same, make_names_durable};
use crate::layout;
use crate::lock::lock_folder;
use crate::replacement;
use crate::text::shown;

/// How often a folder that vanishes before it is locked is made again.
const CREATIONS: u32 = 100;

/// What may stand where the folder will be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum Place {
    /// Nothing.
    Free,
    /// Nothing, or a dataset, which is replaced at the end.
    OfDataset,
}

/// A hidden sibling of the target, renamed into place once everything in it is durable and removed if that never happens.
///
/// It is locked while in use, so that the leftover of a killed process is distinguished from the work of a running one.
#[derive(Debug)]
#[doc(hidden)]
pub struct StagedFolder {
    target: PathBuf,
    path: PathBuf,
    lock: Option<File>,
    place: Place,
    is_in_place: bool,
}

impl StagedFolder {
    pub fn create(target: &Path, place: Place) -> Result<StagedFolder, DatasetError> {
        let target = match target.is_symlink() {
            // What a link leads to is replaced, not the link.
            true => fs::canonicalize(target).map_err(DatasetError::io("follow", target))?,
            false => target.to_owned(),
        };
        replacement::settle(&target)?;
        check_place(&target, place)?;
        let path = replacement::partial_name(&target).ok_or_else(|| DatasetError::Request {
            path: target.clone(),
            problem: "no name for a new folder".to_owned(),
        })?;
        for _ in 0..CREATIONS {
            let created = fs::create_dir(&path);
            if matches!(&created, Err(error) if error.kind() == io::ErrorKind::AlreadyExists) {
                remove_leftover(&path, &target)?;
                continue;
            }
            created.map_err(DatasetError::io("create", &path))?;
            let lock = match lock_folder(&path) {
                // Taken for a leftover before it was locked.
                Err(DatasetError::Io { source, .. })
                    if source.kind() == io::ErrorKind::NotFound =>
                {
                    continue;
                }
                lock => lock?,
            };
            if is_same(&lock, &path) {
                return Ok(StagedFolder {
                    target,
                    path,
                    lock: Some(lock),
                    place,
                    is_in_place: false,
                });
            }
        }
        Err(DatasetError::Busy { path })
    }

    /// Where to write meanwhile.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Marks the folder as ours until it is put in place: for an export, whose files do not have the names of those of a dataset.
    pub fn mark(&self) -> Result<(), DatasetError> {
        let path = self.path.join(layout::MARK);
        fs::write(&path, "").map_err(DatasetError::io("create", &path))
    }

    /// Creates a folder inside.
    pub fn create_folder(&self, relative: &str) -> Result<(), DatasetError> {
        let path = self.path.join(relative);
        fs::create_dir(&path).map_err(DatasetError::io("create", &path))
    }

    /// Creates a folder inside, unless it is there already.
    pub fn ensure_folder(&self, relative: &str) -> Result<(), DatasetError> {
        match self.create_folder(relative) {
            Err(DatasetError::Io { source, .. })
                if source.kind() == io::ErrorKind::AlreadyExists =>
            {
                Ok(())
            }
            created => created,
        }
    }

    /// Makes the names in this folder and in the given ones durable, then gives it the name of its target: in one step, whether
    /// something stood there or not, where the file system can exchange names.
    pub fn put_in_place(self, folders: &[String]) -> Result<(), DatasetError> {
        self.put_in_place_by(folders, replacement::exchange)
    }

    fn put_in_place_by(
        mut self,
        folders: &[String],
        exchange: impl Fn(&Path, &Path) -> io::Result<bool>,
    ) -> Result<(), DatasetError> {
        for folder in folders {
            make_names_durable(&self.path.join(folder))?;
        }
        let mark = self.path.join(layout::MARK);
        match fs::remove_file(&mark) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(DatasetError::io("remove", &mark)(error));
            }
            _ => make_names_durable(&self.path)?,
        }
        check_place(&self.target, self.place)?;
        let replaces = fs::symlink_metadata(&self.target).is_ok();
        let swapped = |exchanged: io::Result<bool>| {
            exchanged.map_err(DatasetError::io(
                "exchange with its successor",
                &self.target,
            ))
        };
        let old = if !replaces {
            fs::rename(&self.path, &self.target)
                .map_err(DatasetError::io("rename into place", &self.target))?;
            None
        } else if swapped(exchange(&self.path, &self.target))? {
            Some(self.path.clone())
        } else {
            let aside = replacement::move_aside(&self.target, &self.target)?;
            if let Err(error) = fs::rename(&self.path, &self.target) {
                // Should this fail as well, whoever looks for the dataset puts it back.
                let _ = fs::rename(&aside, &self.target);
                return Err(DatasetError::io("rename into place", &self.target)(error));
            }
            Some(aside)
        };
        if let Err(error) = make_names_durable(parent_of(&self.target)) {
            // Nobody knows whether the name would survive: an error promises that the target is what it was.
            let _ = match &old {
                None => fs::rename(&self.target, &self.path),
                Some(old) if *old == self.path => exchange(&self.path, &self.target).map(drop),
                Some(old) => fs::rename(&self.target, &self.path)
                    .and_then(|()| fs::rename(old, &self.target)),
            };
            return Err(error);
        }
        self.is_in_place = true;
        self.lock = None;
        if let Some(old) = old {
            replacement::retire(&old, &self.target);
        }
        Ok(())
    }
}

impl Drop for StagedFolder {
    fn drop(&mut self) {
        if !self.is_in_place {
            // What cannot be removed now is recognised and removed by the next one.
            let _ = fs::remove_dir_all(&self.path);
        }
    }
}

/// Whether what stands at `target` may be there. Only datasets are ever replaced, and nothing that is no part of one goes with them.
pub fn check_place(target: &Path, place: Place) -> Result<(), DatasetError> {
    let refused = |problem: String| {
        Err(DatasetError::Request {
            path: target.to_owned(),
            problem,
        })
    };
    if fs::symlink_metadata(target).is_err() {
        return Ok(());
    }
    match (place, replacement::foreign_entry(target)) {
        (Place::Free, _) => Err(DatasetError::TargetExists {
            path: target.to_owned(),
        }),
        (Place::OfDataset, _) if !replacement::is_dataset(target) => {
            refused("--force replaces datasets only, and this is none".to_owned())
        }
        (Place::OfDataset, Some(stranger)) => refused(format!(
            "holds `{}`, which is no part of a dataset and would be lost; move it before --force",
            shown(&stranger.to_string_lossy())
        )),
        (Place::OfDataset, None) => Ok(()),
    }
}

/// Removes the folder that an interrupted import left at `path`; what was set aside and is still read gets out of the way.
fn remove_leftover(path: &Path, target: &Path) -> Result<(), DatasetError> {
    if path.is_symlink() {
        return Err(DatasetError::Request {
            path: path.to_owned(),
            problem: "in the way, and a link, which is not followed; remove it".to_owned(),
        });
    }
    let is_export = path.join(layout::MARK).is_file();
    if let Some(stranger) = replacement::foreign_entry(path).filter(|_| !is_export) {
        return Err(DatasetError::Request {
            path: path.to_owned(),
            problem: format!(
                "in the way, and holds `{}`, which no import leaves; move it",
                shown(&stranger.to_string_lossy())
            ),
        });
    }
    match lock_folder(path) {
        // Held until it is gone: nobody else takes it for a leftover meanwhile.
        Ok(stale) => match is_same(&stale, path) {
            true => {
                replacement::remove(path).map_err(DatasetError::io("remove the leftover", path))
            }
            false => Ok(()),
        },
        Err(DatasetError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(DatasetError::Busy { .. }) if is_read(path) => {
            replacement::move_aside(path, target).map(drop)
        }
        Err(error) => Err(error),
    }
}

/// Whether those who hold the folder at `path` only read in it.
fn is_read(path: &Path) -> bool {
    replacement::is_dataset(path)
        && File::open(path).is_ok_and(|folder| folder.try_lock_shared().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_of_a_folder_that_is_not_put_in_place() {
        let folder = tempfile::tempdir().expect("a folder");
        let staged =
            StagedFolder::create(&folder.path().join("set"), Place::Free).expect("created");
        fs::write(staged.path().join("x"), "x").expect("written");
        drop(staged);
        assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);
    }

    #[test]
    fn a_second_writer_is_refused_and_a_leftover_is_cleared() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("set");
        let first = StagedFolder::create(&target, Place::Free).expect("created");
        let second = StagedFolder::create(&target, Place::Free);
        assert!(
            matches!(second, Err(DatasetError::Busy { .. })),
            "{second:?}"
        );
        let path = first.path().to_owned();
        drop(first);
        fs::create_dir(&path).expect("a leftover");
        fs::write(path.join(layout::SAMPLES), "x").expect("written");
        let third = StagedFolder::create(&target, Place::Free).expect("cleared");
        third.put_in_place(&[]).expect("in place");
        assert_eq!(fs::read_dir(&target).expect("there").count(), 0);
    }

    #[test]
    fn a_strangers_folder_in_the_way_is_named_and_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let theirs = folder.path().join(".set.partial");
        fs::create_dir(&theirs).expect("made");
        fs::write(theirs.join("thesis.tex"), "x").expect("written");
        let refused = StagedFolder::create(&folder.path().join("set"), Place::Free);
        let message = refused.expect_err("in the way").to_string();
        assert!(message.contains("holds `thesis.tex`"), "{message}");
        assert!(theirs.join("thesis.tex").exists());
    }

    /// K3.
    #[cfg(unix)]
    #[test]
    fn a_link_at_the_hidden_name_of_a_dataset_is_refused_and_what_it_leads_to_stays() {
        for name in [".set.partial", ".set.replaced"] {
            let folder = tempfile::tempdir().expect("a folder");
            let theirs = tempfile::tempdir().expect("a folder");
            let theirs = dataset(theirs.path(), "theirs");
            std::os::unix::fs::symlink(&theirs, folder.path().join(name)).expect("linked");
            let target = folder.path().join("set");
            let created = StagedFolder::create(&target, Place::Free).map(drop);
            assert_eq!(created.is_err(), name == ".set.partial");
            if let Err(error) = created {
                assert!(error.to_string().contains("a link"), "{error}");
            }
            assert!(!target.exists());
            dataset(folder.path(), "old");
            replacement::settle(&target).expect("settled");
            let header = fs::read_to_string(theirs.join(layout::HEADER));
            assert_eq!(header.expect("there"), "theirs", "{name}");
        }
    }

    /// A folder called `set` that looks like a dataset.
    fn dataset(folder: &Path, words: &str) -> PathBuf {
        let target = folder.join("set");
        fs::create_dir(&target).expect("made");
        fs::write(target.join(layout::HEADER), words).expect("written");
        target
    }

    fn successor(target: &Path) -> StagedFolder {
        let staged = StagedFolder::create(target, Place::OfDataset).expect("created");
        fs::write(staged.path().join(layout::HEADER), "new").expect("written");
        staged
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("there").flatten();
        let mut names: Vec<String> = entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_dataset_is_replaced_with_and_without_an_exchange_of_names() {
        for can_exchange in [true, false] {
            let folder = tempfile::tempdir().expect("a folder");
            let target = dataset(folder.path(), "old");
            let exchange = |one: &Path, other: &Path| match can_exchange {
                true => replacement::exchange(one, other),
                false => Ok(false),
            };
            let placed = successor(&target).put_in_place_by(&[], exchange);
            placed.expect("in place");
            let header = fs::read_to_string(target.join(layout::HEADER)).expect("there");
            assert_eq!(
                (header.as_str(), names(folder.path())),
                ("new", vec!["set".to_owned()])
            );
        }
    }

    #[test]
    fn what_stops_between_two_renames_is_put_back_by_whoever_looks_for_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = dataset(folder.path(), "old");
        let staged = successor(&target);
        // As a kill between the two leaves it, but for the lock.
        replacement::move_aside(&target, &target).expect("set aside");
        let waiting = std::thread::spawn({
            let target = target.clone();
            move || replacement::settle(&target).map(|()| target.exists())
        });
        std::thread::sleep(std::time::Duration::from_millis(50));
        assert!(!target.exists(), "somebody is still at work");
        std::mem::forget(staged);
        // The lock ends with the process; here it is the only handle that is forgotten, so a second folder stands for it.
        fs::rename(
            folder.path().join(".set.partial"),
            folder.path().join("gone"),
        )
        .expect("moved");
        assert!(waiting.join().expect("no panic").expect("settled"));
        assert_eq!(
            fs::read_to_string(target.join(layout::HEADER)).expect("back"),
            "old"
        );
    }

    #[test]
    fn a_dataset_that_is_read_is_set_aside_and_cleared_once_it_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = dataset(folder.path(), "old");
        let reader = crate::folder_handle::HeldFolder::open(&target).expect("held");
        successor(&target).put_in_place(&[]).expect("in place");
        assert_eq!(reader.read(layout::HEADER, 9).expect("still there"), b"old");
        assert_eq!(names(folder.path()), [".set.replaced", "set"]);
        successor(&target)
            .put_in_place(&[])
            .expect("in place again");
        assert_eq!(reader.read(layout::HEADER, 9).expect("still there"), b"old");
        drop(reader);
        replacement::settle(&target).expect("cleared");
        assert_eq!(names(folder.path()), ["set"]);
    }

    #[test]
    fn nothing_but_a_dataset_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = dataset(folder.path(), "old");
        fs::write(target.join("notes.txt"), "mine").expect("written");
        let message = check_place(&target, Place::OfDataset)
            .expect_err("notes")
            .to_string();
        assert!(message.contains("holds `notes.txt`"), "{message}");
        let other = check_place(folder.path(), Place::OfDataset).expect_err("no dataset");
        assert!(
            other.to_string().contains("replaces datasets only"),
            "{other}"
        );
    }
}
