//! Map of a clip without a table: its frames are the rows, with their times and without labels.

use super::sections::{add_frames, add_section, begun, ended, line};
use crate::draft::clips::BareClip;
use crate::draft::frames::FrameLines;
use taceva_core::counted;
use taceva_dataset::internal::first_names;

/// Maximum number of other clips that a comment names.
const NAMED: usize = 8;

pub(in crate::draft) fn of_clip(clip: &BareClip<'_>, notes: &[String]) -> String {
    let mut text = begun(notes);
    let frames = counted(clip.frames, "frame");
    line(
        &mut text,
        &format!(
            "table = {{ file = {:?}, format = \"clip\" }}   # no table: {frames}, each of them a row",
            clip.path
        ),
    );
    if !clip.others.is_empty() {
        let others = first_names(&clip.others, NAMED);
        line(
            &mut text,
            &format!("# Other clips: {others}. Draft each of them for a recording of its own."),
        );
    }
    let lines = FrameLines {
        lines: vec![format!("video = {:?}", clip.path)],
        is_gray: clip.is_gray,
        ..FrameLines::default()
    };
    add_frames(&mut text, &[lines]);
    let comment = match clip.is_asked {
        true => {
            "# Only the clip was read. If a table beside it has labels, draft the folder instead.\n"
        }
        false => {
            "# No file has labels. Write a table beside the clip, such as labels.csv with the columns `frame` (from 0) and `Fz`, and draft again.\n"
        }
    };
    add_section(&mut text, "columns", comment);
    let time =
        "clock = \"monotonic\"\ncolumn = \"t\"   # the times that the clip states\nunit = \"s\"\n";
    add_section(&mut text, "time", time);
    ended(text)
}
