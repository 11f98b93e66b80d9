//! Reads frames of clips.

use std::path::{Path, PathBuf};

use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_video::{Colours, Decoders, Video, VisitError};

use super::depth_pixels::DepthPixels;
use super::pictures::{Ended, Picture, Pictures, Visit, guarded_visit};
use super::said;
use crate::error::ImportError;
use taceva_dataset::internal::guarded;
use taceva_dataset::{ChannelOrder, FrameCodec};

/// Frames of a clip in display order. Each visit opens the file again, because a recording may have one clip per press.
#[derive(Debug)]
pub(crate) struct ClipPictures {
    path: PathBuf,
    decoders: Decoders,
    count: u64,
    codec: FrameCodec,
    /// Conversion of the codes of a depth map to pixels; `None` for other clips.
    depth: Option<DepthPixels>,
}

impl ClipPictures {
    /// Opens the clip at `path`; with `depth`, as a depth map.
    pub(crate) fn open(
        path: &Path,
        decoders: &Decoders,
        depth: Option<DepthPixels>,
    ) -> Result<ClipPictures, ImportError> {
        let video = open(path, decoders)?;
        let info = video.info();
        let mut codec = FrameCodec::new(&info.codec, &info.pixel_format);
        codec.lossy = info.lossy;
        codec.decoder.clone_from(&info.decoder);
        Ok(ClipPictures {
            codec,
            path: path.to_owned(),
            decoders: decoders.clone(),
            count: video.info().frames,
            depth,
        })
    }
}

fn open(path: &Path, decoders: &Decoders) -> Result<Video, ImportError> {
    let opened = guarded(|| Video::open(path, decoders));
    let opened = opened.map_err(|problem| ImportError::image(path, problem))?;
    opened.map_err(|error| ImportError::image(path, said(path, &error)))
}

impl Pictures for ClipPictures {
    fn path(&self) -> &Path {
        &self.path
    }

    fn count(&self) -> u64 {
        self.count
    }

    fn codec(&self) -> Option<FrameCodec> {
        Some(self.codec.clone())
    }

    fn visit(
        &self,
        sorted: &[u64],
        order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), ImportError> {
        let video = open(&self.path, &self.decoders)?;
        let (colours, format) = match order {
            ChannelOrder::Gray => (Colours::Luma, PixelFormat::Gray8),
            _ if self.depth.is_some() => {
                let problem = "a depth map has no colours: `channel_order = \"gray\"`";
                return Err(ImportError::image(&self.path, problem));
            }
            _ => (Colours::Rgb, PixelFormat::Rgb8),
        };
        guarded_visit(&self.path, || {
            let outcome = video.visit(sorted, colours, &mut |index, picture| {
                let kept = match &self.depth {
                    None => kept(picture, format),
                    Some(depth) => of_depth(&picture, depth),
                };
                each(
                    index,
                    kept.map_err(|problem| ImportError::image(&self.path, problem))?,
                )
            });
            outcome.map_err(|ended| match ended {
                VisitError::Video(error) => Ended::File(error),
                VisitError::Caller(error) => Ended::Picture(error),
            })
        })
    }
}

/// Converts the codes in a picture of a depth map to pixels, which are distances.
fn of_depth(picture: &taceva_video::Picture, depth: &DepthPixels) -> Result<Picture, String> {
    let taceva_video::Picture::Deep {
        width,
        height,
        bits,
        samples,
    } = picture
    else {
        return Err(format!(
            "{picture}, expected codes of 12 bits (gray12le) of a depth map: the clip was re-encoded, or another program wrote it"
        ));
    };
    let pixels = depth.of(samples, *bits)?.into_iter();
    let (format, bytes) = match depth.bits() {
        8 => (
            PixelFormat::Gray8,
            pixels.map(|pixel| pixel.to_le_bytes()[0]).collect(),
        ),
        _ => (
            PixelFormat::Gray16,
            pixels.flat_map(u16::to_le_bytes).collect(),
        ),
    };
    framed(
        FrameInfo {
            width: *width,
            height: *height,
            format,
        },
        bytes,
    )
}

/// Picture as stored: a Motion JPEG packet is unchanged, and samples of more than 8 bits are stored unscaled in 16 bits.
fn kept(picture: taceva_video::Picture, format: PixelFormat) -> Result<Picture, String> {
    let (width, height, format, bytes) = match picture {
        taceva_video::Picture::Jpeg(bytes) => return Ok(Picture::Encoded(bytes)),
        taceva_video::Picture::Pixels {
            width,
            height,
            samples,
        } => (width, height, format, samples),
        taceva_video::Picture::Deep {
            width,
            height,
            samples,
            ..
        } => {
            let bytes = samples.into_iter().flat_map(u16::to_le_bytes);
            (width, height, PixelFormat::Gray16, bytes.collect())
        }
        other => {
            return Err(format!("unknown kind of picture: {other}"));
        }
    };
    framed(
        FrameInfo {
            width,
            height,
            format,
        },
        bytes,
    )
}

fn framed(info: FrameInfo, bytes: Vec<u8>) -> Result<Picture, String> {
    let frame = Frame::new(info, bytes).map_err(|error| error.to_string())?;
    Ok(Picture::Pixels(frame))
}
