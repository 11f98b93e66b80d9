//! LeRobot dataset as a table: a folder of Parquet files, with the frames of clips.

use std::path::Path;
use std::sync::Arc;

use taceva_tables::{ColumnKind, DepthCodes, LeRobot};

use super::byte_pictures::{ByteColumns, EncodedPictures};
use super::columns::{ColumnSource, PictureColumn, PictureKind};
use super::pictures::Pictures;
use super::said;
use crate::frame_names::FrameNames;

/// Rows of all episodes, in order.
#[derive(Debug)]
pub(super) struct LeRobotRows {
    dataset: Arc<LeRobot>,
}

impl LeRobotRows {
    pub(super) fn open(folder: &Path) -> Result<LeRobotRows, String> {
        let dataset = LeRobot::open(folder).map_err(|error| said(folder, &error))?;
        Ok(LeRobotRows {
            dataset: Arc::new(dataset),
        })
    }
}

impl ColumnSource for LeRobotRows {
    fn rows(&self) -> usize {
        usize::try_from(self.dataset.rows()).unwrap_or(usize::MAX)
    }

    fn names(&self) -> Vec<String> {
        self.dataset.names().to_vec()
    }

    fn has(&self, name: &str) -> bool {
        self.dataset.names().iter().any(|known| known == name)
    }

    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        self.dataset.texts(names)
    }

    fn time_unit(&self, name: &str) -> Option<&'static str> {
        self.dataset.unit_of_times(name)
    }

    fn holds_integers(&self, name: &str) -> bool {
        self.dataset.kind_within(name) == Some(ColumnKind::Integer)
    }

    /// Columns of pictures, then columns of depth maps with known codes.
    fn picture_columns(&self) -> Vec<PictureColumn> {
        let features = self.dataset.features().iter();
        let features = features.filter_map(|feature| {
            let kind = match (feature.dtype.as_str(), feature.is_depth, feature.depth) {
                ("video", true, Some(codes)) => PictureKind::Depth(codes),
                (_, true, _) => return None,
                ("video", ..) => PictureKind::Clip,
                ("image", ..) => PictureKind::Encoded,
                _ => return None,
            };
            Some(PictureColumn {
                name: feature.name.clone(),
                kind,
                order: None,
            })
        });
        let mut columns: Vec<PictureColumn> = features.collect();
        columns.sort_by_key(|column| matches!(column.kind, PictureKind::Depth(_)));
        columns
    }

    /// Features that are not read: depth maps with unknown codes.
    fn unread(&self) -> Vec<String> {
        let features = self.dataset.features().iter();
        let depths = features.filter(|feature| {
            feature.is_depth && feature.depth.is_none() && feature.dtype == "video"
        });
        let refused = depths.filter_map(|feature| self.dataset.video(&feature.name).err());
        refused
            .map(|error| said(self.dataset.folder(), &error))
            .collect()
    }

    fn depth(&self, key: &str) -> Option<DepthCodes> {
        let mut features = self.dataset.features().iter();
        features.find(|feature| feature.name == key)?.depth
    }

    fn element_names(&self, column: &str) -> Vec<String> {
        let mut features = self.dataset.features().iter();
        let found = features.find(|feature| feature.name == column);
        found
            .map(|feature| feature.names.clone())
            .unwrap_or_default()
    }

    fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        let FrameNames::Bytes(feature) = names else {
            return Err("name the feature of LeRobot frames by `video` or `bytes`".to_owned());
        };
        Ok(Arc::new(EncodedPictures {
            table: Arc::clone(&self.dataset),
            column: feature.clone(),
        }))
    }

    fn clips(&self, key: &str) -> Result<Vec<(String, u64)>, String> {
        let frames = self.dataset.video(key);
        let frames = frames.map_err(|error| said(self.dataset.folder(), &error))?;
        let of_rows = (0..self.dataset.rows()).map(|row| {
            let (path, frame) = frames
                .at(row)
                .ok_or_else(|| format!("row {row} has no frame in `{key}`"))?;
            Ok((path.to_string_lossy().into_owned(), frame))
        });
        of_rows.collect()
    }
}
