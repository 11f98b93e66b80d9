//! Where the tables of a plugin come from: a library that the loader maps, or a table that the program made itself.

use std::path::PathBuf;
use std::sync::Arc;

use taceva_abi as abi;

use super::{Image, Library, LoadError, Log};
use crate::manifest::Manifest;
use crate::offer::Offer;

/// A table that the program itself made, by which a runtime of another language offers its objects as a library offers its devices.
#[derive(Clone, Debug)]
pub struct Linked {
    table: &'static abi::Plugin,
    path: PathBuf,
}

impl Linked {
    /// The plugin of `table`, which was made of the code at `path`. Its functions are called as those of a loaded library are.
    pub fn new(table: &'static abi::Plugin, path: PathBuf) -> Linked {
        Linked { table, path }
    }

    /// What it offers and needs, as a manifest would say it.
    ///
    /// # Errors
    /// [`LoadError`] if its tables say what no manifest can.
    pub fn offer(&self) -> Result<Offer, LoadError> {
        let library = self.load(None, Box::new(|_, _, _| {}))?;
        library.offer().map_err(|problem| problem.of(&self.path))
    }

    fn load(&self, manifest: Option<&Manifest>, log: Log) -> Result<Arc<Library>, LoadError> {
        Library::of_symbol(std::ptr::from_ref(self.table), &self.path, manifest, log)
    }
}

/// Where the tables of a plugin come from.
#[derive(Debug)]
pub enum Source {
    /// A file that was read.
    Image(Image),
    /// A table of this program.
    Linked(Linked),
}

impl Source {
    /// Loads it, for `manifest` if there is one.
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
