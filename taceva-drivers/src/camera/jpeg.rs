//! Pictures that a camera sends as files, JPEG or PNG.

use taceva_core::{DriverError, DriverKey, ErrorKind, FrameInfo, FrameMut};

use super::CAPTURE;
use super::crop::Crop;
use crate::source::{Mismatch, decode, frame_info};

/// A picture without what some cameras put behind its end: zeros, and ends of lines.
pub(super) fn whole(picture: &[u8]) -> &[u8] {
    let padding = |byte: &&u8| matches!(**byte, 0 | b'\r' | b'\n');
    let behind = picture.iter().rev().take_while(padding).count();
    &picture[..picture.len() - behind]
}

/// How a driver makes frames of the pictures of its camera.
#[derive(Clone, Debug)]
pub(super) struct Pictures {
    driver: DriverKey,
    /// Of the first picture, to which all others are alike.
    sent: FrameInfo,
    crop: Crop,
    /// Room for a whole picture, where a part of it is kept.
    room: Vec<u8>,
}

impl Pictures {
    /// Pictures like `first`.
    ///
    /// # Errors
    /// `Protocol` if it is none.
    pub(super) fn like(
        first: &[u8],
        crop: Crop,
        driver: &DriverKey,
    ) -> Result<Pictures, DriverError> {
        let sent = frame_info(whole(first)).map_err(|why| {
            DriverError::new(ErrorKind::Protocol, driver, "look at its first picture").because(why)
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

    /// Of the pictures that the camera sends.
    pub(super) fn sent(&self) -> FrameInfo {
        self.sent
    }

    /// Of the frames that are made of them.
    pub(super) fn info(&self) -> FrameInfo {
        self.crop.of(self.sent)
    }

    /// Writes a picture into a frame of [`info`](Pictures::info); `losses` says what went wrong before.
    ///
    /// # Errors
    /// `Protocol` for one that is damaged or of another size.
    pub(super) fn decode(
        &mut self,
        picture: &[u8],
        mut into: FrameMut<'_>,
        losses: impl FnOnce() -> String,
    ) -> Result<(), DriverError> {
        let decoded = match self.room.is_empty() {
            true => decode(whole(picture), &mut into),
            false => self.decode_part(picture, &mut into),
        };
        decoded.map_err(|mismatch| {
            let why = match mismatch {
                Mismatch::Size(found) => format!(
                    "the camera changed to frames of {found}, it was opened with {}",
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
        decode(whole(picture), &mut room)?;
        self.crop.copy(self.sent, &self.room, into.bytes_mut());
        Ok(())
    }
}
