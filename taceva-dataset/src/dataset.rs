//! A recording on disk, opened for reading.

use std::collections::BTreeMap;
use std::io::{Seek, SeekFrom};
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use taceva_core::{Field, Frame, Progress, SampleSink, SinkError};

use crate::decode::{check_to_the_end, decode, kind_of_whole};
use crate::difference;
use crate::digest::{Digest, PartsDigest};
use crate::error::DatasetError;
use crate::file::check_relative;
use crate::header::{FramesInfo, Header};
use crate::held::HeldFolder;
use crate::import::advice;
use crate::layout;
use crate::limits;
use crate::pack::read_span;
use crate::parallel::ordered_map;
use crate::samples::from_parquet;
use crate::scaled::{DecodeScale, decode_scaled};
use crate::store::dataset_digest;
use crate::table::{FrameEntry, Table};

/// A recording: its header, its labels in memory, and its frames on disk, decoded when asked for.
#[derive(Debug)]
pub struct Dataset {
    folder: HeldFolder,
    header: Header,
    table: Table,
    scale: DecodeScale,
    /// The first frame of each pack that was looked into.
    firsts: Mutex<BTreeMap<String, Arc<Frame>>>,
}

/// Which rows to go through, how, and who listens.
#[derive(Clone, Copy)]
pub struct Pass<'a> {
    /// The rows, from 0, in the order in which they are wanted.
    pub rows: &'a [usize],
    /// Threads that read and decode.
    pub jobs: NonZeroUsize,
    /// Hears of each row and may stop the pass.
    pub progress: &'a dyn Progress,
}

/// What a pass over samples did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StreamReport {
    /// Samples handed to the sink.
    pub samples: u64,
    /// Frames that were read and decoded: none, if the sink reads none.
    pub frames_decoded: u64,
}

impl Dataset {
    /// Opens the recording at `path`. The table is verified and loaded; frames are verified as they are read.
    ///
    /// # Errors
    /// [`DatasetError::NoDataset`] if there is none or the recording was not closed; [`DatasetError::Version`] if it is newer;
    /// [`DatasetError::Digest`] or [`DatasetError::Damaged`] if it is not what was written; [`DatasetError::Io`].
    pub fn open(path: &Path) -> Result<Dataset, DatasetError> {
        let folder = HeldFolder::open(path)?;
        if !folder.has(layout::HEADER) {
            let problem = if folder.has(layout::JOURNAL) {
                "the recording was not closed; resume and close it".to_owned()
            } else {
                advice(path)
            };
            return Err(DatasetError::NoDataset {
                path: path.to_owned(),
                problem,
            });
        }
        let header = Header::read(&folder)?;
        let table = read_table(&folder, &header)?;
        let dataset = Dataset {
            folder,
            header,
            table,
            scale: DecodeScale::Full,
            firsts: Mutex::default(),
        };
        dataset.check_consistency()?;
        Ok(dataset)
    }

