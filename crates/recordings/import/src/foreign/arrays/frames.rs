//! Reads frames from arrays.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use taceva_arrays::{ArrayFile, ArrayFormat};

use super::attributes::{absent_chunks, problem};
use super::form::{Form, READ_BYTES, form_of};
use crate::error::ImportError;
use crate::foreign::pictures::{Pictures, Visit};
use crate::frame_names::{ArrayFrames, FrameNames};
use taceva_dataset::ChannelOrder;
use taceva_dataset::internal::{guarded, listed};

/// Frames of one array, or of several arrays one after another.
#[derive(Debug)]
pub(crate) struct ArrayPictures {
    path: PathBuf,
    file: Arc<ArrayFile>,
    arrays: Vec<FrameArray>,
}

#[derive(Debug)]
struct FrameArray {
    name: String,
    /// Number of the first frame of this array among all frames.
    first: u64,
    rows: u64,
    row_bytes: u64,
    form: Form,
}

impl ArrayPictures {
    /// Opens the frames in the file at `path`, in the array that `frames` names or in the only array.
    pub(crate) fn open(
        path: &Path,
        names: &FrameNames,
        frames: &ArrayFrames,
    ) -> Result<ArrayPictures, ImportError> {
        let opened = guarded(|| {
            let format = ArrayFormat::of(path).unwrap_or(ArrayFormat::Npy);
            let file = ArrayFile::open(path, format).map_err(problem)?;
            let names_there = file.names();
            let array = match (&frames.path, names_there.as_slice()) {
                (Some(array), _) => array.clone(),
                (None, [only]) => only.clone(),
                (None, _) => {
                    return Err(format!(
                        "the file holds several arrays; name one by `path`: {}",
                        listed(&names_there)
                    ));
                }
            };
            ArrayPictures::new(path, Arc::new(file), vec![array], names)
        });
        opened
            .and_then(|opened| opened)
            .map_err(|problem| ImportError::image(path, problem))
    }

    pub(super) fn new(
        path: &Path,
        file: Arc<ArrayFile>,
        arrays: Vec<String>,
        names: &FrameNames,
    ) -> Result<ArrayPictures, String> {
        let mut first = 0_u64;
        let mut found = Vec::with_capacity(arrays.len());
        for name in arrays {
            let info = file.info(&name).ok_or_else(|| {
                format!("no array `{name}`; available: {}", listed(&file.names()))
            })?;
            let (form, row_bytes) =
                form_of(info, names).map_err(|problem| format!("`{name}`: {problem}"))?;
            let rows = info.rows();
            found.push(FrameArray {
                name,
                first,
                rows,
                row_bytes,
                form,
            });
            first = first.checked_add(rows).ok_or("more than 2^64 frames")?;
        }
        Ok(ArrayPictures {
            path: path.to_owned(),
            file,
            arrays: found,
        })
    }

    /// Reads consecutive rows of one array, a few megabytes at a time, and passes their pictures to `each`.
    fn visit_run(
        &self,
        array: &FrameArray,
        run: Range<u64>,
        each: Visit<'_>,
    ) -> Result<(), ImportError> {
        let at_once = (READ_BYTES / array.row_bytes.max(1)).max(1);
        let mut next = run.start;
        while next < run.end {
            let end = run.end.min(next + at_once);
            let read = guarded(|| self.file.read(&array.name, next..end).map_err(problem));
            let read = read
                .and_then(|read| read)
                .map_err(|problem| ImportError::image(self.path(), problem))?;
            for row in next..end {
                let at = as_size(row - next);
                let number = array.first + row;
                let picture = array.form.picture(&read.values, at).map_err(|problem| {
                    ImportError::image(self.path(), format!("frame {number}: {problem}"))
                })?;
                each(number, picture)?;
            }
            next = end;
        }
        Ok(())
    }
}

impl Pictures for ArrayPictures {
    fn path(&self) -> &Path {
        &self.path
    }

    fn count(&self) -> u64 {
        let last = self.arrays.last();
        last.map_or(0, |array| array.first + array.rows)
    }

    fn absent_chunks(&self) -> Result<Vec<(String, u64)>, ImportError> {
        let names = self.arrays.iter().map(|array| array.name.as_str());
        let counted = guarded(|| absent_chunks(&self.file, names)).and_then(|counted| counted);
        counted.map_err(|problem| ImportError::image(&self.path, problem))
    }

    fn visit(
        &self,
        sorted: &[u64],
        _order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), ImportError> {
        for array in &self.arrays {
            let begin = sorted.partition_point(|index| *index < array.first);
            let end = sorted.partition_point(|index| *index < array.first + array.rows);
            let own = &sorted[begin..end];
            for run in own.chunk_by(|before, after| before + 1 == *after) {
                let first = run[0] - array.first;
                self.visit_run(array, first..first + run.len() as u64, each)?;
            }
        }
        Ok(())
    }
}

/// Converts `length` to `usize`. `length` must lie within one read of a few megabytes.
fn as_size(length: u64) -> usize {
    usize::try_from(length).unwrap_or(usize::MAX)
}
