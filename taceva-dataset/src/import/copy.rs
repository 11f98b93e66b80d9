//! Running an import: every frame is read, verified and copied, and the dataset appears whole.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{Frame, FrameInfo, Progress};

use super::npy::NpyFrames;
use super::plan::{FrameSource, ImportPlan, PlannedFrames};
use super::summary::ImportSummary;
use crate::decode::{ChannelOrder, ImageKind, check_to_the_end, decode};
use crate::digest::Digest;
use crate::encode::encode_png;
use crate::error::DatasetError;
use crate::file::{read_capped, write_durable};
use crate::header::{FramesInfo, ReferenceInfo};
use crate::layout;
use crate::limits;
use crate::parallel::ordered_map;
use crate::staged::{Place, StagedFolder};
use crate::store::{Beside, write_table_and_header};
use crate::table::{FrameEntry, Table};

/// What an import did.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, SourceUnit};
/// # use taceva_dataset::{ColumnMap, ImportMap, ImportPlan, RecordingFacts, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("labels.csv"), "force\n1500\n2000\n")?;
/// let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("my gel"));
/// let mut map = ImportMap::new("labels.csv", facts);
/// map.channels = Channels::new([Channel::FZ])?;
/// map.columns = vec![ColumnMap::new("force", SourceUnit::parse("mN")?)];
/// let plan = ImportPlan::new(folder.path(), &map)?;
///
/// let target = folder.path().join("dataset");
/// let report = plan.run(&target, std::num::NonZeroUsize::MIN, &taceva_core::SilentProgress)?;
/// assert_eq!(report.digest, taceva_dataset::Dataset::open(&target)?.digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImportReport {
    /// The counts.
    pub summary: ImportSummary,
    /// Size and format of the frames; `None` if there is none.
    pub frames: Option<FrameInfo>,
    /// The digest of the dataset.
    pub digest: Digest,
    /// Where the dataset is.
    pub path: PathBuf,
}

