//! Where the frames of an import come from.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::foreign::Pictures;
use taceva_dataset::{ChannelOrder, Place};

/// Where the frames come from.
#[derive(Debug)]
pub(super) struct PlannedFrames {
    /// The view that they are of, where rows have several pictures.
    pub(super) view: Option<String>,
    pub(super) order: ChannelOrder,
    pub(super) reference: Option<PathBuf>,
    /// For each kept row.
    pub(super) of_rows: Vec<PlannedFrame>,
}

/// Where one frame comes from, and which cell says so.
#[derive(Debug)]
pub(super) struct PlannedFrame {
    pub(super) from: FrameSource,
    pub(super) named_at: Place,
}

#[derive(Debug)]
pub(super) enum FrameSource {
    File(PathBuf),
    /// The picture of that number in another file.
    Within(Arc<dyn Pictures>, u64),
}

impl FrameSource {
    /// Where it is in the folder of the lab.
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

    pub(super) fn path(&self) -> &Path {
        match self {
            FrameSource::File(path) => path,
            FrameSource::Within(pictures, _) => pictures.path(),
        }
    }
}

/// A file with pictures in it, the numbers of those that are wanted, ascending, and the row of each.
pub(super) type Within = (Arc<dyn Pictures>, Vec<(u64, usize)>);

/// The files with pictures in them, each with the numbers of its pictures, ascending, and their rows.
pub(super) fn within(frames: &PlannedFrames) -> Vec<Within> {
    let mut found: Vec<Within> = Vec::new();
    for (row, planned) in frames.of_rows.iter().enumerate() {
        let FrameSource::Within(pictures, index) = &planned.from else {
            continue;
        };
        // Rows of one file mostly follow one another.
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
