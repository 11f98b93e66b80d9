//! Views of datasets with several pictures per sample: one view, or several side by side.

use taceva_core::{Frame, FrameInfo};

use super::Dataset;
use crate::digest::{Digest, PartsDigest};
use crate::error::DatasetError;
use crate::header::{FramesInfo, Header, ReferenceInfo, ViewInfo};
use crate::table::{FrameEntry, digest_of};
use crate::view_names::BESIDE;

impl Dataset {
    /// Names of the views, in the order of `dataset.toml`; empty if samples have at most one picture.
    pub fn views(&self) -> Vec<&str> {
        self.header
            .views
            .iter()
            .map(|view| view.name.as_str())
            .collect()
    }

    /// Selected view, such as `left` or `left+right`; `None` if none was selected.
    pub fn view(&self) -> Option<String> {
        (!self.seen.is_empty()).then(|| {
            let names = self
                .seen
                .iter()
                .map(|at| self.header.views[*at].name.as_str());
            names.collect::<Vec<_>>().join(&BESIDE.to_string())
        })
    }

    /// The same dataset with the frames of the view `view`, or with several views side by side: `left+right`.
    ///
    /// The digest depends on the dataset and on the view. Labels are unchanged. For several views, [`frame_bytes`](Dataset::frame_bytes) cannot read
    /// an entry of the table, because no single file contains the frame.
    ///
    /// # Errors
    /// [`DatasetError::View`] if the view does not exist. [`DatasetError::Request`] if a view is named twice, or if pictures side by side differ in height or
    /// format. [`DatasetError::Io`].
    pub fn seen(&self, view: &str) -> Result<Dataset, DatasetError> {
        if !self.joined.is_empty() {
            let recordings = self.joined.iter();
            let seen = recordings.map(|own| own.dataset().seen(view));
            return Dataset::joined(seen.collect::<Result<_, _>>()?);
        }
        let seen = self.positions(view)?;
        let views: Vec<&ViewInfo> = seen.iter().map(|at| &self.header.views[*at]).collect();
        let info = info_of(&views).map_err(|problem| {
            DatasetError::request(self.path(), format!("`{view}`: {problem}"))
        })?;
        let widths: Vec<u32> = views.iter().map(|view| view.frames.info.width).collect();
        let table = self.table.seen_by(&seen, &widths);
        let count = table.frames().iter().flatten().count() as u64;
        let frames = frames_of(&views, info, count);
        let mut header = self.header.clone();
        see(&mut header, frames, view);
        Ok(Dataset {
            seen,
            ..Dataset::of(self.folder.again()?, header, table)
        })
    }

    /// Checks that each sample has a single picture or a view was selected.
    ///
    /// # Errors
    /// [`DatasetError::View`] with the list of views, if there are several and none is selected.
    pub fn require_view(&self) -> Result<(), DatasetError> {
        match self.header.views.is_empty() || !self.seen.is_empty() {
            true => Ok(()),
            false => Err(self.unknown_view(None)),
        }
    }

    fn unknown_view(&self, asked: Option<&str>) -> DatasetError {
        DatasetError::View {
            path: self.path().to_owned(),
            asked: asked.map(str::to_owned),
            known: self.views().into_iter().map(str::to_owned).collect(),
        }
    }

    /// Indices of the views that `view` names: two for `left+right`.
    fn positions(&self, view: &str) -> Result<Vec<usize>, DatasetError> {
        let mut seen = Vec::new();
        for name in view.split(BESIDE) {
            let mut known = self.header.views.iter();
            let at = known.position(|known| known.name == name);
            let at = at.ok_or_else(|| self.unknown_view(Some(name)))?;
            if seen.contains(&at) {
                return Err(DatasetError::request(
                    self.path(),
                    format!("the view `{name}` is named twice in `{view}`"),
                ));
            }
            seen.push(at);
        }
        Ok(seen)
    }

    /// Frame of a row with the selected views side by side; `None` if a view has no picture of the row.
    pub(super) fn frame_beside(&self, row: usize) -> Result<Option<Frame>, DatasetError> {
        let frames = self.seen.iter().map(|at| {
            let entry = self.table.views()[*at].frames()[row].as_ref();
            let info = &self.header.views[*at].frames;
            entry.map(|entry| self.read_frame(entry, info)).transpose()
        });
        let frames: Result<Option<Vec<Frame>>, DatasetError> = frames.collect();
        frames?.map(|frames| self.beside(&frames)).transpose()
    }

