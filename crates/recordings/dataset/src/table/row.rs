//! Rows of a table.

use std::borrow::Cow;

use taceva_core::{GratingKind, Limit, Nanometre, Phase};

use crate::digest::Digest;
use crate::layout;
use crate::pack::Span;
use crate::task::TaskLabel;

/// Location of a frame in the dataset, with the digest of its bytes.
///
/// ```
/// use taceva_dataset::{Digest, FrameEntry};
///
/// let entry = FrameEntry::at("frames/0000/000001.png", Digest::of(b"the bytes of the file"));
/// assert_eq!(entry.span, None);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FrameEntry {
    /// File or pack of the frame, relative to the folder of the dataset, with `/`.
    pub path: String,
    /// Byte range within the file at `path`; `None` for the whole file.
    pub span: Option<Span>,
    /// Digest of the frame bytes. For a difference, the digest covers its bytes and the digest of the first frame of the pack.
    pub digest: Digest,
}

impl FrameEntry {
    /// Frame at `place` as tables write it: a path, followed by `@OFFSET+LENGTH` for a pack.
    pub fn at(place: impl Into<String>, digest: Digest) -> FrameEntry {
        let place = place.into();
        let found = place.rfind('@').and_then(|at| {
            let (path, span) = place.split_at(at);
            // Another file may have a name of this form.
            layout::pack_number(path)?;
            Some((path.to_owned(), span.parse().ok()?))
        });
        let (path, span) = match found {
            Some((path, span)) => (path, Some(span)),
            None => (place, None),
        };
        FrameEntry { path, span, digest }
    }

    /// True if the frame is stored as the difference to the first frame of its pack.
    pub fn is_difference(&self) -> bool {
        self.span.is_some_and(|span| span.is_difference)
    }

    /// True if the frame is the first of the pack at `path`.
    pub(crate) fn begins(&self, path: &str) -> bool {
        self.path == path && self.span.is_some_and(|span| span.offset == 0)
    }

    /// Location as stored in tables and journals: the path, and for a pack also the byte range.
    pub(crate) fn place(&self) -> Cow<'_, str> {
        match self.span {
            Some(span) => format!("{}{span}", self.path).into(),
            None => (&self.path).into(),
        }
    }
}

/// Picture of one row in one view; missing values are `None`.
///
/// ```
/// use taceva_dataset::{Digest, FrameEntry, RowFrame};
///
/// let mut left = RowFrame::default();
/// left.frame = Some(FrameEntry::at("frames/left/0000/000001.png", Digest::of(b"the bytes of the file")));
/// assert_eq!(left.intensity, None);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RowFrame {
    /// Original picture, relative to the lab's folder.
    pub source_frame: Option<String>,
    /// Mean luma of the picture, in 8-bit steps, from 0 to below 256.
    pub intensity: Option<f64>,
    /// Location of the picture.
    pub frame: Option<FrameEntry>,
}

/// Row of a [`Table`](super::Table); missing values are `None`.
///
/// ```
/// use taceva_core::{Channel, Channels};
/// use taceva_dataset::{Row, Table};
///
/// let mut row = Row::new("press 1");
/// row.truth = vec![Some(0.5)];
/// let mut table = Table::new(Channels::new([Channel::FZ])?, Vec::new());
/// table.push(row);
/// assert_eq!(table.samples(), ["press 1"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Name of the sample, unique in a table.
    pub sample: String,
    /// Contact point, shared by repeats.
    pub point_id: Option<String>,
    /// Sensor unit of the sample.
    pub unit_id: Option<String>,
    /// Light scene of the sample.
    pub scene: Option<String>,
    /// Index of the depth step at this contact point.
    pub depth_step: Option<u32>,
    /// Index of the repeated press at this contact point.
    pub repeat: Option<u32>,
    /// Phase: load or unload.
    pub phase: Option<Phase>,
    /// Gel limit that stopped the tip before its target.
    pub limited_by: Option<Limit>,
    /// Standard uncertainty of the height from which the depth is measured, mm.
    pub zero_u_mm: Option<f64>,
    /// Imported table relative to the lab's folder, or the imported file of this row.
    pub source_table: Option<String>,
    /// Row number in `source_table`, from 0.
    pub source_row: Option<u32>,
    /// Original picture relative to the lab's folder: a file, or a file with the index of a frame, from 0, such as `clip.mp4#12`.
    pub source_frame: Option<String>,
    /// Part of a split that the recording declares.
    pub part: Option<String>,
    /// Time on the clock of the recording, s.
    pub t_s: Option<f64>,
    /// Relief of the touched grating.
    pub kind: Option<GratingKind>,
    /// Spacing of the touched grating.
    pub spacing: Option<Nanometre>,
    /// Mean luma of the full-size frame, in 8-bit steps, from 0 to below 256.
    pub intensity: Option<f64>,
    /// One value for each channel of the table.
    pub truth: Vec<Option<f64>>,
    /// One text for each attribute of the table.
    pub attributes: Vec<Option<String>>,
    /// Location of the picture.
    pub frame: Option<FrameEntry>,
    /// Pictures of all views of the table. If there are views, `frame` is unused.
    pub views: Vec<RowFrame>,
    /// One label for each task of the table.
    pub tasks: Vec<Option<TaskLabel>>,
}

impl Row {
    /// Row of the sample called `sample`, without other values.
    pub fn new(sample: impl Into<String>) -> Row {
        Row {
            sample: sample.into(),
            ..Row::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_in_a_pack_is_found_by_the_bytes_behind_its_path() {
        let digest = Digest::of(b"");
        for (place, path, span) in [
            ("frames/0000.pack@5+7", "frames/0000.pack", Some((5, 7))),
            (
                "frames/0000.pack@5+7-first",
                "frames/0000.pack",
                Some((5, 7)),
            ),
            ("frames/0000/000001.png", "frames/0000/000001.png", None),
            ("frames/0000.pack@5", "frames/0000.pack@5", None),
            ("a/x.png@5+7", "a/x.png@5+7", None),
        ] {
            let entry = FrameEntry::at(place.to_owned(), digest);
            let found = entry.span.map(|span| (span.offset, span.length));
            assert_eq!((&*entry.path, found), (path, span));
            assert_eq!(entry.place(), place);
        }
    }
}
