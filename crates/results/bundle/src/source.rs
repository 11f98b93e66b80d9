//! Files of a bundle on disk: a folder, or a packed bundle that is unpacked into a temporary folder.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use sha2::{Digest as _, Sha256};
use taceva_core::shown;
use taceva_files::TemporaryFolder;

use crate::error::{BundleError, Damage};
use crate::layout::MANIFEST;
use crate::name::{check_amount, check_case};
use crate::{archive, name};

/// Prefix of the folder of an unpacked bundle.
const UNPACKED: &str = ".taceva-unpacked-bundle-";

/// Files of a bundle, with their sizes.
pub(crate) struct Source {
    root: PathBuf,
    files: BTreeMap<String, u64>,
    /// Temporary folder of an unpacked bundle, removed on drop; `None` for a bundle in a folder.
    unpacked: Option<TemporaryFolder>,
}

impl Source {
    /// Opens the bundle at `path`, whose files have at most `most` bytes together.
    ///
    /// # Errors
    /// [`BundleError::Damaged`] for links, special files, invalid names, and too many files or bytes; [`BundleError::File`] for an unreadable file.
    pub(crate) fn open(path: &Path, most: u64) -> Result<Source, BundleError> {
        let about = fs::metadata(path).map_err(BundleError::file(path))?;
        if about.is_dir() {
            return Source::of(path.to_owned(), most, None);
        }
        let parent = std::env::temp_dir();
        let folder =
            TemporaryFolder::create(&parent, UNPACKED).map_err(BundleError::file(&parent))?;
        let content = folder.path().join("content");
        fs::create_dir(&content).map_err(BundleError::file(&content))?;
        archive::unpack(path, &content, most)?;
        Source::of(innermost(content), most, Some(folder))
    }

    fn of(
        root: PathBuf,
        most: u64,
        unpacked: Option<TemporaryFolder>,
    ) -> Result<Source, BundleError> {
        let mut files = BTreeMap::new();
        let mut folders = vec![String::new()];
        let (mut total, mut count) = (0_u64, 0);
        while let Some(folder) = folders.pop() {
            let path = root.join(&folder);
            for entry in fs::read_dir(&path).map_err(BundleError::file(&path))? {
                let entry = entry.map_err(BundleError::file(&path))?;
                let own = entry.file_name();
                let own = own.to_string_lossy();
                let name = match folder.is_empty() {
                    true => own.into_owned(),
                    false => format!("{folder}/{own}"),
                };
                let refused =
                    |rule, problem: String| BundleError::Damaged(Damage::new(&name, rule, problem));
                if let Some(fault) = name::fault(&name) {
                    return Err(refused(name::RULE, fault));
                }
                let about = fs::symlink_metadata(entry.path());
                let about = about.map_err(BundleError::file(&entry.path()))?;
                if about.is_dir() {
                    folders.push(name);
                } else if about.is_file() {
                    total = total.saturating_add(about.len());
                    files.insert(name, about.len());
                } else {
                    let what = match about.is_symlink() {
                        true => "a link, expected a regular file",
                        false => "a device, a pipe or a socket, expected a regular file",
                    };
                    return Err(refused("every entry is a regular file", what.to_owned()));
                }
                // Listed folders count too.
                count += 1;
                check_amount(count, total, most)?;
            }
        }
        check_case(files.keys())?;
        Ok(Source {
            root,
            files,
            unpacked,
        })
    }

    /// Path of the file `name` of the bundle.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.root.join(name)
    }

    /// Names and sizes of all files.
    pub(crate) fn files(&self) -> &BTreeMap<String, u64> {
        &self.files
    }

    /// `problem` with names in the bundle in place of paths below the temporary folder.
    pub(crate) fn as_named(&self, problem: &str) -> String {
        match self.unpacked {
            Some(_) => problem.replace(&format!("{}{MAIN_SEPARATOR}", shown(&self.root)), ""),
            None => problem.to_owned(),
        }
    }

    /// Digest of the file `name`, as `sha256:` and digits.
    ///
    /// # Errors
    /// [`BundleError::File`] if the file cannot be read.
    pub(crate) fn digest(&self, name: &str) -> Result<String, BundleError> {
        digest_of(&self.path(name))
    }

    /// Text of the file `name`, of at most `most` bytes.
    ///
    /// # Errors
    /// [`Damage`] if the file is missing, too long or not text.
    pub(crate) fn text(&self, name: &str, most: u64) -> Result<String, Damage> {
        let size = self.size(name, most)?;
        let read = File::open(self.path(name)).and_then(|file| {
            let mut text = String::new();
            file.take(size + 1).read_to_string(&mut text)?;
            Ok(text)
        });
        read.map_err(|error| Damage::new(name, "a text is UTF-8", error.to_string()))
    }

    /// Size of the file `name`, at most `most` bytes.
    ///
    /// # Errors
    /// [`Damage`] if the file is missing or too long.
    pub(crate) fn size(&self, name: &str, most: u64) -> Result<u64, Damage> {
        match self.files.get(name) {
            None => Err(Damage::new(name, "every file is there", "it is missing")),
            Some(size) if *size > most => Err(Damage::new(
                name,
                "files are not too long to read",
                format!("{size} bytes, expected at most {most}"),
            )),
            Some(size) => Ok(*size),
        }
    }
}

/// Digest of the file at `path`, as `sha256:` and digits.
///
/// # Errors
/// [`BundleError::File`] if the file cannot be read.
pub(crate) fn digest_of(path: &Path) -> Result<String, BundleError> {
    let failed = BundleError::file(path);
    let digest = || -> io::Result<String> {
        let mut file = File::open(path)?;
        let mut hasher = Sha256::new();
        let mut block = vec![0; 1 << 16];
        loop {
            match file.read(&mut block)? {
                0 => break,
                read => hasher.update(&block[..read]),
            }
        }
        let digits = hasher.finalize();
        let digits: String = digits.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(format!("sha256:{digits}"))
    };
    digest().map_err(failed)
}

/// Folder with the manifest: `content` itself, or the only folder in `content`.
fn innermost(content: PathBuf) -> PathBuf {
    if content.join(MANIFEST).exists() {
        return content;
    }
    let mut entries = fs::read_dir(&content).into_iter().flatten().flatten();
    match (entries.next(), entries.next()) {
        (Some(only), None) if only.path().join(MANIFEST).exists() => only.path(),
        _ => content,
    }
}
