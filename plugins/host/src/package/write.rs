//! Packing of plugins.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};

use sha2::{Digest, Sha256};
use tar::{Builder, EntryType, Header};

use super::{DIGESTS, PackageError, libraries, licences};
use crate::manifest::Sha256Digest;
use crate::search::{MANIFEST, Plugin};

/// Packs `plugin` into an archive: the manifest, the digests, every existing library of the manifest, and the licences. Archives of equal plugins are equal.
/// Returns the names of the entries.
///
/// # Errors
/// [`PackageError`] if a file cannot be read, or its path does not fit a tar header (256 bytes).
pub fn pack(plugin: &Plugin, into: &mut dyn Write) -> Result<Vec<String>, PackageError> {
    if let Some(module) = plugin.module() {
        let problem = "a Python package is distributed as a wheel: make it by `pip wheel`";
        return Err(PackageError::entry(&module.name, problem));
    }
    let mut names: BTreeSet<String> = BTreeSet::new();
    for library in libraries(&plugin.manifest) {
        if plugin.folder.join(library).is_file() {
            names.insert(library.to_owned());
        }
    }
    let licences =
        licences(&plugin.folder).map_err(|error| PackageError::file(&plugin.folder, error))?;
    names.extend(licences.iter().map(|name| name.display().to_string()));
    // Each file is read once, so the hashed bytes are the packed bytes.
    let mut files = Vec::with_capacity(names.len());
    let mut digests = String::new();
    for name in names {
        let path = plugin.folder.join(&name);
        let bytes = fs::read(&path).map_err(|error| PackageError::file(&path, error))?;
        let digest = Sha256Digest(Sha256::digest(&bytes).into());
        digests.push_str(&format!("{digest}  {name}\n"));
        files.push((name, bytes));
    }
    files.insert(0, (DIGESTS.to_owned(), digests.into_bytes()));
    files.insert(0, (MANIFEST.to_owned(), plugin.text.clone().into_bytes()));
    let mut archive = Builder::new(into);
    for (name, bytes) in &files {
        append(&mut archive, name, bytes)
            .map_err(|error| PackageError::entry(name, error.to_string()))?;
    }
    archive.finish().map_err(PackageError::Archive)?;
    Ok(files.into_iter().map(|(name, _)| name).collect())
}

fn append(archive: &mut Builder<&mut dyn Write>, name: &str, bytes: &[u8]) -> io::Result<()> {
    let mut header = Header::new_ustar();
    header.set_path(name)?;
    header.set_entry_type(EntryType::Regular);
    header.set_size(bytes.len() as u64);
    header.set_mode(0o644);
    header.set_mtime(0);
    header.set_cksum();
    archive.append(&header, bytes)
}
