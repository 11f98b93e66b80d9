//! Samples and columns of the tables in a bundle, each of which is read once.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;

use taceva_evaluate::read_table;

use crate::columns::{TableColumns, bounded};
use crate::manifest::Manifest;
use crate::sample_digest::StudySamples;
use crate::source::Source;

/// Samples and columns of the tables in a bundle.
pub(crate) struct TableFacts<'a> {
    /// Samples by the name of their table, or the reason why the table cannot be read.
    samples: BTreeMap<&'a str, Result<StudySamples, String>>,
    /// Tables that readers of Croissant can load.
    pub(crate) columns: Vec<TableColumns>,
}

impl<'a> TableFacts<'a> {
    /// Facts of the tables behind the studies of `manifest`.
    pub(crate) fn of(
        source: &Source,
        manifest: &'a Manifest,
        jobs: NonZeroUsize,
    ) -> TableFacts<'a> {
        let mut samples = BTreeMap::new();
        let studies = manifest.studies.iter();
        let names = studies.flat_map(|files| {
            let table = files.sample_table();
            files
                .table_names()
                .map(move |name| (name.as_str(), table == Some(name.as_str())))
        });
        let columns = bounded(names.filter_map(|(name, has_samples)| {
            let path = source.path(name);
            let table = match read_table(&path, jobs) {
                Ok((table, _)) => table,
                Err(error) => {
                    let reason = source.as_named(&error.to_string());
                    samples.insert(name, Err(reason));
                    return None;
                }
            };
            if has_samples {
                samples.insert(name, Ok(StudySamples::of_read(&table)));
            }
            TableColumns::of_read(&table, &path, name)
        }));
        TableFacts { samples, columns }
    }

    /// Samples in the table called `name`.
    ///
    /// # Errors
    /// The reason why the table cannot be read.
    pub(crate) fn samples(&self, name: &str) -> Result<&StudySamples, &str> {
        match self.samples.get(name) {
            Some(Ok(samples)) => Ok(samples),
            Some(Err(reason)) => Err(reason.as_str()),
            None => Err("no table of samples"),
        }
    }
}
