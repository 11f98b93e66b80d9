//! Unpacking of untrusted packages.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

use sha2::{Digest, Sha256};
use tar::{Archive, EntryType};

use super::{DIGESTS, LICENCE_MAX, LICENCES_MAX, PackageError, is_licence, libraries};
use crate::library;
use crate::manifest::{self, Manifest, Sha256Digest, path_fault, platform};
use crate::search::MANIFEST;

/// Unpacks the manifest, the library for this machine and the licences from `archive` into the empty `folder`.
///
/// The manifest comes first and determines the other entries. `SHA256SUMS` comes second. Every file is compared with its digest. Only plain files
/// below `folder` are written.
///
/// # Errors
/// [`PackageError`] for the first invalid entry: a link, a folder, a path outside `folder`, a duplicate name, or a file that is too long or
/// unexpected. Also if a file is missing, truncated, or has another digest. Files written before the error remain.
pub fn unpack(archive: impl Read, folder: &Path) -> Result<(), PackageError> {
    let mut archive = Archive::new(archive);
    let mut promised: Option<Promised> = None;
    let mut seen = BTreeSet::new();
    // Reads raw entries, so entries that carry long names are rejected too.
    let entries = archive.entries().map_err(PackageError::Archive)?;
    for entry in entries.raw(true) {
        let mut entry = entry.map_err(PackageError::Archive)?;
        let name = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
        let length = entry.header().size().map_err(PackageError::Archive)?;
        is_plain(&name, entry.header().entry_type())?;
        if !seen.insert(name.clone()) {
            return Err(PackageError::entry(&name, "it occurs twice, expected once"));
        }
        let most = match (seen.len(), name.as_str(), &promised) {
            (1, MANIFEST, _) => manifest::BYTES_MAX as u64,
            (1, ..) => {
                let problem =
                    format!("expected `{MANIFEST}` first, as `taceva plugin pack` writes it");
                return Err(PackageError::entry(&name, problem));
            }
            (2, DIGESTS, _) => manifest::BYTES_MAX as u64,
            (2, ..) => {
                let problem =
                    format!("expected `{DIGESTS}` second, as `taceva plugin pack` writes it");
                return Err(PackageError::entry(&name, problem));
            }
            (_, _, Some(promised)) => promised.most(&name)?,
            (_, _, None) => {
                return Err(PackageError::entry(
                    &name,
                    "the archive has no manifest that names this file",
                ));
            }
        };
        if length > most {
            let problem = format!("{length} bytes, expected at most {most}");
            return Err(PackageError::entry(&name, problem));
        }
        match (name.as_str(), &mut promised) {
            (MANIFEST, _) => {
                let text = text(&name, &mut entry, length)?;
                let manifest = Manifest::parse(&text).map_err(PackageError::Manifest)?;
                write(folder, &name, &mut text.as_bytes(), length)?;
                promised = Some(Promised::by(manifest));
            }
            (DIGESTS, Some(promised)) => {
                promised.digests = digests(&text(&name, &mut entry, length)?)?;
            }
            (_, Some(promised)) => promised.take(&name, &mut entry, length, folder)?,
            (_, None) => {}
        }
    }
    let Some(promised) = promised else {
        return Err(PackageError::entry(MANIFEST, "it is missing"));
    };
    promised.whole(&seen)
}

/// Fails unless the entry is a plain file with a path below the folder.
fn is_plain(name: &str, kind: EntryType) -> Result<(), PackageError> {
    if kind != EntryType::Regular {
        let what = match kind {
            EntryType::Symlink | EntryType::Link => "a link",
            EntryType::Directory => "a folder",
            EntryType::XHeader | EntryType::XGlobalHeader | EntryType::GNULongName => {
                "a name or attributes too long for a header"
            }
            _ => "not a regular file",
        };
        let problem =
            format!("{what}, expected only regular files, as `taceva plugin pack` writes them");
        return Err(PackageError::entry(name, problem));
    }
    match path_fault(name) {
        Some(_) => Err(PackageError::entry(
            name,
            "a path that leads out of the folder, expected one below it, without `..`",
        )),
        None => Ok(()),
    }
}

/// Expected contents, from the manifest and the digests.
struct Promised {
    manifest: Manifest,
    digests: BTreeMap<String, Sha256Digest>,
    licences: usize,
}

impl Promised {
    fn by(manifest: Manifest) -> Promised {
        Promised {
            manifest,
            digests: BTreeMap::new(),
            licences: 0,
        }
    }

