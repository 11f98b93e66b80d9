//! Video file and frame of each row of a LeRobot dataset.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::LeRobot;
use super::episodes::{self, Clip};
use super::info::Layout;
use super::pattern::{Pattern, Value};
use crate::cell::Cell;
use crate::error::{Place, TableError};
use taceva_core::whole_count;

/// Video file and frame of each row of a LeRobot dataset.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VideoFrames {
    files: Vec<PathBuf>,
    rows: Vec<(u32, u64)>,
}

impl VideoFrames {
    /// File, relative to the folder of the dataset, and index of the frame in that file, from 0; `None` if the row does not exist.
    ///
    /// ```
    /// # use taceva_tables::LeRobot;
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses-lerobot");
    /// let frames = LeRobot::open(path.as_ref())?.video("observation.images.gel")?;
    /// assert_eq!(frames.at(1).map(|(_, frame)| frame), Some(1));
    /// assert_eq!(frames.at(4), None);
    /// # Ok::<(), taceva_tables::TableError>(())
    /// ```
    pub fn at(&self, row: u64) -> Option<(&Path, u64)> {
        let (file, frame) = *self.rows.get(usize::try_from(row).ok()?)?;
        Some((self.files.get(file as usize)?, frame))
    }

    /// Video files, in the order in which the rows first use them.
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }
}

/// Maximum distance of a time stamp from the nearest frame, as a fraction of the frame period.
const TOLERANCE: f64 = 0.25;

/// File and frame in the video `key` for each row of `dataset`.
pub(super) fn frames(dataset: &LeRobot, key: &str) -> Result<VideoFrames, TableError> {
    let videos = || {
        dataset
            .features()
            .iter()
            .filter(|feature| feature.dtype == "video")
    };
    let found = videos().find(|feature| feature.name == key);
    let (Some(feature), Some(pattern)) = (found, &dataset.info.video) else {
        let known = videos().map(|feature| feature.name.clone());
        return Err(dataset.source.missing(key, known.collect()));
    };
    let mut unknown = dataset.info.unknown_depths.iter();
    if let Some((_, problem)) = unknown.find(|(name, _)| name == key) {
        return Err(dataset.source.unsupported(Place::of(key), problem.clone()));
    }
    let mut files = Files {
        key,
        pattern,
        chunks_size: dataset.info.chunks_size,
        clips: match dataset.info.layout {
            Layout::V30 => Some(episodes::clips(&dataset.folder, key)?),
            Layout::V21 => None,
        },
        paths: Vec::new(),
        places: BTreeMap::new(),
    };
    let columns = (
        dataset.column("episode_index")?,
        dataset.column("timestamp")?,
    );
    let mut rows = Vec::with_capacity(columns.0.len());
    for (row, (episode, timestamp)) in columns.0.iter().zip(&columns.1).enumerate() {
        let place = files
            .frame(episode, timestamp, feature.fps)
            .map_err(|problem| {
                let problem = format!("row {row}: {problem}");
                dataset.source.damaged(Place::of(key), problem)
            })?;
        rows.push(place);
    }
    Ok(VideoFrames {
        files: files.paths,
        rows,
    })
}

/// Video files that the rows of a dataset use.
struct Files<'a> {
    key: &'a str,
    pattern: &'a Pattern,
    chunks_size: u64,
    /// Parts of shared files by episode; `None` if each episode has its own file.
    clips: Option<BTreeMap<u64, Clip>>,
    paths: Vec<PathBuf>,
    /// For each episode: the index of its file, and the start of the episode in the file, s.
    places: BTreeMap<u64, (u32, f64)>,
}

impl Files<'_> {
    fn frame(&mut self, episode: &Cell, timestamp: &Cell, fps: f64) -> Result<(u32, u64), String> {
        let episode = match episode {
            Cell::Integer(episode) => u64::try_from(*episode).ok(),
            _ => None,
        };
        let episode = episode.ok_or("no episode number")?;
        let Cell::Number(timestamp) = timestamp else {
            return Err("no time stamp".to_owned());
        };
        let (file, from) = match self.places.get(&episode) {
            Some(place) => *place,
            None => self.place(episode)?,
        };
        let frame = frame_at((from + timestamp) * fps);
        let frame = frame.ok_or_else(|| {
            format!("{timestamp} s after {from} s matches no frame at {fps} frames per second")
        })?;
        Ok((file, frame))
    }

    fn place(&mut self, episode: u64) -> Result<(u32, f64), String> {
        let clip = match &self.clips {
            None => None,
            Some(clips) => match clips.get(&episode) {
                Some(clip) => Some(*clip),
                None => return Err(format!("episode {episode} has no description")),
            },
        };
        let path = self.pattern.fill(&[
            ("video_key", Value::Text(self.key)),
            (
                "chunk_index",
                Value::Number(clip.map_or(0, |clip| clip.chunk)),
            ),
            (
                "file_index",
                Value::Number(clip.map_or(0, |clip| clip.file)),
            ),
            ("episode_chunk", Value::Number(episode / self.chunks_size)),
            ("episode_index", Value::Number(episode)),
        ])?;
        // Episodes in one file are consecutive.
        if self.paths.last() != Some(&path) {
            self.paths.push(path);
        }
        let file = u32::try_from(self.paths.len() - 1).map_err(|_| "too many files")?;
        let place = (file, clip.map_or(0.0, |clip| clip.from));
        self.places.insert(episode, place);
        Ok(place)
    }
}

/// Index of the frame nearest to `place`, a time in frame periods; `None` if it is further away than [`TOLERANCE`].
fn frame_at(place: f64) -> Option<u64> {
    let nearest = place.round();
    let is_near = (place - nearest).abs() <= TOLERANCE && (0.0..9e15).contains(&nearest);
    is_near.then_some(whole_count(nearest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_between_frames_is_at_none() {
        assert_eq!(frame_at(6.000_1), Some(6));
        assert_eq!(frame_at(5.8), Some(6));
        assert_eq!(frame_at(-0.1), Some(0));
        for place in [5.5, -1.0, f64::NAN, f64::INFINITY, 1e300] {
            assert_eq!(frame_at(place), None);
        }
    }
}
