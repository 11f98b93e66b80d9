//! A plugin handed to a child: its library, sealed, and what its manifest says.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::path::PathBuf;
use std::sync::Arc;

use rustix::fs::{MemfdFlags, SealFlags, fcntl_add_seals, memfd_create};
use taceva_core::{ArgSpec, DriverKey, ErrorKind};

use super::main_hook::main_if_child_with;
use super::quarantine::Quarantine;
use super::spec::ChildSpec;
use super::wire::{Wire, decode, fields};
use crate::in_process::InProcess;
use crate::library::{Image, Level, Library};
use crate::manifest::{Manifest, Sha256Digest};
use crate::session::Session;

/// What a child must know of a plugin besides its library.
#[derive(Debug, PartialEq)]
struct Label {
    path: Vec<u8>,
    digest: String,
    /// Without one, the library is only asked what it offers.
    manifest: Option<String>,
}

fields!(Label {
    path,
    digest,
    manifest
});

impl ChildSpec {
    /// A child that loads `image`, the library of the plugin whose manifest is `text`. It reaches nothing outside until
    /// [`confinement`](ChildSpec::confinement) says so, and is not started if `quarantine` holds that library.
    ///
    /// # Errors
    /// If the memory that is handed over cannot be made.
    pub fn of_plugin(
        image: &Image,
        manifest: &Manifest,
        text: &str,
        quarantine: Option<Quarantine>,
    ) -> io::Result<ChildSpec> {
        let label = Label {
            path: image.path().as_os_str().as_bytes().to_vec(),
            digest: image.digest().to_string(),
            manifest: Some(text.to_owned()),
        };
        let files = vec![image.as_fd().try_clone_to_owned()?, sealed(&label)?];
        let mut spec = ChildSpec::new(manifest.id.to_string(), files);
        spec.quarantine = quarantine.map(|quarantine| (quarantine, image.digest()));
        Ok(spec)
    }
}

impl ChildSpec {
    /// A child that loads `image`, of which no manifest says anything, and reaches nothing outside.
    ///
    /// # Errors
    /// As [`of_plugin`](ChildSpec::of_plugin).
    pub(crate) fn of_library(image: &Image) -> io::Result<ChildSpec> {
        let label = Label {
            path: image.path().as_os_str().as_bytes().to_vec(),
            digest: image.digest().to_string(),
            manifest: None,
        };
        let files = vec![image.as_fd().try_clone_to_owned()?, sealed(&label)?];
        let name = image.path().file_name().unwrap_or_default();
        Ok(ChildSpec::new(name.to_string_lossy(), files))
    }
}

/// The arguments that the drivers and estimators of a plugin take.
pub(super) fn arguments(manifest: &Manifest) -> BTreeMap<DriverKey, Vec<ArgSpec>> {
    let drivers = manifest
        .drivers()
        .map(|driver| (driver.key().clone(), driver.arguments().to_vec()));
    let estimators = manifest
        .estimators()
        .map(|estimator| (estimator.key.clone(), estimator.settings.clone()));
    drivers.chain(estimators).collect()
}

fn sealed(label: &Label) -> io::Result<OwnedFd> {
    let flags = MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING;
    let mut file = File::from(memfd_create(c"taceva-label", flags)?);
    let mut bytes = Vec::new();
    label.write(&mut bytes);
    file.write_all(&bytes)?;
    let all = SealFlags::WRITE | SealFlags::GROW | SealFlags::SHRINK | SealFlags::SEAL;
    fcntl_add_seals(&file, all)?;
    Ok(file.into())
}

/// Returns at once, unless this process was started as a host child: then it confines itself, loads the plugin that it was given, serves
/// it until its host is gone, and ends.
///
/// A program that embeds the host calls this before anything else in `main`, while there is one thread and no file is open.
pub fn main_if_child() {
    main_if_child_with(load);
}

/// The plugin that `files` are, loaded.
fn load(files: Vec<File>) -> Result<Arc<dyn Session>, (ErrorKind, String)> {
    let broken = |why: &str| (ErrorKind::Abi, format!("its host gave it {why}"));
    let mut files = files.into_iter();
    let (Some(library), Some(label), probe) = (files.next(), files.next(), files.next()) else {
        return Err(broken("less than two files"));
    };
    let label = read(label).map_err(|error| broken(&error.to_string()))?;
    let digest = Sha256Digest::from_hex(&label.digest).ok_or_else(|| broken("no digest"))?;
    let path = PathBuf::from(OsString::from_vec(label.path));
    let image = Image::from_sealed(library.into(), digest, path);
    let loaded = match label.manifest {
        None => Library::load_unpromised(&image, Box::new(log)),
        Some(text) => {
            let manifest =
                Manifest::parse(&text).map_err(|error| (ErrorKind::Protocol, error.to_string()))?;
            if let Some(probe) = probe {
                return Ok(Arc::new(crate::check::run(probe, &image, &manifest)?));
            }
            Library::load(&image, &manifest, Box::new(log))
        }
    };
    let library = loaded.map_err(|error| (error.problem().kind(), error.to_string()))?;
    let session = InProcess::open(&library).map_err(|error| (error.kind(), error.to_string()))?;
    Ok(Arc::new(session))
}

fn read(file: File) -> io::Result<Label> {
    use std::io::Seek;
    let mut file = file;
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    decode(&bytes).map_err(io::Error::other)
}

/// What a plugin logs goes to its host; where that does not listen it stands among what the process prints, of which the host keeps the last.
fn log(level: Level, target: &str, message: &str) {
    if !super::log::send(level, target, message) && level <= Level::Warn {
        // Nobody is left to tell if this fails.
        let _ = writeln!(io::stderr(), "{target}: {message}");
    }
}
