//! Describes the source of each frame of an import.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::error::ImportError;
use crate::foreign::{Picture, Pictures};
use taceva_dataset::internal::{encode_png, limits, read_capped};
use taceva_dataset::{ChannelOrder, Place};

/// Sources of the frames of one view.
#[derive(Debug)]
pub(super) struct PlannedFrames {
    /// View of the frames, if rows have several pictures.
    pub(super) view: Option<String>,
    pub(super) order: ChannelOrder,
    pub(super) reference: Option<FrameSource>,
    /// Source of the frame of each kept row.
    pub(super) of_rows: Vec<PlannedFrame>,
}

/// Source of one frame, with the cell that names it.
#[derive(Debug)]
pub(super) struct PlannedFrame {
    pub(super) from: FrameSource,
    pub(super) named_at: Place,
}

#[derive(Debug)]
pub(super) enum FrameSource {
    File(PathBuf),
    /// Picture with this number in another file.
    Within(Arc<dyn Pictures>, u64),
}

impl FrameSource {
    /// Path relative to the lab's folder, followed by `#` and the picture number if the picture is inside a file.
    pub(super) fn origin(&self, folder: &Path) -> String {
        let inside = |path: &Path| {
            let inside = path.strip_prefix(folder).unwrap_or(path);
            inside.to_string_lossy().replace('\\', "/")
        };
        match self {
            FrameSource::File(path) => inside(path),
            FrameSource::Within(pictures, index) => {
                let (path, index) = pictures.origin(*index);
                format!("{}#{index}", inside(path))
            }
        }
    }

    /// Path for messages, followed by `#` and the picture number if the picture is inside a file.
    pub(super) fn named(&self) -> PathBuf {
        match self {
            FrameSource::File(path) => path.clone(),
            FrameSource::Within(pictures, index) => {
                let (path, index) = pictures.origin(*index);
                PathBuf::from(format!("{}#{index}", path.display()))
            }
        }
    }

    /// Bytes of an image file with the picture: unchanged if the picture is encoded, otherwise PNG.
    pub(super) fn file_bytes(&self, order: ChannelOrder) -> Result<Vec<u8>, ImportError> {
        let (pictures, index) = match self {
            FrameSource::File(path) => return Ok(read_capped(path, limits::IMAGE_BYTES)?),
            FrameSource::Within(pictures, index) => (pictures, *index),
        };
        let refused = |problem: String| ImportError::image(pictures.path(), problem);
        let mut bytes = Err(refused(format!("no frame {index}")));
        pictures.visit(&[index], order, &mut |_, picture| {
            bytes = match picture {
                Picture::Encoded(bytes) => Ok(bytes),
                Picture::Pixels(frame) => encode_png(&frame).map_err(refused),
            };
            Ok(())
        })?;
        bytes
    }

    pub(super) fn path(&self) -> &Path {
        match self {
            FrameSource::File(path) => path,
            FrameSource::Within(pictures, _) => pictures.path(),
        }
    }
}

/// File that contains several pictures. The list has the wanted picture numbers in ascending order, each with its row.
pub(super) type Within = (Arc<dyn Pictures>, Vec<(u64, usize)>);

/// Files that contain several pictures, each with its wanted picture numbers and their rows.
pub(super) fn within(frames: &PlannedFrames) -> Vec<Within> {
    let mut found: Vec<Within> = Vec::new();
    for (row, planned) in frames.of_rows.iter().enumerate() {
        let FrameSource::Within(pictures, index) = &planned.from else {
            continue;
        };
        // Consecutive rows usually share a file.
        let known = found
            .iter_mut()
            .rev()
            .find(|(known, _)| Arc::ptr_eq(known, pictures));
        match known {
            Some((_, rows)) => rows.push((*index, row)),
            None => found.push((Arc::clone(pictures), vec![(*index, row)])),
        }
    }
    for (_, rows) in &mut found {
        rows.sort_unstable();
    }
    found
}
