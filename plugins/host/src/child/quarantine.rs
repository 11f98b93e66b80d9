//! Quarantine of crashed plugins. A plugin in quarantine does not start until the user releases it.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::plain::plain;
use crate::manifest::Sha256Digest;

/// Folder of a user's quarantine. The folder has one file per library, named by the digest of the library. A new build is therefore not in quarantine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quarantine {
    folder: PathBuf,
}

/// Quarantine entry of a crashed library.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quarantined {
    /// Digest of the library.
    pub sha256: Sha256Digest,
    /// Name of the plugin.
    pub plugin: String,
    /// Description of the crash.
    pub reason: String,
}

impl Quarantine {
    /// Quarantine stored in `folder`, which need not exist yet.
    pub fn of_folder(folder: impl Into<PathBuf>) -> Quarantine {
        Quarantine {
            folder: folder.into(),
        }
    }

    /// Quarantine of the current user: `$XDG_STATE_HOME/taceva/quarantine`, or the same below `$HOME/.local/state`. `None` if neither
    /// variable is an absolute path.
    pub fn of_user(variable: impl Fn(&str) -> Option<PathBuf>) -> Option<Quarantine> {
        let absolute = |name: &str| variable(name).filter(|path| path.is_absolute());
        let state = absolute("XDG_STATE_HOME")
            .or_else(|| Some(absolute("HOME")?.join(".local").join("state")))?;
        Some(Quarantine::of_folder(
            state.join("taceva").join("quarantine"),
        ))
    }

    /// Path of the quarantine folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Entry of a library; `None` if it is not in quarantine. A damaged entry counts as an entry.
    ///
    /// # Errors
    /// If the entry's file exists but cannot be read.
    pub fn get(&self, sha256: Sha256Digest) -> io::Result<Option<Quarantined>> {
        match fs::read_to_string(self.file(sha256)) {
            Ok(text) => Ok(Some(toml::from_str(&text).unwrap_or(Quarantined {
                sha256,
                plugin: String::new(),
                reason: "it crashed".to_owned(),
            }))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// All entries, sorted by digest.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub fn entries(&self) -> io::Result<Vec<Quarantined>> {
        let entries = match fs::read_dir(&self.folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(error),
        };
        let mut found = Vec::new();
        for entry in entries {
            let path = entry?.path();
            let digest = path.file_stem().and_then(|name| name.to_str());
            if let Some(digest) = digest.and_then(Sha256Digest::from_hex) {
                found.extend(self.get(digest)?);
            }
        }
        found.sort_by_key(|entry| entry.sha256);
        Ok(found)
    }

    /// Puts a library into quarantine.
    ///
    /// # Errors
    /// If the entry cannot be written.
    pub fn put(&self, entry: &Quarantined) -> io::Result<()> {
        fs::create_dir_all(&self.folder)?;
        let text = toml::to_string(entry).map_err(io::Error::other)?;
        // Written under a random name, then renamed: an entry is never partial, and no link is followed.
        taceva_files::replace(&self.file(entry.sha256), |staged| fs::write(staged, text))
    }

    /// Releases every library of the plugin `plugin`, or the library whose digest is `plugin`. Returns the number of released libraries.
    ///
    /// # Errors
    /// If an entry cannot be read or removed.
    pub fn release(&self, plugin: &str) -> io::Result<usize> {
        let mut released = 0;
        for entry in self.entries()? {
            if entry.plugin == plugin || entry.sha256.to_string() == plugin {
                fs::remove_file(self.file(entry.sha256))?;
                released += 1;
            }
        }
        Ok(released)
    }

    fn file(&self, sha256: Sha256Digest) -> PathBuf {
        self.folder.join(format!("{sha256}.toml"))
    }
}

impl Quarantined {
    /// Creates the entry of a library of `plugin` that crashed for `reason`.
    pub fn new(sha256: Sha256Digest, plugin: &str, reason: &str) -> Quarantined {
        Quarantined {
            sha256,
            plugin: plugin.to_owned(),
            reason: plain(reason),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_crashed_is_kept_by_digest_and_released_by_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let quarantine = Quarantine::of_folder(folder.path().join("quarantine"));
        let digest = Sha256Digest([7; 32]);
        assert_eq!(quarantine.get(digest).expect("readable"), None);
        assert_eq!(quarantine.entries().expect("readable"), []);
        let entry = Quarantined::new(digest, "org.example.x", "signal 11 \u{1b}[2J");
        quarantine.put(&entry).expect("written");
        quarantine.put(&entry).expect("written twice");
        let other = Quarantined::new(Sha256Digest([8; 32]), "org.example.y", "exit");
        quarantine.put(&other).expect("written");
        assert_eq!(quarantine.entries().expect("readable").len(), 2);
        let found = quarantine.get(digest).expect("readable").expect("there");
        assert_eq!(found.reason, "signal 11 \\u{1b}[2J");
        assert_eq!(quarantine.release("org.example.x").expect("released"), 1);
        assert_eq!(quarantine.get(digest).expect("readable"), None);
        assert_eq!(quarantine.entries().expect("readable"), [other]);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_at_the_name_of_an_entry_is_replaced_and_not_followed() {
        let folder = tempfile::tempdir().expect("a folder");
        let theirs = folder.path().join("thesis.tex");
        fs::write(&theirs, "theirs").expect("written");
        let quarantine = Quarantine::of_folder(folder.path().join("quarantine"));
        fs::create_dir(quarantine.folder()).expect("made");
        let entry = Quarantined::new(Sha256Digest([7; 32]), "org.example.x", "signal 11");
        let digest = entry.sha256;
        // Earlier versions wrote to the second name.
        let foretold = format!(".{digest}-{}", std::process::id());
        for name in [format!("{digest}.toml"), foretold] {
            let link = quarantine.folder().join(name);
            std::os::unix::fs::symlink(&theirs, link).expect("linked");
        }
        quarantine.put(&entry).expect("written");
        assert_eq!(fs::read_to_string(&theirs).expect("there"), "theirs");
        assert!(!quarantine.file(digest).is_symlink());
        assert_eq!(quarantine.get(digest).expect("readable"), Some(entry));
        let names = fs::read_dir(quarantine.folder()).expect("there").count();
        assert_eq!(names, 2, "the entry and the other link alone");
    }

    #[test]
    fn an_entry_that_does_not_read_holds_all_the_same() {
        let folder = tempfile::tempdir().expect("a folder");
        let quarantine = Quarantine::of_folder(folder.path());
        let digest = Sha256Digest([9; 32]);
        fs::write(quarantine.file(digest), "[[").expect("written");
        assert!(quarantine.get(digest).expect("readable").is_some());
        let released = quarantine.release(&digest.to_string());
        assert_eq!(released.expect("released"), 1);
    }

    #[test]
    fn it_lies_where_the_user_keeps_state() {
        let of = |name: &str, path: &str| {
            let (name, path) = (name.to_owned(), PathBuf::from(path));
            Quarantine::of_user(move |asked| (asked == name).then(|| path.clone()))
        };
        let state = of("XDG_STATE_HOME", "/s").expect("a folder");
        assert_eq!(state.folder(), Path::new("/s/taceva/quarantine"));
        let home = of("HOME", "/h").expect("a folder");
        assert_eq!(
            home.folder(),
            Path::new("/h/.local/state/taceva/quarantine")
        );
        assert_eq!(of("XDG_STATE_HOME", "here"), None);
    }
}
