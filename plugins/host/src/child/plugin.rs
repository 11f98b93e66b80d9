//! Transfer of a plugin to a child: the manifest, and the sealed library or the folder of the module.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::path::PathBuf;
use std::sync::Arc;

use rustix::fs::{MemfdFlags, memfd_create};
use taceva_core::{ArgSpec, DriverKey, ErrorKind};

use super::main_hook::main_if_child_with;
use super::quarantine::Quarantine;
use super::sandbox::{Isolation, seal};
use super::spec::ChildSpec;
use super::wire::{Wire, decode, variants};
use crate::call::pending_call;
use crate::in_process::InProcess;
use crate::library::{Image, Level, Linked, Source};
use crate::manifest::{Manifest, Sha256Digest};
use crate::sealed_memory::seal_all;
use crate::session::Session;

/// Description of the plugin that a child serves.
#[derive(Debug, PartialEq)]
enum Label {
    /// A library, whose file the host passes after this description. Without a manifest, the child only reports the drivers and estimators of the
    /// library.
    Library {
        path: PathBuf,
        digest: String,
        manifest: Option<String>,
    },
    /// The module in `folder`.
    Module {
        folder: PathBuf,
        name: String,
        preload: Vec<String>,
        manifest: String,
    },
}

variants!(Label, "the plugin to serve" {
    0 => Library { path, digest, manifest },
    1 => Module { folder, name, preload, manifest },
});

/// Function that examines a plugin instead of serving it. The file contains the description of the examination.
///
/// Returns a session, or an error kind and a message.
pub type Examiner = fn(File, Source, &Manifest) -> Result<Arc<dyn Session>, (ErrorKind, String)>;

/// A module that a runtime imports in a confined process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModuleToImport {
    /// Folder of the package.
    pub folder: PathBuf,
    /// Name of the module.
    pub name: String,
    /// Names of modules to import before this module.
    pub preload: Vec<String>,
}

impl ChildSpec {
    /// Specifies a child that loads `image`, the library of the plugin with `manifest`. The child has no access to the outside until
    /// [`confinement`](ChildSpec::confinement) is set. The child does not start if `quarantine` contains the library.
    ///
    /// # Errors
    /// If the memory for the description cannot be allocated.
    pub fn of_plugin(
        image: &Image,
        manifest: &Manifest,
        text: &str,
        quarantine: Option<Quarantine>,
    ) -> io::Result<ChildSpec> {
        let label = Label::Library {
            path: image.path().to_owned(),
            digest: image.digest().to_string(),
            manifest: Some(text.to_owned()),
        };
        let files = vec![sealed(&label)?, image.as_fd().try_clone_to_owned()?];
        let mut spec = ChildSpec::new(manifest.id.to_string(), files);
        spec.quarantine = quarantine.map(|quarantine| (quarantine, image.digest()));
        Ok(spec)
    }

    /// Specifies a child that imports `module` for the plugin `id` with the manifest `text`. The caller sets the program and the readable files.
    ///
    /// # Errors
    /// As [`of_plugin`](ChildSpec::of_plugin).
    pub(crate) fn of_module(module: ModuleToImport, id: &str, text: &str) -> io::Result<ChildSpec> {
        let ModuleToImport {
            folder,
            name,
            preload,
        } = module;
        let label = Label::Module {
            folder,
            name,
            preload,
            manifest: text.to_owned(),
        };
        Ok(ChildSpec::new(id, vec![sealed(&label)?]))
    }
}

impl ChildSpec {
    /// Specifies a child that loads `image` without a manifest and has no access to the outside.
    ///
    /// # Errors
    /// As [`of_plugin`](ChildSpec::of_plugin).
    pub(crate) fn of_library(image: &Image) -> io::Result<ChildSpec> {
        let label = Label::Library {
            path: image.path().to_owned(),
            digest: image.digest().to_string(),
            manifest: None,
        };
        let files = vec![sealed(&label)?, image.as_fd().try_clone_to_owned()?];
        let name = image.path().file_name().unwrap_or_default();
        Ok(ChildSpec::new(name.to_string_lossy(), files))
    }
}

/// Argument declarations of the plugin's drivers and estimators, by key.
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
    seal_all(&file)?;
    Ok(file.into())
}

