//! Parquet as a table, pictures in its cells too.

use std::path::Path;
use std::sync::Arc;

use serde_json::Value;
use taceva_tables::{ColumnKind, ParquetTable, TableError};

use super::byte_pictures::{ByteColumns, EncodedPictures};
use super::columns::{ColumnSource, PictureColumn, PictureKind};
use super::pictures::Pictures;
use super::said;
use crate::frame_names::FrameNames;
use taceva_dataset::internal::ImageKind;

/// The rows of a Parquet file.
#[derive(Debug)]
pub(super) struct ParquetRows {
    table: Arc<ParquetTable>,
}

impl ParquetRows {
    pub(super) fn open(path: &Path) -> Result<ParquetRows, String> {
        let table = ParquetTable::open(path).map_err(|error| said(path, &error))?;
        Ok(ParquetRows {
            table: Arc::new(table),
        })
    }
}

impl ColumnSource for ParquetRows {
    fn rows(&self) -> usize {
        usize::try_from(self.table.rows()).unwrap_or(usize::MAX)
    }

    fn names(&self) -> Vec<String> {
        self.table.names()
    }

    fn has(&self, name: &str) -> bool {
        self.table.names().iter().any(|known| known == name)
    }

    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        self.table.texts(names)
    }

    fn time_unit(&self, name: &str) -> Option<&'static str> {
        self.table.unit_of_times(name)
    }

    fn holds_integers(&self, name: &str) -> bool {
        self.table.kind_within(name) == Some(ColumnKind::Integer)
    }

    fn picture_columns(&self) -> Vec<PictureColumn> {
        let is_encoded = |name: &String| {
            let mut is_encoded = false;
            let _ = self.table.visit_bytes(name, &[0], &mut |_, bytes| {
                is_encoded = bytes.is_some_and(|bytes| ImageKind::of(&bytes).is_some());
                Ok::<(), TableError>(())
            });
            is_encoded
        };
        let names = self.names().into_iter().filter(is_encoded);
        names
            .map(|name| PictureColumn {
                name,
                kind: PictureKind::Encoded,
                order: None,
            })
            .collect()
    }

    /// As Hugging Face writes them: `{"info": {"features": {"label": {"names": […]}}}}`.
    fn classes(&self) -> Vec<(String, Vec<String>)> {
        let stated = self.table.metadata("huggingface");
        let stated: Option<Value> = stated.and_then(|text| serde_json::from_str(text).ok());
        let features = stated
            .as_ref()
            .and_then(|stated| stated.pointer("/info/features")?.as_object());
        let classes = features
            .into_iter()
            .flatten()
            .filter_map(|(name, feature)| {
                let names = feature.get("names")?.as_array()?.iter();
                let names = names.map(|name| name.as_str().map(str::to_owned));
                Some((name.clone(), names.collect::<Option<Vec<String>>>()?))
            });
        classes.collect()
    }

    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        let FrameNames::Bytes(column) = names else {
            return Err(
                "pictures in a Parquet file are encoded: `bytes` names their column".to_owned(),
            );
        };
        if !self.has(column) {
            let there = self.names().join(", ");
            return Err(format!(
                "no column `{column}` for the frames; the columns are {there}"
            ));
        }
        Ok(Arc::new(EncodedPictures {
            table: Arc::clone(&self.table),
            column: column.clone(),
        }))
    }
}
