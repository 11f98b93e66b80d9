//! Conversion of JPEG and PNG files from a camera to frames.

use std::borrow::Cow;

use taceva_core::{DriverError, DriverKey, ErrorKind, FrameInfo, FrameMut};

use super::CAPTURE;
use super::crop::Crop;
use crate::source::{Mismatch, decode, frame_info};

/// Image file without the zero bytes and line ends that some cameras append.
pub(super) fn whole(picture: &[u8]) -> &[u8] {
    let padding = |byte: &&u8| matches!(**byte, 0 | b'\r' | b'\n');
    let behind = picture.iter().rev().take_while(padding).count();
    &picture[..picture.len() - behind]
}

/// JPEG segment `AVI1`. A decoder then uses the standard Huffman tables (ITU-T T.81, K.3).
const USUAL_TABLES: [u8; 9] = [0xff, 0xe0, 0x00, 0x07, b'A', b'V', b'I', b'1', 0x00];
const BEGIN: [u8; 2] = [0xff, 0xd8];
const TABLES_OF_CODES: u8 = 0xc4;
const SCAN: u8 = 0xda;

/// Adds the AVI1 segment to a JPEG file without Huffman tables. Many cameras omit the tables and this segment.
fn completed(picture: &[u8]) -> Cow<'_, [u8]> {
    if has_tables(picture) != Some(false) {
        return Cow::Borrowed(picture);
    }
    let behind = &picture[BEGIN.len()..];
    Cow::Owned([&BEGIN[..], &USUAL_TABLES, behind].concat())
}

/// True if a JPEG file has a Huffman table before its image data; `None` if the bytes are not a valid JPEG file.
fn has_tables(picture: &[u8]) -> Option<bool> {
    let mut rest = picture.strip_prefix(&BEGIN)?;
    loop {
        let (&[0xff, marker, high, low], _) = rest.split_first_chunk::<4>()? else {
            return None;
        };
        match marker {
            TABLES_OF_CODES => return Some(true),
            SCAN => return Some(false),
            // The length includes itself but not the marker.
            _ => rest = rest.get(2 + usize::from(u16::from_be_bytes([high, low]))..)?,
        }
    }
}

/// Converter from JPEG or PNG files of a camera to frames.
#[derive(Clone, Debug)]
pub(super) struct Pictures {
    driver: DriverKey,
    /// Size and pixel format of the first image, which all other images must share.
    sent: FrameInfo,
    crop: Crop,
    /// Buffer for an image before the crop; empty if no crop is needed.
    room: Vec<u8>,
}

impl Pictures {
    /// Creates a converter for images with the size and format of `first`.
    ///
    /// # Errors
    /// `Protocol` if `first` is not an image.
    pub(super) fn like(
        first: &[u8],
        crop: Crop,
        driver: &DriverKey,
    ) -> Result<Pictures, DriverError> {
        let sent = frame_info(whole(first)).map_err(|why| {
            DriverError::new(ErrorKind::Protocol, driver, "read its first picture").because(why)
        })?;
        let room = match crop == Crop::NONE {
            true => Vec::new(),
            false => vec![0; sent.byte_len().unwrap_or_default()],
        };
        Ok(Pictures {
            driver: driver.clone(),
            sent,
            crop,
            room,
        })
    }

    /// Size and format of the images from the camera, before the crop.
    pub(super) fn sent(&self) -> FrameInfo {
        self.sent
    }

    /// Size and format of the converted frames, after the crop.
    pub(super) fn info(&self) -> FrameInfo {
        self.crop.of(self.sent)
    }

