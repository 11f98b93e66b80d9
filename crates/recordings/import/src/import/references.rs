//! Pictures without contact that the rows name.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::map::reference_attribute;
use crate::error::ImportError;
use crate::source_folder::SourceFolder;
use taceva_dataset::{Place, Table};

/// Paths of the pictures without contact, one for each kept row, relative to the lab's folder.
#[derive(Debug, Default)]
pub(super) struct References {
    of_rows: Vec<Option<String>>,
}

impl References {
    /// Adds the picture that a kept row names, relative to `base`. An empty cell adds none.
    ///
    /// # Errors
    /// [`ImportError::Named`] if the file does not exist inside the folder.
    pub(super) fn take(
        &mut self,
        folder: &SourceFolder,
        base: &Path,
        name: &str,
        named_at: Place,
    ) -> Result<(), ImportError> {
        let found = match name {
            "" => None,
            name => {
                let path = folder.file(base, name);
                let path = path.map_err(|error| error.named_at(named_at))?;
                Some(folder.inside(&path, ""))
            }
        };
        self.of_rows.push(found);
        Ok(())
    }

    /// Distinct paths of the pictures without contact, inside `folder`.
    pub(super) fn paths(&self, folder: &SourceFolder) -> BTreeSet<PathBuf> {
        let named = self.of_rows.iter().flatten();
        named.map(|name| folder.path().join(name)).collect()
    }

    /// Returns the picture without contact of `view` if every row names the same picture. Otherwise stores the names as an attribute of `table`.
    pub(super) fn settle(
        self,
        folder: &SourceFolder,
        view: Option<&str>,
        table: &mut Table,
    ) -> Result<Settled, ImportError> {
        let named: BTreeSet<&String> = self.of_rows.iter().flatten().collect();
        let different = named.len();
        match (named.first(), self.of_rows.contains(&None)) {
            (None, _) => Ok(Settled::default()),
            (Some(only), false) if different == 1 => Ok(Settled {
                reference: Some(folder.file(folder.path(), only)?),
                different: 0,
            }),
            _ => {
                table.push_attribute(reference_attribute(view), self.of_rows);
                Ok(Settled {
                    reference: None,
                    different,
                })
            }
        }
    }
}

/// Result of comparing the pictures without contact of all rows.
#[derive(Debug, Default)]
pub(super) struct Settled {
    /// Picture that all rows share; `None` if rows differ.
    pub(super) reference: Option<PathBuf>,
    /// Number of different pictures; 0 if all rows share one.
    pub(super) different: usize,
}
