//! Loads a library: reads its data, compares it with the manifest and initialises it. The library is never unloaded.

#![expect(
    unsafe_code,
    reason = "a library is loaded, its symbol read and its functions called"
)]

mod elf;
mod entry;
mod error;
mod host;
mod image;
mod memory_map;
mod offer;
mod source;

use std::collections::BTreeMap;
use std::ffi::c_void;
use std::fs::File;
use std::mem::{MaybeUninit, offset_of};
use std::os::fd::{AsRawFd, IntoRawFd};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use taceva_core::shown;

use libloading::os::unix::{Library as Loaded, RTLD_LOCAL, RTLD_NOW};
use taceva_abi as abi;
use taceva_core::{DriverError, DriverKey, ErrorKind};

pub use self::entry::Entry;
pub(crate) use self::entry::{NEW_FORCE_MINOR, Place};
pub use self::error::{LoadError, LoadProblem};
pub use self::host::{Level, Log};
pub use self::image::Image;
pub(crate) use self::image::LENGTH_MAX;
use self::memory_map::Mapped;
pub use self::source::Linked;
pub use self::source::Source;
use crate::call::{call, table};
use crate::id::PluginId;
use crate::manifest::Manifest;

/// Flag that keeps the code of the library mapped. Threads and thread-locals of the library may exist longer than every handle.
const RTLD_NODELETE: i32 = if cfg!(target_os = "linux") {
    0x1000
} else {
    0x80
};

static LOADED: AtomicU64 = AtomicU64::new(0);

/// Number of libraries that this process has passed to the system's loader.
pub fn libraries_loaded() -> u64 {
    LOADED.load(Ordering::Relaxed)
}

/// Library of a plugin that is loaded, initialised and consistent with its manifest.
pub struct Library {
    id: PluginId,
    path: PathBuf,
    plugin: abi::Plugin,
    entries: BTreeMap<DriverKey, Entry>,
}

// SAFETY: the fields are constant data of the library, and functions that the interface allows from any thread ([any]).
unsafe impl Send for Library {}
// SAFETY: as above.
unsafe impl Sync for Library {}

impl Library {
    /// Loads `image`, compares it with `manifest` and initialises it. `log` receives the plugin's log lines.
    ///
    /// Constructors of the library run before any check. Load only trusted libraries here, and other libraries in a confined child.
    ///
    /// # Errors
    /// [`LoadError`] if the file cannot be loaded, is not a plugin, is of another version, or contradicts the manifest.
    pub fn load(image: &Image, manifest: &Manifest, log: Log) -> Result<Arc<Library>, LoadError> {
        Library::begin(image, Some(manifest), log)
    }

    fn begin(
        image: &Image,
        manifest: Option<&Manifest>,
        log: Log,
    ) -> Result<Arc<Library>, LoadError> {
        let failed = |problem: LoadProblem| problem.of(image.path());
        let symbol = open(image).map_err(failed)?;
        Library::of_symbol(symbol, image.path(), manifest, log)
    }

    /// Compares the library whose table is at `symbol` with `manifest`, and initialises the library.
    fn of_symbol(
        symbol: *const abi::Plugin,
        path: &std::path::Path,
        manifest: Option<&Manifest>,
        log: Log,
    ) -> Result<Arc<Library>, LoadError> {
        let failed = |problem: LoadProblem| problem.of(path);
        let mapped = Mapped::now().ok();
        let plugin = read(symbol, mapped.as_ref()).map_err(failed)?;
        let id = identity(&plugin, manifest, mapped.as_ref()).map_err(failed)?;
        if let Some(init) = plugin.init {
            let host = host::table(log);
            // SAFETY: [once, first], with a host and an error that outlive the call.
            call(|error| unsafe { init(host, error) })
                .map_err(|failure| failed(LoadProblem::Init(failure)))?;
        }
        let mut library = Library {
            id,
            path: path.to_owned(),
            plugin,
            entries: BTreeMap::new(),
        };
        // From here on, a failure drops `library`, which calls `deinit`.
        library.entries = entry::entries(&library, manifest).map_err(failed)?;
        Ok(Arc::new(library))
    }

    /// Id of the plugin.
    pub fn id(&self) -> &PluginId {
        &self.id
    }

