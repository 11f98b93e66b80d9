//! A recording on disk, opened for reading.

mod frames;
mod maps;
mod pass;
mod signals;
mod tasks;
mod union;
mod verify;
mod views;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex};

use taceva_core::Frame;

use crate::absence::absence;
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::folder_handle::HeldFolder;
use crate::header::Header;
use crate::layout;
use crate::limits;
use crate::signals::SignalsReader;
use crate::table::Table;
use crate::task::Task;
use crate::toml_file::utf8;
use verify::read_table;

pub use pass::{Pass, StreamReport};
pub use union::JoinedRecording;
pub use union::{Difference, differences_of_added};

/// A recording: its header, its labels in memory, and its frames on disk, decoded on request.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
/// # use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # let info = FrameInfo { width: 2, height: 1, format: PixelFormat::Gray8 };
/// # for number in 0..2_u8 {
/// #     let sample = Sample::new(number.to_string()).with_truth(Readings::from_values([0.5]));
/// #     recorder.append(&sample.with_frame(Frame::new(info, vec![number, 90])?))?;
/// # }
/// use taceva_dataset::Dataset;
///
/// # recorder.close()?;
/// let dataset = Dataset::open(&path)?;
/// assert_eq!(dataset.table().truth(0).get(1), Some(0.5));
/// let frame = dataset.frame(1)?.ok_or("the second row has a frame")?;
/// assert_eq!(frame.bytes(), [1, 90]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Dataset {
    folder: HeldFolder,
    header: Header,
    table: Table,
    /// Decoded first frame of each pack file that was read, by the path of the pack.
    firsts: Mutex<BTreeMap<String, Arc<Frame>>>,
    /// Reader of the signals file; `None` before the first request.
    signals: Mutex<Option<Arc<SignalsReader>>>,
    /// Joined recordings, in row order; empty for a single recording.
    joined: Vec<JoinedRecording>,
    /// Indices of the selected views; empty if a row has one picture or no view was selected.
    seen: Vec<usize>,
    /// Task whose labels replace the channels; `None` for measured channels.
    labelled_by: Option<Task>,
}

impl Dataset {
    /// Opens the recording at `path`. Verifies and loads the table; frames are verified when read.
    ///
    /// # Errors
    /// [`DatasetError::NoDataset`] if the folder contains no dataset or the recording was not closed; [`DatasetError::Version`] if this build
    /// cannot read the format; [`DatasetError::Seal`], [`DatasetError::Digest`] or [`DatasetError::Damaged`] if a file was changed; [`DatasetError::Text`];
    /// [`DatasetError::Io`].
    pub fn open(path: &Path) -> Result<Dataset, DatasetError> {
        let folder = HeldFolder::open(path)?;
        if !folder.has(layout::HEADER) {
            let problem = if folder.has(layout::JOURNAL) {
                "the recording was not closed: resume its run with `taceva run --resume`, or close a capture with `taceva capture FOLDER --close`".to_owned()
            } else {
                absence(path)
            };
            return Err(DatasetError::NoDataset {
                path: path.to_owned(),
                problem,
            });
        }
        let header = Header::read(&folder)?;
        let table = read_table(&folder, &header)?;
        let mut dataset = Dataset::of(folder, header, table);
        dataset.check_consistency()?;
        dataset.header.digest = dataset.table.with_tasks_digest(dataset.header.digest);
        Ok(dataset)
    }

    /// Dataset of a single recording without a selected view. Reads no file.
    fn of(folder: HeldFolder, header: Header, table: Table) -> Dataset {
        Dataset {
            folder,
            header,
            table,
            firsts: Mutex::default(),
            signals: Mutex::default(),
            joined: Vec::new(),
            seen: Vec::new(),
            labelled_by: None,
        }
    }

    /// Folder of the recording; the first folder for joined recordings.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Facts about the recording as a whole.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Table of the labels.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Digest of everything that affects a number computed from this dataset.
    pub fn digest(&self) -> Digest {
        self.header.digest
    }

    /// Digests of the imported source files, in the format of `sha256sum`. `None` for a recording, or if none were stored.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if the stored list was changed; [`DatasetError::Io`].
    pub fn source_sums(&self) -> Result<Option<String>, DatasetError> {
        let Some(info) = self.header.sources else {
            return Ok(None);
        };
        let path = self.path().join(layout::SOURCES);
        let bytes = self.folder.read(layout::SOURCES, limits::SOURCES_BYTES)?;
        let found = Digest::of(&bytes);
        if found != info.sha256 {
            return Err(DatasetError::digest(&path, info.sha256, found));
        }
        utf8(&path, bytes).map(Some)
    }

    /// Indices of all rows, in order.
    pub fn all_rows(&self) -> Vec<usize> {
        (0..self.table.rows()).collect()
    }
}
