//! Source of a plugin's tables: a loaded library, or a table that the program built.

use std::path::PathBuf;
use std::sync::Arc;

use taceva_abi as abi;

use super::{Image, Library, LoadError, Log};
use crate::manifest::Manifest;
use crate::offer::Offer;

/// Table that this program built. With it, a runtime of another language provides its objects as devices.
#[derive(Clone, Debug)]
pub struct Linked {
    table: &'static abi::Plugin,
    path: PathBuf,
}

impl Linked {
    /// Wraps `table`, which was built from the code at `path`. Its functions are called like the functions of a loaded library.
    pub fn new(table: &'static abi::Plugin, path: PathBuf) -> Linked {
        Linked { table, path }
    }

    /// Lists drivers, estimators and needs of the table, as in a manifest.
    ///
    /// # Errors
    /// [`LoadError`] if the tables contain values that a manifest cannot express.
    pub fn offer(&self) -> Result<Offer, LoadError> {
        let library = self.load(None, Box::new(|_, _, _| {}))?;
        library.offer().map_err(|problem| problem.of(&self.path))
    }

    fn load(&self, manifest: Option<&Manifest>, log: Log) -> Result<Arc<Library>, LoadError> {
        Library::of_symbol(std::ptr::from_ref(self.table), &self.path, manifest, log)
    }
}

/// Source of a plugin's tables.
#[derive(Debug)]
pub enum Source {
    /// A copied library file.
    Image(Image),
    /// A table that this program built.
    Linked(Linked),
}

impl Source {
    /// Loads the tables and compares them with `manifest`, if given.
    ///
    /// # Errors
    /// [`LoadError`], as by [`Library::load`].
    pub fn load(&self, manifest: Option<&Manifest>, log: Log) -> Result<Arc<Library>, LoadError> {
        match self {
            Source::Image(image) => Library::begin(image, manifest, log),
            Source::Linked(linked) => linked.load(manifest, log),
        }
    }
}