    /// Entry `key` of the factory `place`.
    pub(crate) fn entry(
        &self,
        key: &DriverKey,
        place: Place,
        doing: &'static str,
    ) -> Result<&Entry, DriverError> {
        let entry = self.entries.get(key);
        entry.filter(|entry| entry.place == place).ok_or_else(|| {
            let why = format!("the plugin `{}` has no {place} of that name", self.id);
            DriverError::new(ErrorKind::NotFound, key, doing).because(why)
        })
    }

    /// Entry of the driver `key` of any kind.
    pub(crate) fn driver(
        &self,
        key: &DriverKey,
        doing: &'static str,
    ) -> Result<&Entry, DriverError> {
        let entry = self.entries.get(key);
        let is_driver = |entry: &&Entry| entry.place != Place::Estimator;
        entry.filter(is_driver).ok_or_else(|| {
            let why = format!("the plugin `{}` has no driver of that name", self.id);
            DriverError::new(ErrorKind::NotFound, key, doing).because(why)
        })
    }

    /// Entry `key` of any factory; `None` for an unknown key.
    pub fn any(&self, key: &DriverKey) -> Option<&Entry> {
        self.entries.get(key)
    }

    /// Plugin table that the library exports.
    pub fn plugin(&self) -> &abi::Plugin {
        &self.plugin
    }

    /// Factory of a kind; NULL if the plugin has none.
    fn factory(&self, id: &str) -> Result<*const c_void, LoadProblem> {
        let factory = self
            .plugin
            .factory
            .ok_or(LoadProblem::Lacks { what: "factory" })?;
        // SAFETY: [any], after `init`, with a text that outlives the call.
        Ok(unsafe { factory(abi::Text::from(id)) })
    }

    /// Minor version of the interface that the library was built for.
    pub(crate) fn minor(&self) -> u32 {
        self.plugin.abi_minor
    }

    fn device_factory(&self, id: &str) -> Result<Option<abi::Factory>, LoadProblem> {
        let factory = self.factory(id)?;
        if factory.is_null() {
            return Ok(None);
        }
        // SAFETY: the interface specifies a `taceva_factory` for these ids.
        let read = unsafe { table::<abi::Factory>(factory) };
        read.map(Some)
            .map_err(|failure| LoadProblem::Table(failure.message()))
    }

    fn estimator_factory(&self) -> Result<Option<abi::EstimatorFactory>, LoadProblem> {
        let factory = self.factory(abi::ESTIMATOR_FACTORY)?;
        if factory.is_null() {
            return Ok(None);
        }
        // SAFETY: the interface specifies a `taceva_estimator_factory` for this id.
        let read = unsafe { table::<abi::EstimatorFactory>(factory) };
        read.map(Some)
            .map_err(|failure| LoadProblem::Table(failure.message()))
    }
}

impl Drop for Library {
    fn drop(&mut self) {
        if let Some(deinit) = self.plugin.deinit {
            // SAFETY: [once, last], after a successful `init`: every device and every rig holds the library, so all are closed.
            unsafe { deinit() };
        }
    }
}

impl std::fmt::Debug for Library {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Library({}, {})", self.id, shown(&self.path))
    }
}

/// Loads the image with the system's loader and finds the exported symbol.
fn open(image: &Image) -> Result<*const abi::Plugin, LoadProblem> {
    let memory = image.try_clone().map_err(LoadProblem::File)?;
    let name = format!("/proc/self/fd/{}", memory.as_raw_fd());
    let message = |error: libloading::Error| {
        // The loader's message contains a meaningless descriptor number, which is replaced.
        let words = std::error::Error::source(&error).map(ToString::to_string);
        let words = words.unwrap_or_else(|| error.to_string());
        crate::text::shown(&words.replace(&name, "the library"))
    };
    LOADED.fetch_add(1, Ordering::Relaxed);
    // SAFETY: its constructors are foreign code, and the caller allows them to run in this process.
    let loaded = unsafe { Loaded::open(Some(&name), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE) };
    let loaded = match loaded {
        Ok(loaded) => loaded,
        Err(error) => return Err(refused(&File::from(memory), message(error))),
    };
    // The descriptor stays open, because the loader identifies the library by its path.
    let _ = memory.into_raw_fd();
    let name_of_symbol = abi::ENTRY_SYMBOL.to_bytes_with_nul();
    // SAFETY: only the address is read; the table there is checked before use.
    let symbol = unsafe { loaded.get::<*const abi::Plugin>(name_of_symbol) };
    let symbol = symbol.map_err(|error| LoadProblem::Symbol(message(error)))?;
    let address = *symbol;
    // Forgets the handle, so the library is never unloaded.
    std::mem::forget(loaded);
    Ok(address)
}

