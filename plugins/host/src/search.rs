//! Search for plugins by their manifests. The search opens no library. Every rejected plugin is kept with its reason.

mod environment;
mod place;
mod rejection;
mod write_access;

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use taceva_core::{shown, suggestion};

use taceva_abi::ABI_MAJOR;

pub use self::place::{Place, SearchPath, user_config_file};
pub use self::rejection::{Reason, ReasonKind, Rejection};
use self::write_access::Writable;
use crate::id::PluginId;
use crate::manifest::{self, LibraryFile, Manifest, PythonModule};
use crate::python::Interpreter;
use crate::wire_version::WIRE;

/// File name of manifests.
pub(crate) const MANIFEST: &str = "plugin.toml";

/// A plugin that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Plugin {
    /// Manifest of the plugin.
    pub manifest: Manifest,
    /// Text of the manifest.
    pub text: String,
    /// Folder of the manifest, with links resolved.
    pub folder: PathBuf,
    /// Place where the plugin was found.
    pub place: Place,
    /// Code of the plugin.
    pub code: Code,
    /// For a Python module: the interpreter of its environment, or the first known interpreter. `None` for a library.
    pub interpreter: Option<Interpreter>,
    /// Interpreters that were named but rejected, with the reasons.
    rejected_interpreters: Vec<String>,
}

/// Code of a plugin.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Code {
    /// Library for this platform.
    Library(LibraryFile),
    /// Python module in the folder of the manifest.
    Python(PythonModule),
}

impl Plugin {
    /// Library of the plugin; `None` for a Python module.
    pub fn library(&self) -> Option<&LibraryFile> {
        match &self.code {
            Code::Library(library) => Some(library),
            Code::Python(_) => None,
        }
    }

    /// Python module of the plugin; `None` for a library.
    pub fn module(&self) -> Option<&PythonModule> {
        match &self.code {
            Code::Library(_) => None,
            Code::Python(module) => Some(module),
        }
    }

    /// Id of the plugin.
    pub fn id(&self) -> &PluginId {
        &self.manifest.id
    }

    /// Error for a Python module without an interpreter.
    #[cfg(target_os = "linux")]
    pub(crate) fn no_interpreter(&self) -> crate::python::PythonError {
        crate::python::PythonError::NoInterpreter {
            rejected: self.rejected_interpreters.clone(),
        }
    }
}

/// Result of a search.
#[derive(Debug, Default)]
pub struct Plugins {
    found: BTreeMap<PluginId, Plugin>,
    /// Rejected plugins and folders, in the order in which they were found.
    pub rejections: Vec<Rejection>,
    path: SearchPath,
}

impl Plugins {
    /// Searches `path`. Plugins with the same id are all rejected, unless `prefer` lists the folder of one of them, or a folder of the command line
    /// ([`Place::Given`]) contains exactly one of them.
    pub fn search(path: SearchPath, prefer: &[PathBuf]) -> Plugins {
        Plugins::search_with(path, prefer, &[])
    }

    /// As [`search`](Plugins::search), and also searches the environments of `interpreters`. The first interpreter that answers runs the Python
    /// plugins that are found outside these environments.
    pub fn search_with(path: SearchPath, prefer: &[PathBuf], interpreters: &[PathBuf]) -> Plugins {
        let mut searching = Searching::default();
        for interpreter in interpreters {
            searching.environment(interpreter);
        }
        for (place, folder) in path.folders() {
            searching.folder(place, folder);
        }
        let mut plugins = Plugins {
            found: BTreeMap::new(),
            rejections: searching.rejections,
            path,
        };
        for (id, alike) in searching.found {
            plugins.settle(id, alike, prefer);
        }
        plugins
    }

    /// Plugins, sorted by id.
    pub fn iter(&self) -> impl Iterator<Item = &Plugin> {
        self.found.values()
    }

    /// Number of plugins.
    pub fn len(&self) -> usize {
        self.found.len()
    }

