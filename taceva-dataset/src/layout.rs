//! The names on disk.

pub(crate) const HEADER: &str = "dataset.toml";
pub(crate) const SAMPLES: &str = "samples.parquet";
pub(crate) const FRAMES: &str = "frames";
pub(crate) const JOURNAL: &str = "journal";

/// Frames in one folder: some file systems slow down beyond a few thousand.
const FRAMES_A_FOLDER: usize = 1_000;

/// The folder of frame `number`, relative to the dataset.
pub(crate) fn frame_folder(number: usize) -> String {
    format!("{FRAMES}/{:04}", number / FRAMES_A_FOLDER)
}

/// The file of frame `number`, relative to the dataset.
pub(crate) fn frame_path(number: usize, extension: &str) -> String {
    format!("{}/{number:06}.{extension}", frame_folder(number))
}

/// The file of the frame without contact, relative to the dataset.
pub(crate) fn reference_path(extension: &str) -> String {
    format!("{FRAMES}/reference.{extension}")
}

/// The file of the frame without contact when `before` were taken already, relative to the dataset.
pub(crate) fn reference_path_anew(before: usize, extension: &str) -> String {
    match before {
        0 => reference_path(extension),
        _ => format!("{FRAMES}/reference-{}.{extension}", before + 1),
    }
}

/// The folders that `count` frames lie in, relative to the dataset.
pub(crate) fn frame_folders(count: usize) -> impl Iterator<Item = String> {
    (0..count).step_by(FRAMES_A_FOLDER).map(frame_folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousand_frames_share_a_folder() {
        assert_eq!(frame_path(999, "png"), "frames/0000/000999.png");
        assert_eq!(frame_path(1_000, "jpg"), "frames/0001/001000.jpg");
        let folders: Vec<String> = frame_folders(1_001).collect();
        assert_eq!(folders, ["frames/0000", "frames/0001"]);
        assert_eq!(frame_folders(0).count(), 0);
    }
}