/// Converts the loader's error, with a hint if the run path of `library` uses `$ORIGIN`.
fn refused(library: &File, message: String) -> LoadProblem {
    let run_path = elf::run_path(library);
    match run_path.filter(|path| path.contains("$ORIGIN") || path.contains("${ORIGIN}")) {
        Some(run_path) => LoadProblem::BesideItself {
            message,
            run_path: crate::text::shown(&run_path),
        },
        None => LoadProblem::Loader(message),
    }
}

/// Reads the exported symbol as data, without running code of the plugin.
fn read(symbol: *const abi::Plugin, mapped: Option<&Mapped>) -> Result<abi::Plugin, LoadProblem> {
    let what = "`taceva_plugin_v1`";
    // A confined child may not read its memory map. There, a bad address crashes only the child.
    let is_readable = |length: usize| {
        !symbol.is_null()
            && symbol.is_aligned()
            && mapped.is_none_or(|mapped| mapped.holds(symbol.addr(), length))
    };
    let begin = offset_of!(abi::Plugin, id);
    if !is_readable(begin) {
        return Err(LoadProblem::Address { what });
    }
    // SAFETY: aligned, and mapped up to the end of the four numbers.
    let [magic, size, major, _] = unsafe { symbol.cast::<[u32; 4]>().read() };
    if magic != abi::MAGIC {
        return Err(LoadProblem::Magic { found: magic });
    }
    if major != abi::ABI_MAJOR {
        return Err(LoadProblem::Major { found: major });
    }
    let size = usize::try_from(size).unwrap_or(usize::MAX);
    let least = offset_of!(abi::Plugin, factory) + size_of::<usize>();
    if size < least {
        return Err(LoadProblem::Size { found: size, least });
    }
    let known = size.min(size_of::<abi::Plugin>());
    if !is_readable(known) {
        return Err(LoadProblem::Address { what });
    }
    let mut copy = MaybeUninit::<abi::Plugin>::zeroed();
    // SAFETY: `known` bytes are mapped there and exist here.
    unsafe {
        std::ptr::copy_nonoverlapping(symbol.cast::<u8>(), copy.as_mut_ptr().cast::<u8>(), known);
    }
    // SAFETY: zero bytes are valid for its numbers, empty texts and optional functions.
    Ok(unsafe { copy.assume_init() })
}

/// Id of the library's plugin, checked against the manifest.
fn identity(
    plugin: &abi::Plugin,
    manifest: Option<&Manifest>,
    mapped: Option<&Mapped>,
) -> Result<PluginId, LoadProblem> {
    let id = text("`id`", plugin.id, mapped)?;
    let version = text("`version`", plugin.version, mapped)?;
    let Some(manifest) = manifest else {
        return id
            .parse()
            .map_err(|error| LoadProblem::Table(format!("its `id`, {error}")));
    };
    for (what, said, expected) in [
        ("`id`", id, manifest.id.as_str()),
        ("`version`", version, manifest.version.as_str()),
    ] {
        if said != expected {
            return Err(LoadProblem::Differs {
                what: what.to_owned(),
                manifest: format!("`{expected}`"),
                library: format!("`{}`", crate::text::shown(said)),
                module: manifest.module().map(|module| module.name.clone()),
            });
        }
    }
    Ok(manifest.id.clone())
}

/// Reads a text of the exported symbol.
fn text(
    what: &'static str,
    said: abi::Text,
    mapped: Option<&Mapped>,
) -> Result<&'static str, LoadProblem> {
    let is_readable = mapped.is_none_or(|mapped| mapped.holds(said.data.addr(), said.length));
    if said.length > 0 && (said.data.is_null() || !is_readable) {
        return Err(LoadProblem::Address { what });
    }
    // SAFETY: mapped for its stated length, in constants of a library that is never unloaded.
    unsafe { said.to_str() }.map_err(|_| LoadProblem::Text { what })
}
