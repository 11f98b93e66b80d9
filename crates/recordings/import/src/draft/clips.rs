//! Finds the video clips that belong to the rows of a table.

use std::path::Path;

use taceva_core::counted;
use taceva_video::{Decoders, Video};

use super::endings::is_clip;
use super::frames::{FrameLines, are_pairs, counted_through, of_views};
use super::joins::span_s;
use super::roles::Role;
use super::survey::FileGroup;
use super::tables::SeenTable;
use crate::source_folder::SourceFolder;

/// The only clip of a folder.
pub(super) struct OnlyClip {
    /// File name of the clip without the filename extension.
    stem: String,
    frames: u64,
}

impl OnlyClip {
    /// Evidence, from 0 to 2, that each row of `table` is a frame: 1 if clip and table have equal counts, 2 if their file names also agree.
    pub(super) fn fit(&self, table: &SeenTable<'_>) -> u8 {
        let is_as_many = table.rows as u64 == self.frames && table.group.paths.len() == 1;
        let is_named = table.group.stem().starts_with(&self.stem);
        u8::from(is_as_many) + u8::from(is_as_many && is_named)
    }
}

/// The only clip among `groups`; `None` if there are several clips, or if the clip cannot be opened.
pub(super) fn only(folder: &SourceFolder, groups: &[FileGroup]) -> Option<OnlyClip> {
    let mut clips = groups.iter().filter(|group| is_clip(&group.ending));
    let (clip, others) = (clips.next()?, clips.next());
    if others.is_some() || clip.paths.len() > 1 {
        return None;
    }
    let video = Video::open(&folder.path().join(clip.first()), &Decoders::default());
    Some(OnlyClip {
        stem: clip.stem().to_owned(),
        frames: video.ok()?.info().frames,
    })
}

/// Clip in a folder without a table.
pub(super) struct BareClip<'g> {
    /// Path relative to the folder.
    pub(super) path: &'g str,
    pub(super) frames: u64,
    pub(super) is_gray: bool,
    /// True if the draft is for this clip alone. Tables beside the clip were then not examined.
    pub(super) is_asked: bool,
    /// Paths of the other clips.
    pub(super) others: Vec<&'g str>,
}

/// Maximum number of clips that are opened to find a readable clip.
const OPENED: usize = 16;

/// First clip that can be opened and states the time of each frame, among `groups`. If `asked` is given, only this clip is considered.
pub(super) fn bare<'g>(
    folder: &SourceFolder,
    groups: &'g [FileGroup],
    asked: Option<&str>,
) -> Option<BareClip<'g>> {
    let clips = groups.iter().filter(|group| is_clip(&group.ending));
    let clips = clips.flat_map(|group| &group.paths).map(String::as_str);
    let all: Vec<&str> = clips.collect();
    let wanted = all
        .iter()
        .filter(|path| asked.is_none_or(|asked| asked == **path));
    let (path, video) = wanted.take(OPENED).find_map(|path| {
        let video = Video::open(&folder.path().join(path), &Decoders::default()).ok()?;
        let times = video.info().times_s.as_ref()?;
        let are_rising = times.windows(2).all(|pair| pair[0] < pair[1]);
        are_rising.then_some((*path, video))
    })?;
    Some(BareClip {
        path,
        frames: video.info().frames,
        is_gray: video.info().pixel_format.starts_with("gray"),
        is_asked: asked.is_some(),
        others: all.into_iter().filter(|other| *other != path).collect(),
    })
}

/// Lines of `[frame]` for the clips beside `main`. A line has a gap (`"?"`) if a clip has more or fewer frames than `main` has rows.
pub(super) fn of(
    folder: &SourceFolder,
    groups: &[FileGroup],
    main: &SeenTable<'_>,
) -> Vec<FrameLines> {
    // LeRobot names clips by feature; other clips are not pictures of the table.
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
            "row" => other_length(&folder.path().join(clip), main),
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

/// Maximum ratio between the time spans of a clip and a table that may have been recorded together.
const SPANS: f64 = 10.0;

/// Map line with a gap (`"?"`), for a clip with more or fewer frames than `main` has rows. `None` if the counts agree or the clip cannot be opened.
fn other_length(clip: &Path, main: &SeenTable<'_>) -> Option<String> {
    let video = Video::open(clip, &Decoders::default()).ok()?;
    let info = video.info();
    let open = format!(
        "index = \"?\"   # {}, {}: name the column with the frame number",
        counted(info.frames, "frame"),
        counted(main.rows, "row")
    );
    if info.frames == main.rows as u64 {
        return None;
    }
    let ends = info.times_s.as_deref();
    let of_clip = ends.and_then(|times| Some(times.last()? - times.first()?));
    let of_table = main.time().and_then(|time| span_s(&time));
    let of_table = of_table.map(|[first, last]| last - first);
    if let Some((clip_s, table_s)) = of_clip.zip(of_table)
        && !(table_s / SPANS..=table_s * SPANS).contains(&clip_s)
    {
        return Some(format!(
            "{open}. The clip states times over {clip_s:.1} s, the table over {table_s:.1} s: do not join them by these times.\n\
             # Without such a column, write the time of each frame to a text file, one a line, and draft again"
        ));
    }
    let name = clip.file_name().unwrap_or_default().to_string_lossy();
    let (rate, times) = match info.times_s {
        Some(_) => ("", "at the times that the clip states"),
        None => (", rate = FRAMES_A_SECOND", "at this rate"),
    };
    Some(format!(
        "{open}. If the clip and the table have separate clocks, write\n\
         # table = {{ file = {name:?}, format = \"clip\"{rate} }} above, whose rows are the frames {times}, join this table by [[join]] \
         with `time`, and omit `index`"
    ))
}