    /// True if there are no plugins.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Returns the plugin `id`.
    ///
    /// # Errors
    /// [`NotFound`] with the nearest id, the searched folders and the rejections.
    pub fn get(&self, id: &str) -> Result<&Plugin, NotFound> {
        self.found.get(id).ok_or_else(|| {
            let known: Vec<&str> = self.found.keys().map(PluginId::as_str).collect();
            let mut trail = String::new();
            for (place, folder) in self.path.folders() {
                trail.push_str(&format!("\n  looked in {} ({place})", shown(folder)));
            }
            for rejection in &self.rejections {
                trail.push_str(&format!("\n  rejected {rejection}"));
            }
            NotFound {
                id: id.to_owned(),
                help: match known.as_slice() {
                    [] => "no plugin was found".to_owned(),
                    known => suggestion(id, known),
                },
                trail,
            }
        })
    }

    fn settle(&mut self, id: PluginId, mut alike: Vec<Plugin>, prefer: &[PathBuf]) {
        let preferred = |plugin: &Plugin| prefer.contains(&plugin.folder);
        let is_given = |plugin: &Plugin| plugin.place == Place::Given;
        let given = || {
            let position = alike.iter().position(is_given)?;
            (!alike[position + 1..].iter().any(is_given)).then_some(position)
        };
        let chosen = match alike.len() {
            1 => Some(0),
            _ => alike.iter().position(preferred).or_else(given),
        };
        let chosen = chosen.map(|position| alike.remove(position));
        let manifests: Vec<PathBuf> = (alike.iter())
            .map(|plugin| plugin.folder.join(MANIFEST))
            .collect();
        for (position, plugin) in alike.iter().enumerate() {
            let other = match &chosen {
                Some(chosen) => chosen.folder.join(MANIFEST),
                None => manifests[usize::from(position == 0)].clone(),
            };
            let id = id.clone();
            let reason = Reason::Duplicate { id, other };
            self.rejections
                .push(reason.of(&manifests[position], plugin.place));
        }
        if let Some(chosen) = chosen {
            self.found.insert(id, chosen);
        }
    }
}

/// Error for an unknown plugin id.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no plugin has the id {id:?}, {help}{trail}")]
pub struct NotFound {
    id: String,
    help: String,
    trail: String,
}

#[derive(Default)]
struct Searching {
    found: BTreeMap<PluginId, Vec<Plugin>>,
    rejections: Vec<Rejection>,
    seen: BTreeSet<PathBuf>,
    interpreters: Vec<Interpreter>,
    rejected_interpreters: Vec<String>,
    writable: Writable,
}

impl Searching {
    fn folder(&mut self, place: Place, folder: &Path) {
        match self.manifests(folder) {
            Ok(manifests) => {
                for manifest in manifests {
                    self.manifest(place, &manifest, None);
                }
            }
            // Missing folders are ignored, except those from the command line.
            Err(Reason::Unreadable(error))
                if error.kind() == io::ErrorKind::NotFound && place != Place::Given => {}
            Err(reason) => self.rejections.push(reason.of(folder, place)),
        }
    }

    /// Manifest in `folder`; without this manifest, the manifests in the subfolders, sorted by path.
    fn manifests(&mut self, folder: &Path) -> Result<Vec<PathBuf>, Reason> {
        if !folder.is_absolute() {
            return Err(Reason::Relative);
        }
        let folder = fs::canonicalize(folder).map_err(Reason::Unreadable)?;
        if let Some(path) = self.writable.by_all(&folder).map_err(Reason::Unreadable)? {
            return Err(Reason::WorldWritable { path });
        }
        let own = folder.join(MANIFEST);
        if own.symlink_metadata().is_ok() {
            return Ok(vec![own]);
        }
        let mut manifests = Vec::new();
        for entry in fs::read_dir(&folder).map_err(Reason::Unreadable)? {
            let entry = entry.map_err(Reason::Unreadable)?;
            // Hidden folders are unfinished installations.
            if entry.file_name().as_encoded_bytes().starts_with(b".") {
                continue;
            }
            let manifest = entry.path().join(MANIFEST);
            if manifest.symlink_metadata().is_ok() {
                manifests.push(manifest);
            }
        }
        manifests.sort();
        Ok(manifests)
    }

