//! Ordered passes over the rows of a dataset, on several threads.

use std::num::NonZeroUsize;

use taceva_core::{Field, Frame, Progress, SampleSink, SinkError};

use super::Dataset;
use crate::error::DatasetError;
use crate::parallel::ordered_map;

/// Rows of a pass in order, with the number of threads and the progress receiver.
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
/// use std::num::NonZeroUsize;
///
/// use taceva_core::SilentProgress;
/// use taceva_dataset::{Dataset, Pass};
///
/// # recorder.close()?;
/// let dataset = Dataset::open(&path)?;
/// let rows = dataset.all_rows();
/// let mut brightest = Vec::new();
/// dataset.map_frames(
///     Pass::new(&rows, NonZeroUsize::MIN, &SilentProgress),
///     |_row, frame| frame.samples().max(),
///     |_row, value| {
///         brightest.push(value);
///         Ok(())
///     },
/// )?;
/// assert_eq!(brightest, [Some(90), Some(90)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Pass<'a> {
    /// Row indices, from 0, in the order of the pass.
    pub rows: &'a [usize],
    /// Number of threads that read and decode.
    pub jobs: NonZeroUsize,
    /// Receives each finished row, and may cancel the pass.
    pub progress: &'a dyn Progress,
}

impl<'a> Pass<'a> {
    /// Pass over `rows` on `jobs` threads.
    pub fn new(rows: &'a [usize], jobs: NonZeroUsize, progress: &'a dyn Progress) -> Pass<'a> {
        Pass {
            rows,
            jobs,
            progress,
        }
    }
}

/// Counts of a pass over samples.
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
/// use std::num::NonZeroUsize;
///
/// use taceva_core::{FieldSet, SampleSink, SilentProgress, SinkError};
/// use taceva_dataset::{Dataset, Pass};
///
/// /// Counts samples; it reads no frame.
/// struct Count(u64);
///
/// impl SampleSink for Count {
///     fn fields(&self) -> FieldSet {
///         FieldSet::PAIRS
///     }
///     fn accept(&mut self, _: &Sample) -> Result<(), SinkError> {
///         self.0 += 1;
///         Ok(())
///     }
/// }
///
/// # recorder.close()?;
/// let dataset = Dataset::open(&path)?;
/// let (rows, mut count) = (dataset.all_rows(), Count(0));
/// let report = dataset.stream(Pass::new(&rows, NonZeroUsize::MIN, &SilentProgress), &mut count)?;
/// assert_eq!((report.samples, report.frames_decoded, count.0), (2, 0, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct StreamReport {
    /// Number of samples passed to the sink.
    pub samples: u64,
    /// Number of decoded frames; 0 if the sink reads no frames.
    pub frames_decoded: u64,
}

impl Dataset {
    /// Decodes the frame of each row and calls `work` with it on one of several threads. Calls `take` with the results in
    /// order on the calling thread.
    ///
    /// Keeps at most a few frames per thread in memory. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// Errors of [`frame`](Dataset::frame), for the first failing row in order; [`DatasetError::Request`] if a row has no frame; [`DatasetError::Sink`] if
    /// `take` fails; [`DatasetError::Cancelled`].
    pub fn map_frames<T: Send>(
        &self,
        pass: Pass<'_>,
        work: impl Fn(usize, Frame) -> T + Sync,
        mut take: impl FnMut(usize, T) -> Result<(), SinkError>,
    ) -> Result<(), DatasetError> {
        let decode_and_work = |row| {
            let frame = self.frame(row)?.ok_or_else(|| {
                DatasetError::request(self.path(), format!("row {row} has no frame"))
            })?;
            Ok(work(row, frame))
        };
        self.pass(pass, "decode", decode_and_work, |row, result| {
            take(row, result).map_err(|source| DatasetError::Sink { row, source })
        })
    }

    /// Calls `work` with each row on one of several threads, and `take` with the results in order on the calling thread. `stage` names the work in
    /// progress reports.
    ///
    /// # Errors
    /// Errors of `work` and `take`, for the first failing row in order; [`DatasetError::Cancelled`].
    pub fn map_rows<T: Send>(
        &self,
        pass: Pass<'_>,
        stage: &str,
        work: impl Fn(usize) -> Result<T, DatasetError> + Sync,
        take: impl FnMut(usize, T) -> Result<(), DatasetError>,
    ) -> Result<(), DatasetError> {
        self.pass(pass, stage, work, take)
    }

    /// Passes the sample of each row to `sink`, in order. Frames are decoded and signals read only if the sink needs them.
    ///
    /// # Errors
    /// Errors of [`frame`](Dataset::frame); [`DatasetError::Sink`] if the sink rejects a sample; [`DatasetError::Cancelled`].
    pub fn stream(
        &self,
        pass: Pass<'_>,
        sink: &mut dyn SampleSink,
    ) -> Result<StreamReport, DatasetError> {
        let fields = sink.fields();
        let wants_frames = fields.contains(Field::Frame);
        let wants_signals = fields.contains(Field::Signals);
        let mut report = StreamReport::default();
        let read = |row| {
            self.check_row(row)?;
            let frame = if wants_frames { self.frame(row)? } else { None };
            let signals = match wants_signals {
                true => self.signals(row)?,
                false => None,
            };
            Ok((frame, signals))
        };
        // Without frames there is no work to share among threads.
        let jobs = if wants_frames {
            pass.jobs
        } else {
            NonZeroUsize::MIN
        };
        self.pass(
            Pass { jobs, ..pass },
            "read",
            read,
            |row, (frame, signals)| {
                report.samples += 1;
                report.frames_decoded += u64::from(frame.is_some());
                let mut sample = self.table.sample(row, fields, frame);
                sample.signals = signals;
                sample.sensor_id = Some(self.header.sensor.model.clone());
                sink.accept(&sample)
                    .map_err(|source| DatasetError::Sink { row, source })
            },
        )?;
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
}
