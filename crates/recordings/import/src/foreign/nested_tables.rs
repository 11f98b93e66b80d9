//! Parquet and Arrow as tables, with nested cells and pictures.

use std::path::Path;
use std::sync::Arc;

use serde_json::Value;
use taceva_tables::{ArrowTable, ColumnKind, ParquetTable, TableError};

use super::byte_pictures::{ByteColumns, EncodedPictures};
use super::columns::{ColumnSource, PictureColumn, PictureKind};
use super::pictures::Pictures;
use super::said;
use crate::frame_names::FrameNames;
use taceva_dataset::internal::ImageKind;

/// Parquet or Arrow table; both readers have the same methods.
pub(super) trait NestedTable: ByteColumns + 'static {
    fn of_file(path: &Path) -> Result<Self, TableError>;
    fn all_names(&self) -> Vec<String>;
    /// Metadata of the file under `key`, outside the schema.
    fn beside(&self, key: &str) -> Option<&str>;
}

macro_rules! nested_table {
    ($table:ty) => {
        impl NestedTable for $table {
            fn of_file(path: &Path) -> Result<Self, TableError> {
                Self::open(path)
            }

            fn all_names(&self) -> Vec<String> {
                self.names()
            }

            fn beside(&self, key: &str) -> Option<&str> {
                self.metadata(key)
            }
        }
    };
}

nested_table!(ParquetTable);
nested_table!(ArrowTable);

/// Rows of a Parquet or Arrow table, whose cells may be nested.
#[derive(Debug)]
pub(super) struct NestedRows<T> {
    table: Arc<T>,
}

impl<T: NestedTable> NestedRows<T> {
    pub(super) fn open(path: &Path) -> Result<NestedRows<T>, String> {
        let table = T::of_file(path).map_err(|error| said(path, &error))?;
        Ok(NestedRows {
            table: Arc::new(table),
        })
    }
}

impl<T: NestedTable> ColumnSource for NestedRows<T> {
    fn rows(&self) -> usize {
        usize::try_from(self.table.count()).unwrap_or(usize::MAX)
    }

    fn names(&self) -> Vec<String> {
        self.table.all_names()
    }

    fn has(&self, name: &str) -> bool {
        self.table.all_names().iter().any(|known| known == name)
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
            let _ = self.table.visit(name, &[0], &mut |_, bytes| {
                is_encoded = bytes.is_some_and(|bytes| ImageKind::of(&bytes).is_some());
                Ok(())
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

    /// Class lists as Hugging Face writes them: `{"info": {"features": {"label": {"names": […]}}}}`.
    fn classes(&self) -> Vec<(String, Vec<String>)> {
        let stated = self.table.beside("huggingface");
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
                "pictures in a table of this form are encoded: name their column by `bytes`"
                    .to_owned(),
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
