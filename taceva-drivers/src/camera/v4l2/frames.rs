//! Conversion of camera images to frames. An image is rows of YUYV pixels or a JPEG file.

use super::kernel::{FourCc, GivenFormat, PictureFormat};
use taceva_core::{DriverError, ErrorKind, FrameInfo, FrameMut, PixelFormat, by_count, counted};

use super::error::{START, failed};
use super::reader::Picture;
use super::yuyv::Matrix;
use crate::camera::CAPTURE;
use crate::camera::crop::Crop;
use crate::camera::jpeg::Pictures;

/// Converter from images of a local camera to frames.
#[derive(Debug)]
pub(super) enum Frames {
    /// Converter for uncompressed images, as rows of YUYV pixels.
    Rows {
        given: GivenFormat,
        matrix: Matrix,
        sent: FrameInfo,
        /// Buffer for one row of RGB pixels, before the crop.
        row: Vec<u8>,
    },
    /// Converter for JPEG files.
    Files(Pictures),
}

impl Frames {
    /// Creates a converter for uncompressed images with the size, stride and colour coding of `given`.
    pub(super) fn rows(given: GivenFormat) -> Frames {
        let PictureFormat { width, height, .. } = given.picture;
        let sent = FrameInfo {
            width,
            height,
            format: PixelFormat::Rgb8,
        };
        Frames::Rows {
            given,
            matrix: Matrix::of(given.coding),
            sent,
            row: Vec::new(),
        }
    }

    /// Size and format of the frames after `crop`.
    pub(super) fn info(&self, crop: Crop) -> FrameInfo {
        match self {
            Frames::Rows { sent, .. } => crop.of(*sent),
            Frames::Files(pictures) => pictures.info(),
        }
    }

    /// Checks that a reopened camera sends its earlier format. For JPEG files only the pixel format must be equal.
    pub(super) fn check(&self, found: &GivenFormat) -> Result<(), DriverError> {
        let is_same = match self {
            Frames::Rows { given, .. } => given == found,
            Frames::Files(_) => found.picture.pixels == FourCc::MJPG,
        };
        if is_same {
            return Ok(());
        }
        let why = format!(
            "the reopened camera sends {}, expected its earlier format",
            found.picture
        );
        Err(failed(ErrorKind::Protocol, START, why))
    }

    /// Converts an image to a frame of [`info`](Frames::info). The error for a damaged or short image states `missed`, the number of lost images.
    ///
    /// # Errors
    /// `Protocol` for an image that is damaged, short or of another size.
    pub(super) fn make(
        &mut self,
        picture: &Picture,
        crop: Crop,
        missed: u64,
        mut into: FrameMut<'_>,
    ) -> Result<(), DriverError> {
        let damaged = picture.damaged;
        let losses = || {
            format!(
                "{} {} missed and {damaged} {} damaged",
                counted(missed, "picture"),
                by_count(missed, "was", "were"),
                by_count(damaged, "was", "were")
            )
        };
        match self {
            Frames::Files(pictures) => pictures.decode(&picture.bytes, into, losses),
            Frames::Rows {
                given,
                matrix,
                sent,
                row: room,
            } => {
                let size = |number: u32| usize::try_from(number).unwrap_or(usize::MAX);
                let (stride, whole) = (size(given.stride), 3 * size(sent.width));
                // The last row may lack padding.
                let least = stride * (size(sent.height) - 1) + 2 * size(sent.width);
                if stride < 2 * size(sent.width) || picture.bytes.len() < least {
                    let why = format!(
                        "a picture of {} bytes, expected at least {least} for {}; before this picture, {}",
                        picture.bytes.len(),
                        given.picture,
                        losses()
                    );
                    return Err(failed(ErrorKind::Protocol, CAPTURE, why));
                }
                room.resize(whole, 0);
                let kept = 3 * size(crop.of(*sent).width);
                let begin = 3 * size(crop.left);
                let rows = picture.bytes.chunks(stride).skip(size(crop.top));
                for (row, into) in rows.zip(into.bytes_mut().chunks_exact_mut(kept.max(1))) {
                    matrix.row(row, room);
                    into.copy_from_slice(&room[begin..begin + kept]);
                }
                Ok(())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::camera::v4l2::kernel::Coding;

    use super::*;

    /// Converter for images of 4 by 2 pixels. A row has 8 bytes of pixels and 4 bytes of padding.
    fn frames() -> Frames {
        Frames::rows(GivenFormat {
            picture: PictureFormat {
                width: 4,
                height: 2,
                pixels: FourCc::YUYV,
            },
            stride: 12,
            bytes: 24,
            coding: Coding::Full601,
        })
    }

    fn picture(bytes: &[u8]) -> Picture {
        Picture {
            bytes: bytes.into(),
            taken: None,
            damaged: 3,
        }
    }

    fn made(frames: &mut Frames, bytes: &[u8], crop: Crop) -> Result<Vec<u8>, DriverError> {
        let info = frames.info(crop);
        let mut pixels = vec![0; info.byte_len().expect("small")];
        let frame = FrameMut::new(info, &mut pixels).expect("made for it");
        frames.make(&picture(bytes), crop, 5, frame)?;
        Ok(pixels)
    }

    /// Image with the gray values 10 to 13 and 20 to 23 in its rows, and other values in the padding.
    fn grays() -> Vec<u8> {
        let row = |first: u8| [first, 128, first + 1, 128, first + 2, 128, first + 3, 128];
        [&row(10)[..], &[255; 4], &row(20)[..]].concat()
    }

    #[test]
    fn what_lies_between_the_rows_is_no_pixel() {
        let whole = made(&mut frames(), &grays(), Crop::NONE).expect("a frame");
        let expected: Vec<u8> = [10, 11, 12, 13, 20, 21, 22, 23]
            .into_iter()
            .flat_map(|gray| [gray; 3])
            .collect();
        assert_eq!(whole, expected);
        let middle = Crop { left: 1, top: 0 };
        let part = made(&mut frames(), &grays(), middle).expect("a frame");
        assert_eq!(part, [[11; 3], [12; 3], [21; 3], [22; 3]].concat());
    }

    #[test]
    fn a_picture_that_is_cut_off_is_an_error_that_says_what_was_lost_before() {
        for length in [0, 1, 11, 12, 19] {
            let short = made(&mut frames(), &grays()[..length], Crop::NONE);
            let short = short.expect_err("cut off");
            assert_eq!(short.kind(), ErrorKind::Protocol, "{length} bytes");
            let message = short.to_string();
            assert!(
                message.contains("expected at least 20 for 4×2 YUYV"),
                "{message}"
            );
            assert!(
                message.ends_with("5 pictures were missed and 3 were damaged"),
                "{message}"
            );
        }
        // Surplus bytes are padding.
        let long = [grays(), vec![0; 100]].concat();
        assert!(made(&mut frames(), &long, Crop::NONE).is_ok());
    }

    #[test]
    fn a_camera_whose_rows_overlap_gives_no_frame() {
        let mut frames = Frames::rows(GivenFormat {
            picture: PictureFormat {
                width: 4,
                height: 2,
                pixels: FourCc::YUYV,
            },
            stride: 6,
            bytes: 12,
            coding: Coding::Full601,
        });
        let found = made(&mut frames, &grays(), Crop::NONE).expect_err("overlapping");
        assert_eq!(found.kind(), ErrorKind::Protocol);
    }
}
