//! Clips beside the rows of a table.

use std::path::Path;

use taceva_core::counted;
use taceva_video::{Decoders, Video};

use super::frames::{FrameLines, are_pairs, counted_through, of_views};
use super::roles::Role;
use super::survey::FileGroup;
use super::tables::SeenTable;
use crate::source_folder::SourceFolder;

pub(super) fn is_clip(ending: &str) -> bool {
    matches!(ending, "avi" | "mp4" | "mkv" | "mov" | "webm")
}

/// Frames of the clips among `groups` for the rows of `main`.
pub(super) fn of(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
) -> Vec<FrameLines> {
    // LeRobot names clips by feature; other clips are no pictures of the table.
    if main.is_lerobot() {
        return Vec::new();
    }
    let Some(clips) = groups.iter().find(|group| is_clip(&group.ending)) else {
        return Vec::new();
    };
    let index = main
        .columns
        .iter()
        .find(|column| column.role == Role::Index);
    let index = index.map_or("row", |column| column.name.as_str());
    let of_one = |clip: &str| {
        let open = match index {
            "row" => other_length(&folder.path().join(clip), main.rows),
            _ => None,
        };
        let index = open.unwrap_or_else(|| format!("index = {index:?}"));
        lines(clip, index)
    };
    let (file, index) = match clips.paths.as_slice() {
        [only] if main.group.paths.len() == 1 => return vec![of_one(only)],
        [only] => (only.clone(), counted_through(main.group)),
        // One clip per table.
        _ if are_pairs(main.group, clips) => (clips.parts.of_table(), format!("index = {index:?}")),
        // One clip per finger, eye or camera.
        several if main.group.paths.len() == 1 => {
            let names: Vec<&str> = several.iter().map(String::as_str).collect();
            return of_views(&names, |at| of_one(names[at]));
        }
        _ => return Vec::new(),
    };
    vec![lines(&file, index)]
}

fn lines(clip: &str, index: String) -> FrameLines {
    FrameLines {
        lines: vec![format!("video = {clip:?}"), index],
        ..FrameLines::default()
    }
}

/// Open line for a clip whose frame count differs from `rows`; `None` if they agree or the clip cannot be opened.
fn other_length(clip: &Path, rows: usize) -> Option<String> {
    let video = Video::open(clip, &Decoders::default()).ok()?;
    let frames = video.info().frames;
    (frames != rows as u64).then(|| {
        let name = clip.file_name().unwrap_or_default().to_string_lossy();
        let (rate, times) = match video.info().times_s {
            Some(_) => ("", "at the times that the clip states"),
            None => (", rate = FRAMES_A_SECOND", "at this rate"),
        };
        format!(
            "index = \"?\"   # {}, {}: name the column with the frame number. If their clocks differ, write\n\
             # table = {{ file = {name:?}, format = \"clip\"{rate} }} above, whose rows are the frames {times}, join this table by [[join]] \
             with `time`, and omit `index`",
            counted(frames, "frame"),
            counted(rows, "row")
        )
    })
}
