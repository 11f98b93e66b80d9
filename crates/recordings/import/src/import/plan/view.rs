//! Reads the pictures of one view.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::error::ImportError;
use crate::foreign::{DepthPixels, Pictures};
use crate::import::frame_plan::{FrameSource, PlannedFrame};
use crate::import::map::FrameMap;
use crate::import::references::References;
use taceva_dataset::internal::shown_path;

/// State of reading the pictures of one view.
pub(super) struct ViewReading<'a> {
    pub(super) map: &'a FrameMap,
    /// Base folder of the pictures of the table being read.
    pub(super) base: PathBuf,
    /// Conversion of the codes of a depth map to pixels, for the clips of the table being read; `None` for pictures.
    pub(super) depth: Option<DepthPixels>,
    /// Opened files with pictures.
    pub(super) opened: BTreeMap<PathBuf, Arc<dyn Pictures>>,
    /// Table that uses pictures by row number, for each file of pictures as named in the map.
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

    /// Picture at `index` of the only file that contains the pictures of all rows, for use as the picture without contact.
    ///
    /// # Errors
    /// [`ImportError`] if there are several files, or if the picture does not exist.
    pub(super) fn frame_within(&self, index: u64) -> Result<FrameSource, ImportError> {
        let mut files = self.frames.iter().filter_map(|frame| match &frame.from {
            FrameSource::Within(pictures, _) => Some(pictures),
            FrameSource::File(_) => None,
        });
        let Some(first) = files.next() else {
            return Err(ImportError::path(
                &format!("frame {index}"),
                "the reference is a frame of a clip or an array, but no row has such a picture",
            ));
        };
        if let Some(other) = files.find(|other| other.path() != first.path()) {
            return Err(ImportError::image(
                other.path(),
                format!(
                    "`reference = {{ frame = {index} }}` needs one file with all pictures, and some are in {}: write the path of a picture",
                    shown_path(first.path())
                ),
            ));
        }
        first.check_index(index)?;
        Ok(FrameSource::Within(Arc::clone(first), index))
    }

    /// Base folder of picture names: the folder of the map, otherwise `named_by`, otherwise the folder of the table.
    pub(super) fn beside(&self, named_by: Option<&Path>) -> PathBuf {
        match self.map.folder {
            None => named_by.unwrap_or(&self.base).to_owned(),
            Some(_) => self.base.clone(),
        }
    }
}