    /// Reads a manifest, in the environment of the interpreter `within` or elsewhere. Returns the plugin's id; `None` if it was rejected or found
    /// before.
    fn manifest(
        &mut self,
        place: Place,
        manifest: &Path,
        within: Option<&Interpreter>,
    ) -> Option<String> {
        let path = match fs::canonicalize(manifest) {
            Ok(path) => path,
            Err(error) => {
                self.rejections
                    .push(Reason::Unreadable(error).of(manifest, place));
                return None;
            }
        };
        if !self.seen.insert(path.clone()) {
            return None;
        }
        match self.plugin(place, &path) {
            Ok(mut plugin) => {
                let first = || self.interpreters.first();
                let known = plugin.module().and_then(|_| within.or_else(first));
                plugin.interpreter = known.cloned();
                let id = plugin.id().clone();
                self.found.entry(id.clone()).or_default().push(plugin);
                Some(id.to_string())
            }
            Err(reason) => {
                self.rejections.push(reason.of(&path, place));
                None
            }
        }
    }

    fn plugin(&mut self, place: Place, path: &Path) -> Result<Plugin, Reason> {
        let text = read(path)?;
        if let Some(path) = self.writable.by_all(path).map_err(Reason::Unreadable)? {
            return Err(Reason::WorldWritable { path });
        }
        let manifest = Manifest::parse(&text).map_err(Reason::Manifest)?;
        if manifest.abi.major != ABI_MAJOR {
            return Err(Reason::Abi {
                found: manifest.abi,
            });
        }
        let folder = path.parent().unwrap_or(path).to_owned();
        let code = self.code(&manifest, &folder)?;
        Ok(Plugin {
            manifest,
            text,
            folder,
            place,
            code,
            interpreter: None,
            rejected_interpreters: self.rejected_interpreters.clone(),
        })
    }

    /// Code of the plugin, checked without opening it.
    fn code(&mut self, manifest: &Manifest, folder: &Path) -> Result<Code, Reason> {
        if let Some(module) = manifest.module() {
            if module.wire != WIRE {
                return Err(Reason::Wire { found: module.wire });
            }
            self.package(folder, &module.name)?;
            return Ok(Code::Python(module.clone()));
        }
        let platform = manifest::platform();
        let Some(library) = manifest.library(&platform).cloned() else {
            let has = manifest.platforms().map(str::to_owned).collect();
            return Err(Reason::Platform { platform, has });
        };
        self.library(&folder.join(&library.path))?;
        Ok(Code::Library(library))
    }

    /// Checks the library file without opening it.
    fn library(&mut self, library: &Path) -> Result<(), Reason> {
        let refused = |problem: String| Reason::Library {
            library: library.to_owned(),
            problem,
        };
        let io = |error: io::Error| refused(error.to_string());
        let real = fs::canonicalize(library).map_err(io)?;
        if !fs::metadata(&real).map_err(io)?.is_file() {
            return Err(refused("not a regular file".to_owned()));
        }
        match self.writable.by_all(&real).map_err(io)? {
            Some(path) => Err(Reason::WorldWritable { path }),
            None => Ok(()),
        }
    }
}

fn read(path: &Path) -> Result<String, Reason> {
    // Checked before opening, because opening a pipe would block.
    if !fs::metadata(path).map_err(Reason::Unreadable)?.is_file() {
        return Err(Reason::NotAFile);
    }
    let most = manifest::BYTES_MAX;
    let file = File::open(path).map_err(Reason::Unreadable)?;
    let mut bytes = Vec::new();
    file.take(most as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(Reason::Unreadable)?;
    match String::from_utf8(bytes) {
        Ok(text) if text.len() <= most => Ok(text),
        _ => Err(Reason::NotText),
    }
}

#[cfg(test)]
mod tests;
