//! Access to a camera: its name, its image format and its frame rate.

use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::path::Path;

use rustix::fs::{Mode, OFlags, open};
use rustix::io::Errno;

use super::error::V4l2Error;
use super::ioctls::{self, Capability, Format, FormatName, Rate, Size};
use super::picture::{Coding, FourCc, GivenFormat, PictureFormat};

/// Camera that is open and not streaming.
#[derive(Debug)]
pub struct Camera {
    file: OwnedFd,
    card: String,
    bus: String,
}

const RATE_CAN_BE_SET: u32 = 0x1000;
const FIELD_NONE: u32 = 1;
/// Maximum number of formats or sizes read from a camera. A faulty camera could list formats without end.
const OFFERS_MAX: u32 = 256;

impl Camera {
    /// Opens the camera with device file `path`. Changes no setting.
    ///
    /// # Errors
    /// [`V4l2Error::Open`], or [`V4l2Error::NoCamera`] if the file is not a camera or does not support streaming.
    pub fn open(path: impl AsRef<Path>) -> Result<Camera, V4l2Error> {
        let path = path.as_ref();
        let flags = OFlags::RDWR | OFlags::NONBLOCK | OFlags::CLOEXEC;
        let file = open(path, flags, Mode::empty()).map_err(|source| V4l2Error::Open {
            path: path.to_owned(),
            source: source.into(),
        })?;
        let no_camera = |why: String| V4l2Error::NoCamera {
            path: path.to_owned(),
            why,
        };
        let mut found = Capability::default();
        ioctls::query_capability(file.as_fd(), &mut found)
            .map_err(|source| no_camera(std::io::Error::from(source).to_string()))?;
        let can = match found.all & ioctls::TELLS_OF_ITSELF {
            0 => found.all,
            _ => found.own,
        };
        for (bit, what) in [
            (
                ioctls::CAN_CAPTURE,
                "it gives no pictures; use the other device file of this camera",
            ),
            (ioctls::CAN_STREAM, "it does not stream"),
        ] {
            if can & bit == 0 {
                return Err(no_camera(what.to_owned()));
            }
        }
        Ok(Camera {
            file,
            card: text(&found.card),
            bus: text(&found.bus),
        })
    }

    /// Name of the camera in the kernel.
    pub fn card(&self) -> &str {
        &self.card
    }

    /// Address of the camera on its bus, as text from the kernel.
    pub fn bus(&self) -> &str {
        &self.bus
    }

    /// Sets size and pixel format of the images.
    ///
    /// # Errors
    /// [`V4l2Error::Format`] with the supported formats if the camera sets another format; [`V4l2Error::Busy`] if another program uses the camera.
    pub fn set_format(&mut self, wanted: &PictureFormat) -> Result<GivenFormat, V4l2Error> {
        let mut format = Format {
            width: wanted.width,
            height: wanted.height,
            pixels: wanted.pixels.number(),
            ..Format::default()
        };
        ioctls::set_format(self.fd(), &mut format)
            .map_err(|source| V4l2Error::of("set the size of the pictures", source))?;
        let found = PictureFormat {
            width: format.width,
            height: format.height,
            pixels: FourCc::of(format.pixels),
        };
        if found != *wanted || format.field != FIELD_NONE {
            return Err(V4l2Error::Format {
                wanted: *wanted,
                offered: self.offered(),
            });
        }
        Ok(GivenFormat {
            picture: found,
            stride: format.stride,
            bytes: format.bytes,
            coding: Coding::of(&format),
        })
    }

    /// Sets the frame rate to `wanted_hz`, Hz. A camera with a fixed rate keeps its rate.
    ///
    /// # Errors
    /// [`V4l2Error::Rate`] if the rate of the camera then differs from `wanted_hz` by more than 1 %.
    pub fn set_rate(&mut self, wanted_hz: f64) -> Result<(), V4l2Error> {
        let doing = "set its frame rate";
        let refused = |source| V4l2Error::of(doing, source);
        let mut rate = Rate::default();
        ioctls::get_rate(self.fd(), &mut rate).map_err(refused)?;
        if rate.capability & RATE_CAN_BE_SET != 0 {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a cast saturates, and the camera reports the resulting rate"
            )]
            let per_second = (wanted_hz * 1000.0).round() as u32;
            rate.time = [1000, per_second.max(1)];
            ioctls::set_rate(self.fd(), &mut rate).map_err(refused)?;
        }
        let [numerator, denominator] = rate.time.map(f64::from);
        let found = denominator / numerator;
        // Also false for NaN, from a camera that reports no rate.
        if (found / wanted_hz - 1.0).abs() <= 0.01 {
            return Ok(());
        }
        Err(V4l2Error::Rate {
            wanted: wanted_hz,
            found,
        })
    }

    pub(crate) fn fd(&self) -> BorrowedFd<'_> {
        self.file.as_fd()
    }

    /// Formats and sizes that the camera supports, as text for an error message.
    fn offered(&self) -> String {
        let mut offered: Vec<String> = Vec::new();
        for index in 0..OFFERS_MAX {
            let mut name = FormatName {
                index,
                kind: ioctls::CAPTURE,
                ..FormatName::default()
            };
            if ioctls::enumerate_formats(self.fd(), &mut name).is_err() {
                break;
            }
            let sizes = self.sizes(name.pixels);
            offered.push(format!("{} of {sizes}", FourCc::of(name.pixels)));
        }
        match offered.is_empty() {
            true => "no listed format".to_owned(),
            false => offered.join("; "),
        }
    }

    fn sizes(&self, pixels: u32) -> String {
        let mut sizes: Vec<String> = Vec::new();
        for index in 0..OFFERS_MAX {
            let mut size = Size {
                index,
                pixels,
                ..Size::default()
            };
            match ioctls::enumerate_sizes(self.fd(), &mut size) {
                Err(Errno::INTR) => {}
                Err(_) => break,
                Ok(()) => {
                    let [a, b, _, c, d, _] = size.numbers;
                    sizes.push(match size.kind {
                        1 => format!("{a}×{b}"),
                        // Minimum, maximum and step of the width, then of the height.
                        _ => format!("{a} to {b} by {c} to {d}"),
                    });
                }
            }
        }
        match sizes.is_empty() {
            true => "unlisted sizes".to_owned(),
            false => sizes.join(", "),
        }
    }
}

/// Text in `bytes` up to the first zero byte.
pub(crate) fn text(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|byte| *byte == 0);
    String::from_utf8_lossy(&bytes[..end.unwrap_or(bytes.len())]).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_camera_is_refused_by_name() {
        let absent = Camera::open("/dev/no-such-camera").expect_err("absent");
        assert!(matches!(absent, V4l2Error::Open { .. }), "{absent}");
        let foreign = Camera::open("/dev/null").expect_err("foreign");
        assert!(matches!(foreign, V4l2Error::NoCamera { .. }), "{foreign}");
        assert!(foreign.to_string().contains("/dev/null"), "{foreign}");
    }
}
