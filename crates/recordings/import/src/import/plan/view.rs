//! Pictures of one view during reading.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::foreign::{DepthPixels, Pictures};
use crate::import::frame_plan::PlannedFrame;
use crate::import::map::FrameMap;
use crate::import::references::References;

/// Pictures of one view during reading.
pub(super) struct ViewReading<'a> {
    pub(super) map: &'a FrameMap,
    /// Base folder of pictures for the table being read.
    pub(super) base: PathBuf,
    /// Pixels of the depth map in that table's clips.
    pub(super) depth: Option<DepthPixels>,
    /// Opened files with pictures.
    pub(super) opened: BTreeMap<PathBuf, Arc<dyn Pictures>>,
    /// Pictures used by row number, as the map names them, each with its table.
    pub(super) counted: BTreeMap<String, PathBuf>,
    pub(super) frames: Vec<PlannedFrame>,
    pub(super) references: References,
}

impl<'a> ViewReading<'a> {
    pub(super) fn new(map: &'a FrameMap) -> ViewReading<'a> {
        ViewReading {
            map,
            base: PathBuf::new(),
            depth: None,
            opened: BTreeMap::new(),
            counted: BTreeMap::new(),
            frames: Vec::new(),
            references: References::default(),
        }
    }

    /// Base folder of named files: beside the table, unless the map states a folder.
    pub(super) fn beside(&self, named_by: Option<&Path>) -> PathBuf {
        match self.map.folder {
            None => named_by.unwrap_or(&self.base).to_owned(),
            Some(_) => self.base.clone(),
        }
    }
}
