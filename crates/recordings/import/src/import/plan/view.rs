//! The pictures of one view as they are read.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::foreign::{DepthPixels, Pictures};
use crate::import::frame_plan::PlannedFrame;
use crate::import::map::FrameMap;
use crate::import::references::References;

/// The pictures of one view as they are read.
pub(super) struct ViewReading<'a> {
    pub(super) map: &'a FrameMap,
    /// The folder that its pictures are relative to, of the table that is being read.
    pub(super) base: PathBuf,
    /// The pixels of a depth map that the clips of that table are.
    pub(super) depth: Option<DepthPixels>,
    /// The files with pictures in them that rows named.
    pub(super) opened: BTreeMap<PathBuf, Arc<dyn Pictures>>,
    /// Pictures that rows have by their own number, as the map names them, each with the table of these rows.
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

    /// The folder of what a table names: beside it, unless the map says a folder.
    pub(super) fn beside(&self, named_by: Option<&Path>) -> PathBuf {
        match self.map.folder {
            None => named_by.unwrap_or(&self.base).to_owned(),
            Some(_) => self.base.clone(),
        }
    }
}
