//! Recognises pictures and clips by their filename extensions.

/// True for the filename extension of a picture, in lower case.
pub(super) fn is_picture(ending: &str) -> bool {
    matches!(ending, "png" | "jpg" | "jpeg" | "tif" | "tiff")
}

/// True for the filename extension of a clip, in lower case.
pub(super) fn is_clip(ending: &str) -> bool {
    matches!(ending, "avi" | "mp4" | "mkv" | "mov" | "webm")
}
