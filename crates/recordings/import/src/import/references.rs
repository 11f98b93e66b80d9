//! Pictures without contact that rows name each for themselves.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::map::reference_attribute;
use crate::source_folder::SourceFolder;
use taceva_dataset::{DatasetError, Place, Table};

/// The picture without contact of each kept row, relative to the folder of the lab.
#[derive(Debug, Default)]
pub(super) struct References {
    of_rows: Vec<Option<String>>,
}

impl References {
    /// Takes what a kept row names, relative to `base`; nothing where its cell is empty.
    ///
    /// # Errors
    /// [`DatasetError::Path`] if there is no such file inside the folder.
    pub(super) fn take(
        &mut self,
        folder: &SourceFolder,
        base: &Path,
        name: &str,
        named_at: Place,
    ) -> Result<(), DatasetError> {
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

    /// The files.
    pub(super) fn paths(&self, folder: &SourceFolder) -> BTreeSet<PathBuf> {
        let named = self.of_rows.iter().flatten();
        named.map(|name| folder.path().join(name)).collect()
    }

    /// The one of `view` that every row names; where they differ, or some row names none, each becomes an attribute of `table`.
    pub(super) fn settle(
        self,
        folder: &SourceFolder,
        view: Option<&str>,
        table: &mut Table,
    ) -> Result<Settled, DatasetError> {
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

/// What rows name as pictures without contact.
#[derive(Debug, Default)]
pub(super) struct Settled {
    /// The one of all rows.
    pub(super) reference: Option<PathBuf>,
    /// How many different ones there are instead.
    pub(super) different: usize,
}
