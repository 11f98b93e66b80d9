//! Copies all frames: image files on many threads, and pictures inside other files in the order of those files.

use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::Arc;

use taceva_core::{FrameInfo, Progress};

use super::picture::Copied;
use crate::error::ImportError;
use crate::foreign::{Picture, Pictures};
use crate::import::frame_plan::{FrameSource, PlannedFrames, within};
use taceva_dataset::internal::{ImageKind, layout, ordered_map, staging::StagedFolder};
use taceva_dataset::{DatasetError, FrameCodec, FramesInfo, ReferenceInfo, Table, ViewInfo};

/// Number of frames per job that are copied concurrently. Most of the time is spent waiting for the disk, and disks write several files at once
/// faster.
const COPIES_A_JOB: NonZeroUsize = NonZeroUsize::new(4).expect("four");
/// Total size, bytes, at which pictures read from a file with several pictures are written.
const HELD_BYTES: usize = 16 << 20;

/// Result of copying frames.
#[derive(Debug, Default)]
pub(in crate::import) struct CopiedFrames {
    /// Frames of rows with one picture.
    pub(in crate::import) frames: Option<FramesInfo>,
    /// Frames of each view, if rows have several pictures.
    pub(in crate::import) views: Vec<ViewInfo>,
    /// Folders of the frames.
    pub(in crate::import) folders: Vec<String>,
}

/// Copies the frames of every view. The frame of the first row gets the number `first`.
pub(in crate::import) fn copy_frames(
    staged: &StagedFolder,
    planned: &[PlannedFrames],
    first: usize,
    table: &mut Table,
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<CopiedFrames, ImportError> {
    let mut copied = CopiedFrames::default();
    for frames in planned {
        let (info, folders) = copy_view(staged, frames, first, table, jobs, progress)?;
        match &frames.view {
            None => copied.frames = info,
            Some(view) => {
                let view = info.map(|info| ViewInfo::new(view, info));
                copied.views.extend(view);
            }
        }
        for folder in folders {
            if !copied.folders.contains(&folder) {
                copied.folders.push(folder);
            }
        }
    }
    Ok(copied)
}

/// Copies the frames of one view. Returns their common format and their folders, which are created if missing.
fn copy_view(
    staged: &StagedFolder,
    frames: &PlannedFrames,
    first: usize,
    table: &mut Table,
    jobs: NonZeroUsize,
    progress: &dyn Progress,
) -> Result<(Option<FramesInfo>, Vec<String>), ImportError> {
    let count = frames.of_rows.len();
    let view = frames.view.as_deref();
    let mut folders = vec![layout::FRAMES.to_owned()];
    folders.extend(view.map(|view| layout::in_view(Some(view), layout::FRAMES)));
    let own = layout::frame_folders(first..first + count);
    folders.extend(own.map(|folder| layout::in_view(view, &folder)));
    for folder in &folders {
        staged.ensure_folder(folder)?;
    }
    let stage = "verify and copy frames";
    let stage = view.map_or(stage.to_owned(), |view| format!("{stage} of {view}"));
    progress.begin(&stage, Some(count as u64));
    let position = view.and_then(|view| {
        let mut views = table.views().iter();
        views.position(|known| known.name() == view)
    });
    let mut copying = Copying {
        staged,
        frames,
        table,
        jobs: jobs.saturating_mul(COPIES_A_JOB),
        progress,
        number: first,
        view: position,
        alike: None,
    };
    let outcome = copying.all();
    let alike = copying.alike;
    progress.end();
    outcome?;
    let Some(FrameForm { info, .. }) = alike else {
        return Ok((None, folders));
    };
    let reference = frames
        .reference
        .as_ref()
        .map(|reference| copy_reference(staged, reference, frames, info))
        .transpose()?;
    let mut codecs = codecs(frames).into_iter();
    let codec = codecs.next();
    let mut shared = FramesInfo::new(count as u64, info, frames.order);
    shared.codec = codec;
    shared.other_codecs = codecs.collect();
    shared.reference = reference;
    Ok((Some(shared), folders))
}

/// Distinct codecs of the clips, in row order.
fn codecs(frames: &PlannedFrames) -> Vec<FrameCodec> {
    let mut found: Vec<FrameCodec> = Vec::new();
    for (pictures, _) in within(frames) {
        let codec = pictures.codec().filter(|codec| !found.contains(codec));
        found.extend(codec);
    }
    found
}

struct Copying<'a> {
    staged: &'a StagedFolder,
    frames: &'a PlannedFrames,
    table: &'a mut Table,
    jobs: NonZeroUsize,
    progress: &'a dyn Progress,
    /// Number of the frame of the first row.
    number: usize,
    /// Position of the view in the table, if rows have several pictures.
    view: Option<usize>,
    /// Common kind and format of all frames.
    alike: Option<FrameForm>,
}

/// Kind and format of a frame.
#[derive(Clone, Copy, PartialEq)]
struct FrameForm {
    kind: ImageKind,
    info: FrameInfo,
}