    /// Maximum length of the file `name`, bytes. Fails if no such file is expected.
    fn most(&self, name: &str) -> Result<u64, PackageError> {
        if libraries(&self.manifest).any(|library| library == name) {
            Ok(library::LENGTH_MAX)
        } else if is_licence(name) && self.licences < LICENCES_MAX {
            Ok(LICENCE_MAX)
        } else {
            let problem =
                "not named in the manifest: expected only libraries of `[library]`, and licences";
            Err(PackageError::entry(name, problem))
        }
    }

    /// Compares a file with its digest, and writes it if this machine needs the file.
    fn take(
        &mut self,
        name: &str,
        entry: &mut impl Read,
        length: u64,
        folder: &Path,
    ) -> Result<(), PackageError> {
        let own = self.manifest.library(&platform());
        let is_own = own.is_some_and(|own| own.path == name);
        self.licences += usize::from(is_licence(name));
        let digest = match is_own || is_licence(name) {
            true => write(folder, name, entry, length)?,
            false => copy(name, entry, &mut io::sink(), length)?,
        };
        match self.digests.get(name) {
            Some(promised) if *promised == digest => Ok(()),
            Some(promised) => {
                let problem =
                    format!("its sha256 is {digest}, expected {promised} from `{DIGESTS}`");
                Err(PackageError::entry(name, problem))
            }
            None => Err(PackageError::entry(
                name,
                format!("`{DIGESTS}` does not name it"),
            )),
        }
    }

    /// Fails if the archive lacks `SHA256SUMS` or a file that it lists.
    fn whole(&self, seen: &BTreeSet<String>) -> Result<(), PackageError> {
        if !seen.contains(DIGESTS) {
            return Err(PackageError::entry(DIGESTS, "it is missing"));
        }
        match self.digests.keys().find(|name| !seen.contains(*name)) {
            Some(name) => Err(PackageError::entry(
                name,
                format!("it is missing, but `{DIGESTS}` names it"),
            )),
            None => Ok(()),
        }
    }
}

/// Parses the digests, by file name.
fn digests(text: &str) -> Result<BTreeMap<String, Sha256Digest>, PackageError> {
    let mut digests = BTreeMap::new();
    for (number, line) in text.lines().enumerate() {
        let read = line.split_once("  ");
        let read = read.and_then(|(digest, name)| Some((name, Sha256Digest::from_hex(digest)?)));
        let Some((name, digest)) = read else {
            let problem = format!(
                "line {}: expected 64 hexadecimal digits, two spaces and a name",
                number + 1
            );
            return Err(PackageError::entry(DIGESTS, problem));
        };
        digests.insert(name.to_owned(), digest);
    }
    Ok(digests)
}

/// Reads an entry as text.
fn text(name: &str, entry: &mut impl Read, length: u64) -> Result<String, PackageError> {
    let mut bytes = Vec::new();
    copy(name, entry, &mut bytes, length)?;
    String::from_utf8(bytes).map_err(|_| PackageError::entry(name, "it is not UTF-8"))
}

/// Writes a new file below `folder`, creating its parent folders.
fn write(
    folder: &Path,
    name: &str,
    entry: &mut impl Read,
    length: u64,
) -> Result<Sha256Digest, PackageError> {
    let path = folder.join(name);
    let failed = |error| PackageError::file(&path, error);
    if let Some(above) = path.parent() {
        fs::create_dir_all(above).map_err(failed)?;
    }
    let mut file = File::create_new(&path).map_err(failed)?;
    copy(name, entry, &mut file, length)
}

/// Copies an entry and returns its digest.
fn copy(
    name: &str,
    entry: &mut impl Read,
    into: &mut impl Write,
    length: u64,
) -> Result<Sha256Digest, PackageError> {
    let mut hasher = Sha256::new();
    let mut block = vec![0; 1 << 16];
    let mut left = length;
    while left > 0 {
        let read = entry.read(&mut block).map_err(PackageError::Archive)?;
        if read == 0 {
            return Err(PackageError::entry(
                name,
                format!("it is truncated: {left} bytes are missing"),
            ));
        }
        hasher.update(&block[..read]);
        into.write_all(&block[..read])
            .map_err(PackageError::Archive)?;
        left = left.saturating_sub(read as u64);
    }
    Ok(Sha256Digest(hasher.finalize().into()))
}