/// Returns at once unless this process was started as a host child. A host child confines itself, loads its plugin, serves it until the
/// host is gone, and ends.
///
/// A program that embeds the host calls this function first in `main`, while it has one thread and no open file.
pub fn main_if_child() {
    serve_libraries(None);
}

/// Like [`main_if_child`], for a program that also examines plugins.
pub fn main_if_child_examining(examiner: Examiner) {
    serve_libraries(Some(examiner));
}

fn serve_libraries(examiner: Option<Examiner>) {
    main_if_child_with(|files| {
        let import = |module: &ModuleToImport| {
            Err(format!(
                "`{}` is a Python module, but this process is not a Python process",
                module.name
            ))
        };
        // The process is not sealed here, because everything except a library is rejected.
        load(files, &Isolation::default(), import, examiner)
    });
}

/// Serves as the child of the host on standard input, and returns the exit code. This function is for runtimes of other languages with their own
/// `main`.
///
/// The process confines itself, calls `import` for the requested module and serves the module until the host is gone. If the host requests a library,
/// the process loads the library instead. `import` returns the function table of the module, or the reason for the failure. `examiner` executes
/// orders to examine the module.
///
/// Call this function first, before any other thread starts, because threads that already run are not confined. This function closes every open file
/// except the three standard files. Afterwards the process must end without running exit handlers.
pub fn serve_as_child(
    import: impl FnOnce(&ModuleToImport) -> Result<Linked, String>,
    examiner: Option<Examiner>,
) -> i32 {
    super::main_hook::serve_host(|files, isolation| load(files, isolation, import, examiner))
}

/// Loads the plugin in `files`.
fn load(
    files: Vec<File>,
    isolation: &Isolation,
    import: impl FnOnce(&ModuleToImport) -> Result<Linked, String>,
    examiner: Option<Examiner>,
) -> Result<Arc<dyn Session>, (ErrorKind, String)> {
    let broken = |why: &str| (ErrorKind::Abi, format!("invalid data from the host: {why}"));
    let mut files = files.into_iter();
    let label = files.next().ok_or_else(|| broken("no file"))?;
    let label = read(label).map_err(|error| broken(&error.to_string()))?;
    let (source, text) = match label {
        Label::Library {
            path,
            digest,
            manifest,
        } => {
            let library = files.next().ok_or_else(|| broken("no library"))?;
            let digest = Sha256Digest::from_hex(&digest).ok_or_else(|| broken("no digest"))?;
            if files.len() > 0 {
                pending_call::watch(super::log::tell_call);
            }
            let image = Image::from_sealed(library.into(), digest, path);
            (Source::Image(image), manifest)
        }
        Label::Module {
            folder,
            name,
            preload,
            manifest,
        } => {
            let module = ModuleToImport {
                folder,
                name,
                preload,
            };
            // A further file is an order to examine the module instead.
            if files.len() > 0 {
                pending_call::watch(super::log::tell_call);
            }
            let importing = pending_call::begin("import its module");
            let linked = import(&module).map_err(|why| (ErrorKind::InvalidArgument, why))?;
            // Seals the process before the examination, as in normal use. Some checks load a library again.
            drop(importing);
            seal(isolation).map_err(|why| (ErrorKind::PermissionDenied, why))?;
            (Source::Linked(linked), Some(manifest))
        }
    };
    let manifest = text.as_deref().map(Manifest::parse).transpose();
    let manifest = manifest.map_err(|error| (ErrorKind::Protocol, error.to_string()))?;
    if let Some((manifest, order)) = manifest.as_ref().zip(files.next()) {
        let examiner = examiner.ok_or_else(|| {
            let why = "this program cannot examine plugins: its `main` calls `main_if_child` instead of `main_if_child_examining`";
            (ErrorKind::Unsupported, why.to_owned())
        })?;
        return examiner(order, source, manifest);
    }
    let loaded = source.load(manifest.as_ref(), Box::new(log));
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

/// Sends a log line to the host. If the host does not listen, warnings and errors go to standard error; the host stores the last part of that output.
fn log(level: Level, target: &str, message: &str) {
    if !super::log::send(level, target, message) && level <= Level::Warn {
        // A write error is ignored: it cannot be reported.
        let _ = writeln!(io::stderr(), "{target}: {message}");
    }
}
