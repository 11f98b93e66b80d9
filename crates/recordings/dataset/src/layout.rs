//! File names of a dataset.

use std::ops::Range;

pub const HEADER: &str = "dataset.toml";
pub const SAMPLES: &str = "samples.parquet";
pub const SIGNALS: &str = "signals.parquet";
pub const PREDICTIONS: &str = "predictions.csv";
pub const SOURCES: &str = "sources.sha256";
pub const FRAMES: &str = "frames";
pub const MAPS: &str = "maps";
pub const JOURNAL: &str = "journal";

/// All names in the folder of a dataset or a recording.
pub const ALL: [&str; 8] = [
    HEADER,
    SAMPLES,
    SIGNALS,
    PREDICTIONS,
    SOURCES,
    FRAMES,
    MAPS,
    JOURNAL,
];

/// Maximum number of frames in one folder, because some file systems slow down above a few thousand.
const FRAMES_A_FOLDER: usize = 1_000;

/// Folder of frame `number`, relative to the dataset.
pub fn frame_folder(number: usize) -> String {
    format!("{FRAMES}/{:04}", number / FRAMES_A_FOLDER)
}

/// Path of a file or folder of frames inside the folder of `view`; `path` itself without a view.
pub fn in_view(view: Option<&str>, path: &str) -> String {
    match (view, path.strip_prefix(FRAMES)) {
        (Some(view), Some(rest)) => format!("{FRAMES}/{view}{rest}"),
        _ => path.to_owned(),
    }
}

/// File of frame `number`, relative to the dataset.
pub fn frame_path(number: usize, extension: &str) -> String {
    format!("{}/{number:06}.{extension}", frame_folder(number))
}

/// File of pack `number`, relative to the dataset.
pub fn pack_path(number: usize) -> String {
    format!("{FRAMES}/{number:04}.pack")
}

/// Pack with the depth maps of the task called `task`, relative to the dataset.
pub fn map_pack_path(task: &str) -> String {
    format!("{MAPS}/{task}.pack")
}

/// Number of the pack at `path`; `None` if the file is not a pack.
pub fn pack_number(path: &str) -> Option<usize> {
    let name = path.strip_prefix(FRAMES)?.strip_prefix('/')?;
    name.strip_suffix(".pack")?.parse().ok()
}

/// File of the frame without contact, relative to the dataset.
pub fn reference_path(extension: &str) -> String {
    format!("{FRAMES}/reference.{extension}")
}

/// File of a further frame without contact, recorded after `before` others, relative to the dataset.
pub fn reference_path_anew(before: usize, extension: &str) -> String {
    match before {
        0 => reference_path(extension),
        _ => format!("{FRAMES}/reference-{}.{extension}", before + 1),
    }
}

/// Folders that contain the frames with `numbers`, relative to the dataset.
pub fn frame_folders(numbers: Range<usize>) -> impl Iterator<Item = String> {
    let end = match numbers.is_empty() {
        true => numbers.start,
        false => numbers.end,
    };
    let start = numbers.start - numbers.start % FRAMES_A_FOLDER;
    let starts = (start..end).step_by(FRAMES_A_FOLDER);
    starts
        .filter(move |_| !numbers.is_empty())
        .map(frame_folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousand_frames_share_a_folder() {
        assert_eq!(frame_path(999, "png"), "frames/0000/000999.png");
        assert_eq!(frame_path(1_000, "jpg"), "frames/0001/001000.jpg");
        let folders: Vec<String> = frame_folders(0..1_001).collect();
        assert_eq!(folders, ["frames/0000", "frames/0001"]);
        assert_eq!(frame_folders(0..0).count(), 0);
        assert_eq!(frame_folders(1_500..1_500).count(), 0);
        let later: Vec<String> = frame_folders(999..1_001).collect();
        assert_eq!(later, folders);
        let later: Vec<String> = frame_folders(1_200..1_300).collect();
        assert_eq!(later, ["frames/0001"]);
    }

    #[test]
    fn a_pack_is_known_by_its_name() {
        assert_eq!(pack_path(3), "frames/0003.pack");
        assert_eq!(pack_number("frames/0003.pack"), Some(3));
        assert_eq!(pack_number("frames/0000/000003.png"), None);
    }
}