    /// Image file without padding, if it decodes to exactly the frame. `None` if the image is cropped or lacks Huffman tables.
    pub(super) fn as_sent<'a>(&self, picture: &'a [u8]) -> Option<&'a [u8]> {
        let is_frame = self.room.is_empty() && has_tables(picture) != Some(false);
        is_frame.then(|| whole(picture))
    }

    /// Decodes an image into a frame of [`info`](Pictures::info). The error for a damaged image includes `losses`, a description of earlier losses.
    ///
    /// # Errors
    /// `Protocol` for an image that is damaged or has another size.
    pub(super) fn decode(
        &mut self,
        picture: &[u8],
        mut into: FrameMut<'_>,
        losses: impl FnOnce() -> String,
    ) -> Result<(), DriverError> {
        let decoded = match self.room.is_empty() {
            true => decode(&completed(whole(picture)), &mut into),
            false => self.decode_part(picture, &mut into),
        };
        decoded.map_err(|mismatch| {
            let why = match mismatch {
                Mismatch::Size(found) => format!(
                    "the camera changed to frames of {found}, expected {} as at open",
                    self.sent
                ),
                Mismatch::Damaged(why) => format!("{why}; before, {}", losses()),
            };
            DriverError::new(ErrorKind::Protocol, &self.driver, CAPTURE).because(why)
        })
    }

    fn decode_part(&mut self, picture: &[u8], into: &mut FrameMut<'_>) -> Result<(), Mismatch> {
        let mut room = FrameMut::new(self.sent, &mut self.room)
            .map_err(|error| Mismatch::Damaged(error.to_string()))?;
        decode(&completed(whole(picture)), &mut room)?;
        self.crop.copy(self.sent, &self.room, into.bytes_mut());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use image::{ExtendedColorType, codecs::jpeg::JpegEncoder};

    use super::*;

    const DRIVER: DriverKey = DriverKey::fixed("test/camera");

    /// JPEG file of 24 by 16 pixels with different values.
    fn picture() -> Vec<u8> {
        let pixels: Vec<u8> = (0..24_u32 * 16 * 3)
            .map(|index| u8::try_from(index * 7 % 251).expect("below 251"))
            .collect();
        let mut file = Vec::new();
        JpegEncoder::new_with_quality(&mut file, 90)
            .encode(&pixels, 24, 16, ExtendedColorType::Rgb8)
            .expect("encoded");
        file
    }

    fn decoded(pictures: &mut Pictures, file: &[u8]) -> Result<Vec<u8>, DriverError> {
        let info = pictures.info();
        let mut pixels = vec![0; info.byte_len().expect("small")];
        let frame = FrameMut::new(info, &mut pixels).expect("made for it");
        pictures.decode(file, frame, || "nothing was missed".to_owned())?;
        Ok(pixels)
    }

    /// JPEG file without its Huffman tables, which many cameras omit.
    fn without_tables(file: &[u8]) -> Vec<u8> {
        let mut kept = BEGIN.to_vec();
        let mut at = 2;
        while file[at + 1] != SCAN {
            let length = 2 + usize::from(u16::from_be_bytes([file[at + 2], file[at + 3]]));
            if file[at + 1] != TABLES_OF_CODES {
                kept.extend(&file[at..at + length]);
            }
            at += length;
        }
        kept.extend(&file[at..]);
        kept
    }

    #[test]
    fn a_picture_without_tables_of_codes_is_read_by_the_usual_ones() {
        let file = picture();
        let bare = without_tables(&file);
        assert!(bare.len() < file.len(), "it had tables");
        let mut pictures = Pictures::like(&bare, Crop::NONE, &DRIVER).expect("a picture");
        let found = decoded(&mut pictures, &bare).expect("read");
        assert_eq!(found, decoded(&mut pictures, &file).expect("read"));
        assert_eq!(
            found,
            decoded(&mut pictures, &[&bare[..], &[0; 5]].concat()).expect("padded")
        );
    }

    #[test]
    fn a_part_of_a_picture_is_that_of_the_whole() {
        let file = picture();
        let mut all = Pictures::like(&file, Crop::NONE, &DRIVER).expect("a picture");
        let crop = Crop { left: 3, top: 2 };
        let mut part = Pictures::like(&file, crop, &DRIVER).expect("a picture");
        assert_eq!((part.info().width, part.info().height), (18, 12));
        let (all, part) = (decoded(&mut all, &file), decoded(&mut part, &file));
        let (all, part) = (all.expect("read"), part.expect("read"));
        assert_eq!(part[..18 * 3], all[3 * (2 * 24 + 3)..][..18 * 3]);
    }

    #[test]
    fn files_that_are_cut_off_or_noise_are_errors_and_never_a_panic() {
        let file = without_tables(&picture());
        let mut pictures = Pictures::like(&picture(), Crop::NONE, &DRIVER).expect("a picture");
        for length in (0..file.len()).step_by(7) {
            let error = decoded(&mut pictures, &file[..length]).expect_err("cut off");
            assert_eq!(error.kind(), ErrorKind::Protocol, "{length} bytes");
        }
        for at in 0..file.len() {
            let mut spoilt = file.clone();
            spoilt[at] ^= 0x55;
            let _ = decoded(&mut pictures, &spoilt);
        }
    }
}
