//! Verifies, writes and describes one frame.

use std::path::Path;

use taceva_core::{Frame, FrameInfo};

use crate::error::ImportError;
use crate::foreign::Picture;
use taceva_dataset::internal::{
    ImageKind, check_to_the_end, decode, encode_png, limits, read_capped, staging::StagedFolder,
    write_durable,
};
use taceva_dataset::{ChannelOrder, Digest, FrameEntry};

/// Verified and written frame.
pub(super) struct Copied {
    pub(super) kind: ImageKind,
    pub(super) info: FrameInfo,
    pub(super) entry: FrameEntry,
    pub(super) intensity: f64,
}

impl Copied {
    /// Writes `bytes`, the file of `frame`, at `relative` in the staged folder.
    fn write(
        staged: &StagedFolder,
        relative: String,
        bytes: &[u8],
        kind: ImageKind,
        frame: &Frame,
    ) -> Result<Copied, ImportError> {
        write_durable(&staged.path().join(&relative), bytes)?;
        Ok(Copied {
            kind,
            info: frame.info(),
            entry: FrameEntry::at(relative, Digest::of(bytes)),
            intensity: frame.mean_luma(),
        })
    }

    /// Verifies the image at `path` and writes the same bytes at `place`.
    pub(super) fn of_file(
        staged: &StagedFolder,
        path: &Path,
        order: ChannelOrder,
        place: impl FnOnce(&str) -> String,
    ) -> Result<Copied, ImportError> {
        let bytes = read_capped(path, limits::IMAGE_BYTES)?;
        let (kind, frame) =
            whole(&bytes, order).map_err(|problem| ImportError::image(path, problem))?;
        let extension = path
            .extension()
            .and_then(|extension| extension.to_str())
            .filter(|extension| kind.has_extension(extension))
            .unwrap_or(kind.extension());
        Copied::write(staged, place(extension), &bytes, kind, &frame)
    }

    /// Writes a picture from the file at `path` at `place`: encoded bytes unchanged, pixels as PNG.
    pub(super) fn of_picture(
        staged: &StagedFolder,
        path: &Path,
        picture: &Picture,
        order: ChannelOrder,
        place: impl FnOnce(&str) -> String,
    ) -> Result<Copied, ImportError> {
        match picture {
            Picture::Encoded(bytes) => {
                let (kind, frame) =
                    whole(bytes, order).map_err(|problem| ImportError::image(path, problem))?;
                let relative = place(kind.extension());
                Copied::write(staged, relative, bytes, kind, &frame)
            }
            Picture::Pixels(frame) => {
                let is_gray = frame.info().format.samples() == 1;
                if is_gray != (order == ChannelOrder::Gray) {
                    let problem = format!(
                        "channel order `{}` is declared, the frames are {}",
                        order.name(),
                        frame.info()
                    );
                    return Err(ImportError::image(path, problem));
                }
                let bytes =
                    encode_png(frame).map_err(|problem| ImportError::image(path, problem))?;
                let relative = place(ImageKind::Png.extension());
                Copied::write(staged, relative, &bytes, ImageKind::Png, frame)
            }
        }
    }
}

/// Decodes `bytes` to their end, so that truncated files are rejected.
fn whole(bytes: &[u8], order: ChannelOrder) -> Result<(ImageKind, Frame), String> {
    let (kind, frame) = decode(bytes, order)?;
    check_to_the_end(bytes, kind)?;
    Ok((kind, frame))
}