    /// Opens the recording at `path`, whose frames are JPEG, to be seen at a fraction of their size: header, digest and frames are those of a
    /// recording by a camera with fewer pixels.
    ///
    /// # Errors
    /// As [`open`](Dataset::open); [`DatasetError::Request`] if it has no frames, [`DatasetError::Image`] if the first of them is no JPEG.
    pub fn open_scaled(path: &Path, scale: DecodeScale) -> Result<Dataset, DatasetError> {
        let mut dataset = Dataset::open(path)?;
        if scale == DecodeScale::Full {
            return Ok(dataset);
        }
        let row = dataset.table.frames().iter().position(Option::is_some);
        let (Some(row), Some(frames)) = (row, &mut dataset.header.frames) else {
            return Err(DatasetError::Request {
                path: path.to_owned(),
                problem: "no frames that could be decoded".to_owned(),
            });
        };
        frames.info = scale.of(frames.info);
        let mut digest = PartsDigest::default();
        digest.part(b"taceva.dataset/1 at a scale");
        digest.fixed(dataset.header.digest.as_bytes());
        digest.part(scale.denominator().to_string().as_bytes());
        dataset.header.digest = digest.finish();
        dataset.scale = scale;
        dataset.frame(row)?;
        Ok(dataset)
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// What is known about the recording as a whole.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The labels.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// The digest of everything that decides a number computed from this dataset.
    pub fn digest(&self) -> Digest {
        self.header.digest
    }

    /// The rows in order, for a pass over all of them.
    pub fn all_rows(&self) -> Vec<usize> {
        (0..self.table.rows()).collect()
    }

    /// The frame of a row, verified and decoded; `None` if the row has none.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if its file is not the one recorded; [`DatasetError::Image`] if it does not decode;
    /// [`DatasetError::Request`] if there is no such row; [`DatasetError::Io`].
    pub fn frame(&self, row: usize) -> Result<Option<Frame>, DatasetError> {
        self.check_row(row)?;
        match (&self.table.frames()[row], &self.header.frames) {
            (Some(entry), Some(info)) => self.read_frame(entry, info).map(Some),
            _ => Ok(None),
        }
    }

    /// What is wrong inside the picture of a row although it decodes, in words; `None` if nothing is, or the row has no frame.
    ///
    /// A JPEG is read to its end, code by code. Imports refuse what is found so; datasets of before they did may hold it.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if its file is not the one recorded; [`DatasetError::Request`] if there is no such row;
    /// [`DatasetError::Io`].
    pub fn damage_inside(&self, row: usize) -> Result<Option<String>, DatasetError> {
        self.check_row(row)?;
        let Some(entry) = &self.table.frames()[row] else {
            return Ok(None);
        };
        let bytes = self.frame_bytes(entry)?;
        let whole = kind_of_whole(&bytes).and_then(|kind| check_to_the_end(&bytes, kind));
        Ok(whole.err())
    }

    /// The frame without contact, if the lab knew one.
    ///
    /// # Errors
    /// As [`frame`](Dataset::frame).
    pub fn reference(&self) -> Result<Option<Frame>, DatasetError> {
        let Some(info) = &self.header.frames else {
            return Ok(None);
        };
        let entry = self.reference_entry();
        let frame = entry.map(|entry| self.read_frame(&entry, info));
        frame.transpose()
    }

    /// Decodes the frame of each row, calls `work` with it on one of the threads and `take` with the results, in order, on this one.
    ///
    /// At most a few frames a thread are in memory. The outcome does not depend on the number of threads.
    ///
    /// # Errors
    /// Those of [`frame`](Dataset::frame), for the first row in order that has one; [`DatasetError::Request`] if a row has no
    /// frame; [`DatasetError::Sink`] if `take` refuses; [`DatasetError::Cancelled`].
    pub fn map_frames<T: Send>(
        &self,
        pass: Pass<'_>,
        work: impl Fn(usize, Frame) -> T + Sync,
        mut take: impl FnMut(usize, T) -> Result<(), SinkError>,
    ) -> Result<(), DatasetError> {
        let decode_and_work = |row| {
            let frame = self.frame(row)?.ok_or_else(|| DatasetError::Request {
                path: self.path().to_owned(),
                problem: format!("row {row} has no frame"),
            })?;
            Ok(work(row, frame))
        };
        self.pass(pass, "decode", decode_and_work, |row, result| {
            take(row, result).map_err(|source| DatasetError::Sink { row, source })
        })
    }

    /// Calls `work` with each row on one of the threads and `take` with the results, in order, on this one; `stage` is what the progress hears.
    ///
    /// # Errors
    /// Those of `work` and `take`, for the first row in order that has one; [`DatasetError::Cancelled`].
    pub fn map_rows<T: Send>(
        &self,
        pass: Pass<'_>,
        stage: &str,
        work: impl Fn(usize) -> Result<T, DatasetError> + Sync,
        take: impl FnMut(usize, T) -> Result<(), DatasetError>,
    ) -> Result<(), DatasetError> {
        self.pass(pass, stage, work, take)
    }

    /// Pushes the sample of each row into `sink`, in order; frames are decoded only if the sink reads them.
    ///
    /// # Errors
    /// Those of [`frame`](Dataset::frame); [`DatasetError::Sink`] if the sink refuses a sample; [`DatasetError::Cancelled`].
    pub fn stream(
        &self,
        pass: Pass<'_>,
        sink: &mut dyn SampleSink,
    ) -> Result<StreamReport, DatasetError> {
        let fields = sink.fields();
        let wants_frames = fields.contains(Field::Frame);
        let mut report = StreamReport::default();
        let read = |row| {
            self.check_row(row)?;
            if wants_frames {
                self.frame(row)
            } else {
                Ok(None)
            }
        };
        // Without frames there is nothing to share among threads.
        let jobs = if wants_frames {
            pass.jobs
        } else {
            NonZeroUsize::MIN
        };
        self.pass(Pass { jobs, ..pass }, "read", read, |row, frame| {
            report.samples += 1;
            report.frames_decoded += u64::from(frame.is_some());
            let mut sample = self.table.sample(row, fields, frame);
            sample.sensor_id = Some(self.header.sensor.model.clone());
            sink.accept(&sample)
                .map_err(|source| DatasetError::Sink { row, source })
        })?;
        Ok(report)
    }

    fn pass<T: Send>(
        &self,
        pass: Pass<'_>,
        stage: &str,
        work: impl Fn(usize) -> Result<T, DatasetError> + Sync,
        mut take: impl FnMut(usize, T) -> Result<(), DatasetError>,
    ) -> Result<(), DatasetError> {
        let Pass {
            rows,
            jobs,
            progress,
        } = pass;
        progress.begin(stage, Some(rows.len() as u64));
        let outcome = ordered_map(
            rows.len(),
            jobs,
            |position| work(rows[position]),
            |position, result| {
                if progress.is_cancelled() {
                    return Err(DatasetError::Cancelled);
                }
                take(rows[position], result?)?;
                progress.advance(1);
                Ok(())
            },
        );
        progress.end();
        outcome
    }

    fn read_frame(&self, entry: &FrameEntry, info: &FramesInfo) -> Result<Frame, DatasetError> {
        let path = self.path().join(&entry.path);
        let bytes = self.frame_bytes(entry)?;
        let first = match entry.is_difference() {
            true => Some(self.first_of_pack(entry, info)?),
            false => None,
        };
        let wrong = |problem| DatasetError::Image {
            place: None,
            path: path.clone(),
            problem,
        };
        let frame = match self.scale {
            DecodeScale::Full => decode(&bytes, info.channel_order).map(|(_, frame)| frame),
            scale => decode_scaled(&bytes, info.channel_order, scale),
        };
        let mut frame = frame.map_err(wrong)?;
        if let Some(first) = first.filter(|first| first.info() == frame.info()) {
            frame = difference::plus(&frame, &first).map_err(|error| wrong(error.to_string()))?;
        }
        if frame.info() != info.info {
            return Err(wrong(format!(
                "{}, expected {} as in the header",
                frame.info(),
                info.info
            )));
        }
        Ok(frame)
    }

    /// The bytes of a frame as they were recorded, verified.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if they are not those recorded; [`DatasetError::Io`].
    pub fn frame_bytes(&self, entry: &FrameEntry) -> Result<Vec<u8>, DatasetError> {
        let path = self.path().join(&entry.path);
        let bytes = match entry.span {
            Some(span) => {
                let (file, _) = self.folder.file(&entry.path, u64::MAX)?;
                read_span(file, &path, span)?
            }
            None => self.folder.read(&entry.path, limits::IMAGE_BYTES)?,
        };
        let found = match entry.is_difference() {
            true => difference::digest(self.first_entry(entry)?.digest, &bytes),
            false => Digest::of(&bytes),
        };
        check_digest(&path, entry.digest, found)?;
        Ok(bytes)
    }

    /// The first frame of the pack that `entry` is in.
    fn first_entry(&self, entry: &FrameEntry) -> Result<&FrameEntry, DatasetError> {
        let is_first = |first: &&FrameEntry| first.begins(&entry.path) && !first.is_difference();
        let mut frames = self.table.frames().iter().flatten();
        frames.find(is_first).ok_or_else(|| DatasetError::Damaged {
            path: self.path().join(&entry.path),
            problem: "no row names its first frame, which others are differences to".to_owned(),
        })
    }

    /// The same decoded, once a pack.
    fn first_of_pack(
        &self,
        entry: &FrameEntry,
        info: &FramesInfo,
    ) -> Result<Arc<Frame>, DatasetError> {
        let lock = || self.firsts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(first) = lock().get(&entry.path) {
            return Ok(Arc::clone(first));
        }
        let first = Arc::new(self.read_frame(self.first_entry(entry)?, info)?);
        lock().insert(entry.path.clone(), Arc::clone(&first));
        Ok(first)
    }

    /// Reads every frame, and the one without contact, and checks that it is the one recorded; nothing is decoded.
    ///
    /// # Errors
    /// As [`frame_bytes`](Dataset::frame_bytes), for the first that is not.
    pub fn verify_frames(&self) -> Result<(), DatasetError> {
        let reference = self.reference_entry();
        let frames = self.table.frames().iter().flatten().chain(&reference);
        for entry in frames {
            self.frame_bytes(entry)?;
        }
        Ok(())
    }

    fn reference_entry(&self) -> Option<FrameEntry> {
        let reference = self.header.frames.as_ref()?.reference.as_ref()?;
        Some(FrameEntry {
            path: reference.path.clone(),
            span: None,
            digest: reference.sha256,
        })
    }

    fn check_row(&self, row: usize) -> Result<(), DatasetError> {
        if row < self.table.rows() {
            return Ok(());
        }
        Err(DatasetError::Request {
            path: self.path().to_owned(),
            problem: format!("no row {row}, there are {}", self.table.rows()),
        })
    }

    /// Whether header and table tell one story. Paths are checked here once, so that reading a frame only joins them.
    fn check_consistency(&self) -> Result<(), DatasetError> {
        let damaged = |name: &str, problem: String| DatasetError::Damaged {
            path: self.path().join(name),
            problem,
        };
        let rows = self.table.rows() as u64;
        if rows != self.header.table.rows {
            let promised = self.header.table.rows;
            return Err(damaged(
                layout::SAMPLES,
                format!("{rows} rows, the header says {promised}"),
            ));
        }
        let digest = self.table.digest();
        if digest != self.header.table.digest {
            return Err(DatasetError::Digest {
                path: self.path().join(layout::SAMPLES),
                expected: self.header.table.digest,
                found: digest,
            });
        }
        let digest = dataset_digest(digest, self.header.frames.as_ref());
        if digest != self.header.digest {
            return Err(DatasetError::Digest {
                path: self.path().join(layout::HEADER),
                expected: self.header.digest,
                found: digest,
            });
        }
        let count = self.table.frames().iter().flatten().count() as u64;
        let promised = self.header.frames.as_ref().map_or(0, |frames| frames.count);
        if count != promised {
            return Err(damaged(
                layout::SAMPLES,
                format!("{count} frames, the header says {promised}"),
            ));
        }
        let reference = self
            .header
            .frames
            .as_ref()
            .and_then(|frames| frames.reference.as_ref())
            .map(|reference| &reference.path);
        let paths = self
            .table
            .frames()
            .iter()
            .flatten()
            .map(|entry| &entry.path);
        for path in paths.chain(reference) {
            check_relative(path).map_err(|problem| DatasetError::Path {
                place: None,
                written: path.clone(),
                problem: problem.to_owned(),
            })?;
        }
        Ok(())
    }
}

fn read_table(folder: &HeldFolder, header: &Header) -> Result<Table, DatasetError> {
    let path = &folder.path().join(layout::SAMPLES);
    let (mut file, _) = folder.file(layout::SAMPLES, limits::TABLE_BYTES)?;
    let found = Digest::of_reader(&mut file).map_err(DatasetError::io("read", path))?;
    check_digest(path, header.table.sha256, found)?;
    file.seek(SeekFrom::Start(0))
        .map_err(DatasetError::io("read", path))?;
    from_parquet(file, &header.channels, &header.attributes).map_err(|problem| {
        DatasetError::Damaged {
            path: path.to_owned(),
            problem,
        }
    })
}

fn check_digest(path: &Path, expected: Digest, found: Digest) -> Result<(), DatasetError> {
    if expected == found {
        return Ok(());
    }
    Err(DatasetError::Digest {
        path: path.to_owned(),
        expected,
        found,
    })
}