    /// Frame without contact with the selected views side by side; `None` if a view has no frame without contact.
    pub(super) fn reference_beside(&self) -> Result<Option<Frame>, DatasetError> {
        let frames = self.seen.iter().map(|at| {
            let info = &self.header.views[*at].frames;
            let entry = info.reference.as_ref().map(reference_entry);
            entry.map(|entry| self.read_frame(&entry, info)).transpose()
        });
        let frames: Result<Option<Vec<Frame>>, DatasetError> = frames.collect();
        frames?.map(|frames| self.beside(&frames)).transpose()
    }

    fn beside(&self, frames: &[Frame]) -> Result<Frame, DatasetError> {
        let damaged = |problem: String| DatasetError::damaged(self.path(), problem);
        let info = self.header.frames.as_ref().map(|frames| frames.info);
        let info =
            info.ok_or_else(|| damaged("no view is named for frames side by side".to_owned()))?;
        let height = info.height.max(1) as usize;
        let mut bytes = Vec::with_capacity(frames.iter().map(|frame| frame.bytes().len()).sum());
        for row in 0..height {
            for frame in frames {
                let stride = frame.bytes().len() / height;
                bytes.extend_from_slice(&frame.bytes()[row * stride..(row + 1) * stride]);
            }
        }
        Frame::new(info, bytes).map_err(|error| damaged(error.to_string()))
    }

    /// Entries of all pictures of all views, including the reference pictures without contact.
    pub(super) fn entries_of_views(&self) -> Vec<FrameEntry> {
        let frames = self.table.views().iter();
        let frames = frames.flat_map(|view| view.frames().iter().flatten().cloned());
        let references = self.header.views.iter();
        let references = references.filter_map(|view| view.frames.reference.as_ref());
        frames.chain(references.map(reference_entry)).collect()
    }
}

/// Entry of the picture without contact.
pub(super) fn reference_entry(reference: &ReferenceInfo) -> FrameEntry {
    FrameEntry {
        path: reference.path.clone(),
        span: None,
        digest: reference.sha256,
    }
}

/// Size and format of the pictures of `views` side by side; an error message if the pictures differ in height or format.
fn info_of(views: &[&ViewInfo]) -> Result<FrameInfo, String> {
    let Some((first, others)) = views.split_first() else {
        return Err("no view is named".to_owned());
    };
    let mut info = first.frames.info;
    for other in others {
        let own = other.frames.info;
        if own.height != info.height || own.format != info.format {
            return Err(format!(
                "views side by side need one height and one format; `{}` is {}, `{}` is {own}: name one view",
                first.name, first.frames.info, other.name
            ));
        }
        info.width = info
            .width
            .checked_add(own.width)
            .ok_or_else(|| format!("`{}` makes the joint picture too wide", other.name))?;
    }
    Ok(info)
}

/// Properties of the frames of `views` side by side.
fn frames_of(views: &[&ViewInfo], info: FrameInfo, count: u64) -> FramesInfo {
    let (first, others) = views.split_first().expect("at least one view");
    let mut frames = FramesInfo {
        count,
        info,
        ..first.frames.clone()
    };
    for other in others {
        let own = other.frames.codec.iter().chain(&other.frames.other_codecs);
        for codec in own {
            if frames.codec.as_ref() != Some(codec) && !frames.other_codecs.contains(codec) {
                frames.other_codecs.push(codec.clone());
            }
        }
        frames.reference = match (frames.reference, &other.frames.reference) {
            (Some(own), Some(theirs)) => Some(ReferenceInfo::new(
                own.path,
                digest_of([own.sha256, theirs.sha256].into_iter()),
            )),
            _ => None,
        };
    }
    frames
}

/// Changes `header` to the header of the dataset with the selected view `view`.
fn see(header: &mut Header, frames: FramesInfo, view: &str) {
    header.frames = Some(frames);
    header.digest = seen_digest(header.digest, view);
    for before in &mut header.extended {
        before.digest = seen_digest(before.digest, view);
    }
}

/// Digest of a dataset with the selected view `view`. Depends on the view, because pictures of another view give other numbers.
fn seen_digest(dataset: Digest, view: &str) -> Digest {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1 seen by");
    digest.fixed(dataset.as_bytes());
    digest.part(view.as_bytes());
    digest.finish()
}
