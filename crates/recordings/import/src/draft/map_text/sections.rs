//! Text of a map, section by section.

use std::fmt::Write;

use crate::draft::frames::FrameLines;
use crate::draft::path_parts::PathParts;
use taceva_dataset::ChannelOrder;

pub(super) const HEAD: &str = "\
# A draft from names, headers and the first rows. Replace every \"?\": an import refuses it and names its line.
# Lines with \"a guess\" may be wrong. Check them with `taceva import FOLDER --map THIS --explain`.
map_version = 2
";

/// Lines of a section. Each key occurs once.
#[derive(Default)]
pub(super) struct Lines(pub(super) String);

impl Lines {
    pub(super) fn add(&mut self, key: &str, value: &str) {
        let is_known = self
            .0
            .lines()
            .any(|line| line.split(" = ").next() == Some(key));
        let mark = if is_known { "# or: " } else { "" };
        let _ = writeln!(self.0, "{mark}{key} = {value}");
    }
}

pub(super) fn begun(notes: &[String]) -> String {
    let mut text = HEAD.to_owned();
    for note in notes {
        line(&mut text, &format!("# {}", note.replace('\n', " ")));
    }
    text
}

pub(super) fn add_path(text: &mut String, parts: &PathParts) {
    add_section(text, "path", &format!("pattern = {:?}\n", parts.pattern));
}

pub(super) fn add_frames(text: &mut String, frames: &[FrameLines]) {
    for frame in frames {
        add_frame(text, frame);
    }
}

fn add_frame(text: &mut String, frame: &FrameLines) {
    let name = frame.view.iter();
    let name = name.map(|view| format!("name = {view:?}   # a guess: each row has this view; for a single picture write [frame] without a \
        name\n"));
    let lines = frame.lines.iter().map(|line| format!("{line}\n"));
    let mut lines: String = name.chain(lines).collect();
    lines += match (frame.is_gray, frame.order) {
        (_, Some(ChannelOrder::Bgr)) => "channel_order = \"bgr\"   # stated by the messages\n",
        (_, Some(ChannelOrder::Rgb)) => "channel_order = \"rgb\"   # stated by the messages\n",
        (true, _) | (_, Some(ChannelOrder::Gray)) => "channel_order = \"gray\"\n",
        (false, _) => {
            "channel_order = \"rgb\"   # a guess: OpenCV writes arrays as \"bgr\"; pictures without colours are \"gray\"\n"
        }
    };
    lines += "reference = \"unknown\"   # the picture without contact, if there is one\n";
    let section = frame.view.as_ref().map_or("frame", |_| "[frame]");
    add_section(text, section, &lines);
}

pub(super) fn add_section(text: &mut String, name: &str, lines: &str) {
    if !lines.is_empty() {
        let _ = write!(text, "\n[{name}]\n{lines}");
    }
}

pub(super) fn ended(mut text: String) -> String {
    add_section(
        &mut text,
        "sensor",
        "model = \"?\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n",
    );
    text
}

pub(super) fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}
