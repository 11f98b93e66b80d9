//! Frames of a clip as a table: one row per frame, with its time.

use std::path::Path;
use std::sync::Arc;

use taceva_video::{Decoders, Video};

use super::columns::{ColumnSource, PictureColumn};
use super::pictures::Pictures;
use super::said;
use crate::frame_names::FrameNames;

/// Frames of a clip with their times.
#[derive(Debug)]
pub(super) struct ClipRows {
    times_s: Vec<f64>,
}

/// Name of the column of frame numbers, from 0. The column `TIME` contains the time of each frame, s.
const INDEX: &str = "index";
const TIME: &str = "t";

impl ClipRows {
    /// Opens the clip at `path`, whose first frame is at `start_s`, s. Without a rate, the times stated by the clip are used.
    ///
    /// # Errors
    /// Errors of the clip reader; an error for clips whose times are missing or not ascending.
    pub(super) fn open(
        path: &Path,
        rate: Option<f64>,
        start_s: f64,
        decoders: &Decoders,
    ) -> Result<ClipRows, String> {
        let video = Video::open(path, decoders).map_err(|error| said(path, &error))?;
        let info = video.info();
        let times_s = match (rate, &info.times_s) {
            (Some(rate), _) => (0..info.frames)
                .map(|frame| start_s + frame as f64 / rate)
                .collect(),
            (None, Some(times)) => {
                let first = times.first().copied().unwrap_or(0.0);
                if let Some(frame) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
                    return Err(format!(
                        "frame {} is at {} s, no later than the frame before it: state the frame rate by `rate = FRAMES_A_SECOND`",
                        frame + 1,
                        times[frame + 1]
                    ));
                }
                times.iter().map(|time| start_s + time - first).collect()
            }
            (None, None) => {
                return Err(
                    "the clip states no frame times: state the frame rate by `rate = FRAMES_A_SECOND`"
                        .to_owned(),
                );
            }
        };
        Ok(ClipRows { times_s })
    }
}

impl ColumnSource for ClipRows {
    fn rows(&self) -> usize {
        self.times_s.len()
    }

    fn names(&self) -> Vec<String> {
        vec![INDEX.to_owned(), TIME.to_owned()]
    }

    fn has(&self, name: &str) -> bool {
        name == INDEX || name == TIME
    }

    fn columns(&self, names: &[&str]) -> Result<Vec<Vec<String>>, String> {
        let time = |time: &f64| format!("{time:?}");
        let columns = names.iter().map(|name| match *name {
            TIME => self.times_s.iter().map(time).collect(),
            _ => (0..self.rows()).map(|frame| frame.to_string()).collect(),
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