impl ImportPlan {
    /// Writes the dataset to `target`, on `jobs` threads. The bytes are the same for any number of threads.
    ///
    /// Frames are kept as the bytes they came as; those of an array become PNG. A JPEG is read to its end, so that what was cut, lost or
    /// changed in it is noticed unless every code is still one of its tables and the last one still ends where it did: a bit that was
    /// flipped on the way to us may be another picture without any error. What happens from here on is always noticed.
    ///
    /// # Errors
    /// [`DatasetError::Image`] naming the image and the row if a frame does not decode or is unlike the first;
    /// [`DatasetError::TargetExists`], [`DatasetError::Busy`], [`DatasetError::Cancelled`], [`DatasetError::Io`]. After any of
    /// them `target` is absent.
    pub fn run(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, DatasetError> {
        self.run_at(target, Place::Free, (jobs, progress))
    }

    /// As [`run`](ImportPlan::run), in the place of the dataset at `target` if there is one: a reader sees the old one until
    /// the new one is whole and durable.
    ///
    /// # Errors
    /// As [`run`](ImportPlan::run), after which `target` is what it was; [`DatasetError::Request`] if it is no dataset, or holds what is no
    /// part of one.
    pub fn replace(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, DatasetError> {
        self.run_at(target, Place::OfDataset, (jobs, progress))
    }

    fn run_at(
        self,
        target: &Path,
        place: Place,
        (jobs, progress): (NonZeroUsize, &dyn Progress),
    ) -> Result<ImportReport, DatasetError> {
        let staged = StagedFolder::create(target, place)?;
        let mut table = self.table;
        let (frames, folders) = match &self.frames {
            Some(frames) => copy_frames(&staged, frames, &mut table, jobs, progress)?,
            None => (None, Vec::new()),
        };
        let info = frames.as_ref().map(|frames| frames.info);
        let header = write_table_and_header(
            &staged.path().join(layout::SAMPLES),
            &staged.path().join(layout::HEADER),
            &self.facts,
            (&table, frames),
            Beside {
                unmentioned_columns: self.summary.columns_left_behind(),
                ..Beside::default()
            },
        )?;
        staged.put_in_place(&folders)?;
        Ok(ImportReport {
            summary: self.summary,
            frames: info,
            digest: header.digest,
            path: target.to_owned(),
        })
    }
}

/// A frame that was verified and written.
struct Copied {
    kind: ImageKind,
    info: FrameInfo,
    entry: FrameEntry,
    intensity: f64,
}

impl Copied {
    /// Writes `bytes`, the file of `frame`, at `relative` of the staged folder.
    fn write(
        staged: &StagedFolder,
        relative: String,
        bytes: &[u8],
        (kind, frame): (ImageKind, &Frame),
    ) -> Result<Copied, DatasetError> {
        write_durable(&staged.path().join(&relative), bytes)?;
        Ok(Copied {
            kind,
            info: frame.info(),
            entry: FrameEntry {
                path: relative,
                span: None,
                digest: Digest::of(bytes),
            },
            intensity: frame.mean_luma(),
        })
    }
}

/// Frames copied at a time by each job: most of a copy is waiting until the disk has it, and disks like to be asked for
/// several files at once.
const COPIES_A_JOB: NonZeroUsize = NonZeroUsize::new(4).expect("four");

/// Copies all frames; returns what they share and the folders they lie in.
fn copy_frames(
    staged: &StagedFolder,
    frames: &PlannedFrames,
    table: &mut Table,
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<(Option<FramesInfo>, Vec<String>), DatasetError> {
    let count = frames.of_rows.len();
    let mut folders = vec![layout::FRAMES.to_owned()];
    folders.extend(layout::frame_folders(count));
    for folder in &folders {
        staged.create_folder(folder)?;
    }
    let mut first: Option<(ImageKind, FrameInfo)> = None;
    progress.begin("verify and copy frames", Some(count as u64));
    let outcome = ordered_map(
        count,
        jobs.saturating_mul(COPIES_A_JOB),
        |row| copy_frame(staged, frames, row),
        |row, copied| {
            if progress.is_cancelled() {
                return Err(DatasetError::Cancelled);
            }
            let Copied {
                kind,
                info,
                entry,
                intensity,
            } = copied?;
            let expected = *first.get_or_insert((kind, info));
            check_alike(frames, row, expected, (kind, info))?;
            table.set_frame(row, entry, intensity);
            progress.advance(1);
            Ok(())
        },
    );
    progress.end();
    outcome?;
    let Some((_, info)) = first else {
        return Ok((None, folders));
    };
    let reference = frames
        .reference
        .as_ref()
        .map(|path| copy_reference(staged, path, frames, info))
        .transpose()?;
    let shared = FramesInfo {
        count: count as u64,
        info,
        channel_order: frames.order,
        reference,
    };
    Ok((Some(shared), folders))
}

fn copy_frame(
    staged: &StagedFolder,
    frames: &PlannedFrames,
    row: usize,
) -> Result<Copied, DatasetError> {
    let planned = &frames.of_rows[row];
    let copied = match &planned.from {
        FrameSource::File(path) => copy_image(staged, path, frames.order, |extension| {
            layout::frame_path(row, extension)
        }),
        FrameSource::Array(array, index) => copy_element(staged, array, *index, frames.order, row),
    };
    copied.map_err(|error| error.named_at(planned.named_at.clone()))
}

/// Writes one frame of an array as PNG.
fn copy_element(
    staged: &StagedFolder,
    array: &NpyFrames,
    index: usize,
    order: ChannelOrder,
    row: usize,
) -> Result<Copied, DatasetError> {
    let frame = array.frame(index, order)?;
    let bytes = encode_png(&frame).map_err(|problem| DatasetError::Image {
        place: None,
        path: array.path().to_owned(),
        problem,
    })?;
    let relative = layout::frame_path(row, ImageKind::Png.extension());
    Copied::write(staged, relative, &bytes, (ImageKind::Png, &frame))
}

/// Verifies the image at `path` and writes the same bytes where `place` says.
fn copy_image(
    staged: &StagedFolder,
    path: &Path,
    order: ChannelOrder,
    place: impl FnOnce(&str) -> String,
) -> Result<Copied, DatasetError> {
    let bytes = read_capped(path, limits::IMAGE_BYTES)?;
    let whole = decode(&bytes, order).and_then(|(kind, frame)| {
        check_to_the_end(&bytes, kind)?;
        Ok((kind, frame))
    });
    let (kind, frame) = whole.map_err(|problem| DatasetError::Image {
        place: None,
        path: path.to_owned(),
        problem,
    })?;
    let extension = path
        .extension()
        .and_then(|extension| extension.to_str())
        .filter(|extension| kind.has_extension(extension))
        .unwrap_or(kind.extension());
    let relative = place(extension);
    Copied::write(staged, relative, &bytes, (kind, &frame))
}

fn copy_reference(
    staged: &StagedFolder,
    path: &Path,
    frames: &PlannedFrames,
    expected: FrameInfo,
) -> Result<ReferenceInfo, DatasetError> {
    let copied = copy_image(staged, path, frames.order, layout::reference_path)?;
    if copied.info != expected {
        return Err(DatasetError::Image {
            place: None,
            path: path.to_owned(),
            problem: format!("{}, expected {expected} as the other frames", copied.info),
        });
    }
    Ok(ReferenceInfo {
        path: copied.entry.path,
        sha256: copied.entry.digest,
    })
}

fn check_alike(
    frames: &PlannedFrames,
    row: usize,
    expected: (ImageKind, FrameInfo),
    found: (ImageKind, FrameInfo),
) -> Result<(), DatasetError> {
    if expected == found {
        return Ok(());
    }
    let planned = &frames.of_rows[row];
    let path = match &planned.from {
        FrameSource::File(path) => path.clone(),
        FrameSource::Array(array, _) => array.path().to_owned(),
    };
    Err(DatasetError::Image {
        place: Some(Box::new(planned.named_at.clone())),
        path,
        problem: format!(
            "{} {}, expected {} {} as the first frame",
            found.0.extension(),
            found.1,
            expected.0.extension(),
            expected.1
        ),
    })
}
