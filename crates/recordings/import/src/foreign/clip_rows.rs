//! The frames of a clip as a table: a row a frame, with its time.

use std::path::Path;
use std::sync::Arc;

use taceva_video::{Decoders, Video};

use super::columns::{ColumnSource, PictureColumn};
use super::pictures::Pictures;
use super::said;
use crate::frame_names::FrameNames;

/// Frames of a clip that come at a steady rate.
#[derive(Debug)]
pub(super) struct ClipRows {
    frames: usize,
    /// Frames a second.
    rate: f64,
    /// Time of the first frame, s.
    start_s: f64,
}

/// Columns: the number of a frame from 0, and its time in seconds.
const INDEX: &str = "index";
const TIME: &str = "t";

impl ClipRows {
    /// The frames of the clip at `path`.
    ///
    /// # Errors
    /// The words of the reader of the clip; a codec that only ffmpeg decodes is not counted here.
    pub(super) fn open(path: &Path, rate: f64, start_s: f64) -> Result<ClipRows, String> {
        let video = Video::open(path, &Decoders::default()).map_err(|error| {
            format!(
                "{}; frames of such a clip are no table: write a CSV with the columns `index` and `t` and name the clip by `video` of [frame]",
                said(path, &error)
            )
        })?;
        let frames = usize::try_from(video.info().frames);
        Ok(ClipRows {
            frames: frames.map_err(|_| "too many frames".to_owned())?,
            rate,
            start_s,
        })
    }
}

impl ColumnSource for ClipRows {
    fn rows(&self) -> usize {
        self.frames
    }

    fn names(&self) -> Vec<String> {
        vec![INDEX.to_owned(), TIME.to_owned()]
    }

    fn has(&self, name: &str) -> bool {
        name == INDEX || name == TIME
    }

    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        #[expect(clippy::cast_precision_loss, reason = "frames are far below 2^53")]
        let time = |frame: usize| format!("{:?}", self.start_s + frame as f64 / self.rate);
        let columns = names.iter().map(|name| match *name {
            TIME => (0..self.frames).map(time).collect(),
            _ => (0..self.frames).map(|frame| frame.to_string()).collect(),
        });
        Ok(columns.collect())
    }

    fn holds_integers(&self, name: &str) -> bool {
        name == INDEX
    }

    fn picture_columns(&self) -> Vec<PictureColumn> {
        Vec::new()
    }

    fn pictures(&self, _names: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        Err("the frames of a clip are named by `video = \"FILE\"` of [frame]".to_owned())
    }
}
