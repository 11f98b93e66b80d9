//! Private, sealed copy of a library. The loaded bytes are therefore the hashed bytes.

use std::fs::File;
use std::io::{Read, Write};
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::path::{Path, PathBuf};

use rustix::fs::{MemfdFlags, memfd_create};
use sha2::{Digest, Sha256};

use super::elf;
use super::error::{LoadError, LoadProblem};
use crate::manifest::{LibraryFile, Sha256Digest};
use crate::sealed_memory::seal_all;

/// Maximum length of a library, bytes.
pub(crate) const LENGTH_MAX: u64 = 1 << 30;
/// Block size for copying, bytes.
const BLOCK: usize = 1 << 16;

/// Hashed copy of a library in sealed memory. Later changes of the file have no effect.
#[derive(Debug)]
pub struct Image {
    memory: OwnedFd,
    digest: Sha256Digest,
    path: PathBuf,
}

impl Image {
    /// Copies and hashes the library that a manifest in `folder` names.
    ///
    /// # Errors
    /// [`LoadError`] if the library is not a regular file, is not built for this machine, is truncated, or has another digest than the manifest.
    pub fn read(folder: &Path, library: &LibraryFile) -> Result<Image, LoadError> {
        let path = folder.join(&library.path);
        let failed = |problem: LoadProblem| problem.of(&path);
        let io = |error: std::io::Error| failed(LoadProblem::File(error));
        // Checked before opening, because opening a pipe would block.
        if !std::fs::metadata(&path).map_err(io)?.is_file() {
            return Err(failed(LoadProblem::NotAFile));
        }
        let mut file = File::open(&path).map_err(io)?;
        if !file.metadata().map_err(io)?.is_file() {
            return Err(failed(LoadProblem::NotAFile));
        }
        let flags = MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING;
        let memory = memfd_create("taceva plugin", flags).map_err(|error| io(error.into()))?;
        let mut copy = File::from(memory);
        let digest = copy_hashed(&mut file, &mut copy).map_err(failed)?;
        if let Some(expected) = library.sha256.filter(|expected| *expected != digest) {
            return Err(failed(LoadProblem::Digest {
                expected,
                found: digest,
            }));
        }
        seal_all(&copy).map_err(|error| io(error.into()))?;
        // Checked after sealing, so the checked bytes cannot change.
        elf::check(&copy).map_err(failed)?;
        Ok(Image {
            memory: copy.into(),
            digest,
            path,
        })
    }

    /// Digest of the library.
    pub fn digest(&self) -> Sha256Digest {
        self.digest
    }

    /// Path of the original file, for messages.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Wraps an image that another process read, sealed and checked. `memory` comes from its [`as_fd`](Image::as_fd).
    pub fn from_sealed(memory: OwnedFd, digest: Sha256Digest, path: PathBuf) -> Image {
        Image {
            memory,
            digest,
            path,
        }
    }

    pub(super) fn try_clone(&self) -> std::io::Result<OwnedFd> {
        self.memory.try_clone()
    }
}

impl AsFd for Image {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.memory.as_fd()
    }
}

fn copy_hashed(from: &mut File, to: &mut File) -> Result<Sha256Digest, LoadProblem> {
    let mut block = vec![0; BLOCK];
    let mut hasher = Sha256::new();
    let mut length = 0;
    loop {
        let read = match from.read(&mut block) {
            Ok(0) => break,
            Ok(read) => read,
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(LoadProblem::File(error)),
        };
        length += read as u64;
        if length > LENGTH_MAX {
            return Err(LoadProblem::TooLong { most: LENGTH_MAX });
        }
        hasher.update(&block[..read]);
        to.write_all(&block[..read]).map_err(LoadProblem::File)?;
    }
    Ok(Sha256Digest(hasher.finalize().into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str) -> LibraryFile {
        LibraryFile {
            path: path.to_owned(),
            sha256: None,
        }
    }

    /// A library that exists on every test machine: the C library of this program.
    fn some_library() -> PathBuf {
        let maps = std::fs::read_to_string("/proc/self/maps").expect("readable");
        let library = maps
            .lines()
            .filter_map(|line| line.split_whitespace().nth(5))
            .find(|path| path.contains("libc.so"));
        PathBuf::from(library.expect("a program uses the library of C"))
    }

    #[test]
    fn a_copy_stays_what_it_was_whatever_happens_to_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("lib.so");
        std::fs::copy(some_library(), &path).expect("copied");
        let image = Image::read(folder.path(), &file("lib.so")).expect("a library");
        let before = image.digest();
        std::fs::write(&path, b"swapped").expect("written");
        let memory = File::from(image.try_clone().expect("another handle"));
        assert!((&memory).write_all(b"x").is_err(), "the copy is sealed");
        let whole = LibraryFile {
            sha256: Some(before),
            ..file("lib.so")
        };
        let error = Image::read(folder.path(), &whole).expect_err("swapped");
        assert!(
            matches!(error.problem(), LoadProblem::Digest { .. }),
            "{error}"
        );
    }

    #[test]
    fn what_is_no_library_of_this_machine_is_refused_before_the_loader_sees_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let whole = std::fs::read(some_library()).expect("readable");
        let mut other_machine = whole.clone();
        other_machine[18] ^= 0xff;
        let mut program = whole.clone();
        program[16] = 2;
        let cases: [(&str, &[u8], &str); 6] = [
            ("empty.so", b"", "not a shared library"),
            ("text.so", b"#!/bin/sh\nexit 0\n", "not a shared library"),
            (
                "cut.so",
                &whole[..whole.len() / 2],
                "a truncated shared library",
            ),
            ("head.so", &whole[..80], "a truncated shared library"),
            ("other.so", &other_machine, "for another machine"),
            ("program.so", &program, "not a shared library"),
        ];
        for (name, bytes, expected) in cases {
            std::fs::write(folder.path().join(name), bytes).expect("written");
            let error = Image::read(folder.path(), &file(name)).expect_err(name);
            assert!(error.to_string().contains(expected), "{error}");
        }
        std::fs::create_dir(folder.path().join("folder.so")).expect("made");
        let error = Image::read(folder.path(), &file("folder.so")).expect_err("a folder");
        assert!(error.to_string().contains("not a regular file"), "{error}");
        let error = Image::read(folder.path(), &file("absent.so")).expect_err("absent");
        assert!(matches!(error.problem(), LoadProblem::File(_)), "{error}");
    }
}