impl Copying<'_> {
    fn all(&mut self) -> Result<(), ImportError> {
        let rows = self.frames.of_rows.iter().enumerate();
        let files: Vec<(usize, &Path)> = rows
            .filter_map(|(row, planned)| match &planned.from {
                FrameSource::File(path) => Some((row, path.as_path())),
                FrameSource::Within(..) => None,
            })
            .collect();
        let (staged, order, number) = (self.staged, self.frames.order, self.number);
        let view = self.frames.view.as_deref();
        ordered_map(
            files.len(),
            self.jobs,
            |at| {
                let (row, path) = files[at];
                Copied::of_file(staged, path, order, |extension| {
                    layout::in_view(view, &layout::frame_path(number + row, extension))
                })
            },
            |at, copied| self.take(files[at].0, copied),
        )?;
        for (pictures, rows) in within(self.frames) {
            self.within(pictures.as_ref(), &rows)?;
        }
        Ok(())
    }

    /// Copies the pictures of one file. `rows` contains the picture numbers in ascending order, each with its row.
    fn within(
        &mut self,
        pictures: &dyn Pictures,
        rows: &[(u64, usize)],
    ) -> Result<(), ImportError> {
        let mut wanted: Vec<u64> = rows.iter().map(|(index, _)| *index).collect();
        wanted.dedup();
        let mut held: Vec<(usize, Arc<Picture>)> = Vec::new();
        let mut bytes = 0;
        let mut taken = 0;
        let outcome = pictures.visit(&wanted, self.frames.order, &mut |index, picture| {
            bytes += picture.size();
            let picture = Arc::new(picture);
            let own = rows[taken..].iter().take_while(|(of, _)| *of == index);
            let before = held.len();
            held.extend(own.map(|(_, row)| (*row, Arc::clone(&picture))));
            taken += held.len() - before;
            if bytes < HELD_BYTES {
                return Ok(());
            }
            bytes = 0;
            self.write(pictures.path(), std::mem::take(&mut held))
        });
        // Pictures before a damaged one are written first, so that the error names the row of the damaged one.
        self.write(pictures.path(), held)?;
        let next = rows.get(taken).map(|(_, row)| *row);
        outcome.map_err(|error| match next {
            Some(row) => error.named_at(self.frames.of_rows[row].named_at.clone()),
            None => error,
        })
    }

    fn write(&mut self, path: &Path, held: Vec<(usize, Arc<Picture>)>) -> Result<(), ImportError> {
        let (staged, order, number) = (self.staged, self.frames.order, self.number);
        let view = self.frames.view.as_deref();
        ordered_map(
            held.len(),
            self.jobs,
            |at| {
                let (row, picture) = &held[at];
                Copied::of_picture(staged, path, picture, order, |extension| {
                    layout::in_view(view, &layout::frame_path(number + *row, extension))
                })
            },
            |at, copied| self.take(held[at].0, copied),
        )
    }

    fn take(&mut self, row: usize, copied: Result<Copied, ImportError>) -> Result<(), ImportError> {
        if self.progress.is_cancelled() {
            return Err(DatasetError::Cancelled.into());
        }
        let named_at = || self.frames.of_rows[row].named_at.clone();
        let copied = copied.map_err(|error| error.named_at(named_at()))?;
        let found = FrameForm {
            kind: copied.kind,
            info: copied.info,
        };
        let expected = *self.alike.get_or_insert(found);
        check_alike(self.frames, row, expected, found)?;
        match self.view {
            None => self.table.set_frame(row, copied.entry, copied.intensity),
            Some(view) => (self.table).set_frame_of(view, row, copied.entry, copied.intensity),
        }
        self.progress.advance(1);
        Ok(())
    }
}

fn copy_reference(
    staged: &StagedFolder,
    reference: &FrameSource,
    frames: &PlannedFrames,
    expected: FrameInfo,
) -> Result<ReferenceInfo, ImportError> {
    let view = frames.view.as_deref();
    let place = |extension: &str| layout::in_view(view, &layout::reference_path(extension));
    let copied = match reference {
        FrameSource::File(path) => Copied::of_file(staged, path, frames.order, place)?,
        FrameSource::Within(pictures, _) => {
            let picture = Picture::Encoded(reference.file_bytes(frames.order)?);
            Copied::of_picture(staged, pictures.path(), &picture, frames.order, place)?
        }
    };
    if copied.info != expected {
        return Err(ImportError::image(
            &reference.named(),
            format!("{}, expected {expected} as in other frames", copied.info),
        ));
    }
    Ok(ReferenceInfo::new(copied.entry.path, copied.entry.digest))
}

fn check_alike(
    frames: &PlannedFrames,
    row: usize,
    expected: FrameForm,
    found: FrameForm,
) -> Result<(), ImportError> {
    if expected == found {
        return Ok(());
    }
    let planned = &frames.of_rows[row];
    Err(ImportError::image(
        planned.from.path(),
        format!(
            "{} {}, expected {} {} as in the first frame",
            found.kind.extension(),
            found.info,
            expected.kind.extension(),
            expected.info
        ),
    )
    .named_at(planned.named_at.clone()))
}
